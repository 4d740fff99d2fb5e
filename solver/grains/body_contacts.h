// Contacts between the grains and the one rigid body that they share.
#pragma once

#include "solver/grains/contact_kernels.h"
#include "solver/grains/contact_solver.h"

namespace seapile::grains {

/// The place of a body's outline that is nearest to a grain: one per grain, because the outline is convex. At a corner
/// the lower feature has it.
struct NearestPlace {
  double distance = 0;    ///< from the grain's centre [m]; negative inside
  double nx = 0, ny = 0;  ///< from the centre to the body
  std::int32_t feature = 0;
};
NearestPlace nearest_place(const RigidBody& body, base::Vec2 centre);

/// Lists the grains with a gap below `skin`; contacts that stay keep their impulses.
void list_body_contacts(RigidBody& body, const Grains& grains, double skin);

/// Normals and gaps at the start of a step; adds what the kept impulses do to the grains.
template <class Real>
void detect_body_contacts(RigidBody& body, const Grains& grains, ContactSystem<Real>& system);

/// Work and impulses of one sweep.
struct BodySweep {
  double work = 0;       ///< of the impulse changes on the relative motion [J/m]
  base::Vec2 kept;       ///< impulse on the body that was kept from the sub-step before [N s/m]
  base::Vec2 felt;       ///< impulse on the body in this sub-step [N s/m]
  double residual = 0;   ///< sum of squared normal velocity changes [m2/s2]
};

/// One Gauss-Seidel sweep over the body's contacts, by rising grain.
template <class Real>
BodySweep sweep_body_contacts(RigidBody& body, ContactSystem<Real>& system, const Softness<double>& soft,
                              ContactTotals& totals);

}  // namespace seapile::grains
