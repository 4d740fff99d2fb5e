// The production contact solver: sub-stepped soft sequential impulses.
//
// For every contact, normal n from i to j, gap g, impulses p_n >= 0 and |p_t| <= mu p_n (formulation.md 2):
//
//   v_n = n.(v_j - v_i),   v_t = t.(v_j - v_i) - (u_i + u_j),   u = r omega
//
// One step: contacts are detected once (normals stay), then `substeps` times with h = dt/substeps
//   1. v += h g + (the contacts' velocity change of the sub-step before)          warm start, per body
//   2. one Gauss-Seidel sweep in the order of the colours: g > 0 may close but not overshoot, g < 0 is pushed apart as a
//      damped spring of frequency f and ratio zeta (Catto's soft constraint, Box2D v3)
//   3. x += h v
//
// For discs the local 2x2 problem is diagonal (tangential mass 1/3 of the normal one), so each contact is solved exactly.
// First order in h. Neglected: rolling resistance, the turning of normals within a step.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "solver/base/profile.h"
#include "solver/grains/contact_blocks.h"
#include "solver/grains/contact_kernels.h"
#include "solver/grains/grains.h"
#include "solver/grains/neighbours.h"
#include "solver/grains/rigid_body.h"

namespace seapile::grains {

/// The box that holds the grains: open at the top, walls as high as need be.
struct Box {
  double left = 0, right = 0, base = 0;  ///< [m]
};

/// What the contacts obey during a run.
struct ContactLaw {
  double gravity = 9.81;         ///< g [m/s2], downwards
  double friction_grain = 0.5;   ///< [-]
  double friction_wall = 0;      ///< [-]
  double restitution = 0;        ///< e [-]
  double step = 5e-4;            ///< dt [s]
  int substeps = 10;
  double stiffness = 0.125;      ///< f h [-]
  double damping = 10;           ///< zeta [-]
};

/// Impulses on one obstacle since they were last cleared, as the grains press it [N s/m].
struct Impulse {
  double x = 0, y = 0;
};

/// What the contacts have done since the start or since their owner cleared it; doubles summed in a fixed order.
struct ContactTotals {
  Impulse left, right, base;           ///< walls
  std::vector<Impulse> feature;        ///< of the rigid body, by feature
  double body_work = 0;                ///< of the rigid body on the grains [J/m]
  double dissipation = 0;              ///< taken out by the contacts [J/m]
};

/// What one step admits about itself.
struct ContactReport {
  bool finite = true;        ///< every path is a number
  double longest_path = 0;   ///< of a grain in this step [m]
  double residual = 0;       ///< rms normal velocity that a sweep still changed, per touching contact [m/s]
  bool rebuilt = false;      ///< the neighbour list was made anew
};

/// Everything that the contact solver keeps for its grains; Real is the number format of velocities and impulses.
/// State is what describe() of simulation/state.h lists; the rest is derived at each step.
template <class Real>
struct ContactSystem {
  // State.
  base::AlignedVector<BodyGroup<Real>> group;  ///< motion and drift of the bodies; the drift is derived, (bodies / 4)
  ContactBlocks<Real> blocks;
  std::vector<Pair> pair;                    ///< pairs of the neighbour list, ascending
  std::vector<std::int32_t> pair_slot;       ///< block * kLanes + lane of each pair
  double closing = 0;                        ///< twice the sum of the longest paths of the steps so far: bounds how far any gap has closed [m]
  double listed_closing = 0;                 ///< when the list was made [m]
  std::vector<base::Vec2> listed;            ///< places of the grains when the list was made; empty: never (count)

  // Derived.
  base::AlignedVector<Before<Real>> before;  ///< (grains, filled up to a multiple of four, and wall points)
  std::vector<SweepSums> sweep_sums;
  std::vector<BodySums> body_sums;
  std::vector<double> approach, body_approach;  ///< normal velocities at the start of the step, where e > 0 [m/s]
  std::vector<double> path;  ///< longest squared path of a grain in this step, per tile [m2]

  Motion<Real>& motion(std::int32_t body) { return group[body / 4].motion[body % 4]; }
  const Motion<Real>& motion(std::int32_t body) const { return group[body / 4].motion[body % 4]; }
  Drift<Real>& drift(std::int32_t body) { return group[body / 4].drift[body % 4]; }

  double skin = 0;           ///< gap below which pairs are listed [m]
  double smallest_radius = 0;
  std::int64_t rebuilds = 0;
};

/// Shares the work of a step out to threads; the result does not depend on their number.
struct Team {
  int threads = 1;
  InstructionSet instructions = InstructionSet::generic;
};

/// Places grains in the system: motion at rest, empty lists. `grains.disc` grows by the points of the walls.
template <class Real>
void enclose(ContactSystem<Real>& system, Grains& grains);

/// Rebuilds what is derived after `motion`, `blocks`, `pair`, `pair_slot` and `listed` were read back.
template <class Real>
void refresh_derived(ContactSystem<Real>& system, Grains& grains);

/// One step. `body`: the rigid body, or null; `body_path`: its downward path at the end of each sub-step, counted from
/// the start of the step [m], (substeps); empty for a free body. `keep_impulses`: for touching_contacts().
template <class Real>
ContactReport integrate(ContactSystem<Real>& system, Grains& grains, const Box& box, const ContactLaw& law,
                        RigidBody* body, std::span<const double> body_path, bool keep_impulses, ContactTotals& totals,
                        const Team& team, base::Profile& profile);

/// A touching contact, as statistics and frames see it.
struct TouchingContact {
  std::int32_t first = 0;    ///< grain
  std::int32_t second = 0;   ///< grain, or -1 left, -2 right, -3 base, -4 - feature: the rigid body
  double x = 0, y = 0;       ///< point of contact [m]
  double nx = 0, ny = 0;     ///< normal from the first to the second
  double overlap = 0;        ///< share of the smaller radius [-], negative: open
  double pn = 0, pt = 0;     ///< impulses of the last step [N s/m]
};

/// The contacts that carried an impulse in the last step, which kept them: pairs in the order of (first, second), then
/// walls, then the body; gaps are those at the start of the step.
template <class Real>
std::vector<TouchingContact> touching_contacts(const ContactSystem<Real>& system, const Grains& grains, const RigidBody* body);

/// Overlaps of touching contacts.
struct OverlapStatistics {
  std::int64_t touching = 0;
  double max = 0, p999 = 0, mean = 0;  ///< share of the smaller radius [-]
};
template <class Real>
OverlapStatistics overlaps(const ContactSystem<Real>& system, const Grains& grains, const RigidBody* body);

}  // namespace seapile::grains
