// The contact solvers behind one signature.
//
// For every contact, normal n from i to j, gap g, impulses p_n >= 0 and |p_t| <= mu p_n (formulation.md 2):
//
//   v_n = n.(v_j - v_i),   v_t = t.(v_j - v_i) - (u_i + u_j),   u = r omega
//
// A step detects contacts once (normals stay) and solves for the impulses by one of two methods: sub-stepped soft
// sequential impulses (soft_impulses.h, production) or non-smooth contact dynamics (nonsmooth.h, the thesis' method).
// Both work on the same coloured blocks; brute_force.h does the same for all pairs, slowly and obviously.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "solver/base/crew.h"
#include "solver/base/profile.h"
#include "solver/grains/contact_blocks.h"
#include "solver/grains/contact_kernels.h"
#include "solver/grains/grains.h"
#include "solver/grains/neighbours.h"
#include "solver/grains/regions.h"
#include "solver/grains/rigid_body.h"

namespace seapile::grains {

/// The box that holds the grains: open at the top, walls as high as need be.
struct Box {
  double left = 0, right = 0, base = 0;  ///< [m]
};

/// Non-smooth contact dynamics: how far the Gauss-Seidel sweeps of a step go.
struct NonSmooth {
  int sweeps = 100;      ///< at most, per step
  double tolerance = 0;  ///< rms velocity that a sweep changes [m/s] below which no further one is made
  /// Largest speed at which an overlap is taken back [m/s]. It is a true velocity: in a bed that was settled by another
  /// method the overlaps of all layers add up, and taken back within one step they would throw the bed up.
  double correction = 1e-3;
};

/// What the contacts obey during a run.
struct ContactLaw {
  double gravity = 9.81;         ///< g [m/s2], downwards
  double friction_grain = 0.5;   ///< [-]
  double friction_wall = 0;      ///< [-]
  double restitution = 0;        ///< e [-]
  double twist = 2;              ///< m r^2/I: 2 of a disc; 0: I is infinite, and grains do not spin [-]
  double step = 5e-4;            ///< dt [s]
  std::optional<NonSmooth> nonsmooth;  ///< absent: soft impulses, to which the rest belongs
  int substeps = 10;
  double stiffness = 0.125;      ///< f h [-]
  double damping = 10;           ///< zeta [-]
};

/// Sub-steps of a step, each with a velocity of its own: one for the non-smooth method.
inline int substeps(const ContactLaw& law) { return law.nonsmooth ? 1 : law.substeps; }

/// The largest speed at which an overlap is taken back: for soft impulses a tenth of the smallest radius per step [m/s].
inline double push_speed(const ContactLaw& law, double smallest_radius) {
  return law.nonsmooth ? law.nonsmooth->correction : 0.1 * smallest_radius / law.step;
}

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
  double push_work = 0;                ///< of the grains' push on them [J/m]
};

/// What one step admits about itself.
struct ContactReport {
  bool finite = true;        ///< every path is a number
  double longest_path = 0;   ///< of a grain in this step [m]
  /// rms velocity per touching contact that solving it once more would change [m/s]: normal and tangential, all at once
  /// from the same state, for the non-smooth method; normal, within the last sweep, for soft impulses.
  double residual = 0;
  int sweeps = 0;            ///< over all contacts
  bool rebuilt = false;      ///< the neighbour list was made anew
};

/// What the push of a tile's grains does in a step (formulation.md 2.6).
struct PushSums {
  double power = 0;   ///< sum m a.v at the start of the step [W/m]
  double work = 0;    ///< on the mean of the velocities at both ends of each sub-step [J/m]
  double shared = 0;  ///< what the contacts' impulses have of it: half of sum h a.p [J/m]
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
  double twist = 2;                          ///< of the law at hand [-]
  Regions regions;                           ///< of the grains
  base::AlignedVector<Before<Real>> before;  ///< (grains, filled up to a multiple of four, and wall points)
  base::AlignedVector<Iterate<Real>> iterate;  ///< of the non-smooth method, (blocks); empty for soft impulses
  base::AlignedVector<Push<Real>> push;        ///< (grains, filled up to a multiple of four); empty: none
  base::AlignedVector<SweepSums> sweep_sums;   ///< (colours)
  base::AlignedVector<BodySums> body_sums;     ///< (tiles)
  std::vector<double> approach, body_approach;  ///< normal velocities at the start of the step, where e > 0 [m/s]
  std::vector<PushSums> push_sums;              ///< (tiles); empty where there is no push
  std::vector<double> path;    ///< longest squared path of a grain in this step, (tiles) [m2]
  std::vector<double> scratch; ///< one number of each tile, while the largest is sought

  Motion<Real>& motion(std::int32_t body) { return group[body / 4].motion[body % 4]; }
  const Motion<Real>& motion(std::int32_t body) const { return group[body / 4].motion[body % 4]; }
  Drift<Real>& drift(std::int32_t body) { return group[body / 4].drift[body % 4]; }

  double skin = 0;           ///< gap below which pairs are listed [m]
  double smallest_radius = 0;
  std::int64_t rebuilds = 0;
};

/// How a step is executed; the result does not depend on it.
struct Team {
  std::shared_ptr<base::Crew> crew;  ///< absent: one thread
  InstructionSet instructions = InstructionSet::generic;
};

/// Places grains in the system: motion at rest, empty lists. `grains.disc` grows by the points of the walls.
template <class Real>
void enclose(ContactSystem<Real>& system, Grains& grains);

/// Rebuilds what is derived after `motion`, `blocks`, `pair`, `pair_slot` and `listed` were read back.
template <class Real>
void refresh_derived(ContactSystem<Real>& system, Grains& grains);

/// One step by the law's method. `body`: the rigid body, or null; `body_path`: its downward path at the end of each
/// sub-step, counted from the start of the step [m], (substeps(law)); empty for a free body. `keep_impulses`: for
/// touching_contacts().
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
  std::int64_t between_grains = 0;     ///< of the touching, those of two grains
  double max = 0, p999 = 0, mean = 0;  ///< share of the smaller radius [-]
};
template <class Real>
OverlapStatistics overlaps(const ContactSystem<Real>& system, const Grains& grains, const RigidBody* body,
                           base::Crew* crew = nullptr);

/// Of all grains; spins included.
struct Energy {
  double kinetic = 0, potential = 0;  ///< [J/m]
  friend Energy operator+(Energy a, Energy b) { return {a.kinetic + b.kinetic, a.potential + b.potential}; }
};
/// m (v^2 + u^2 / 2) / 2, because I omega^2 / 2 = m u^2 / 4, and m g y.
template <class Real>
Energy energy_of(const Motion<Real>& motion, double mass, double height, double gravity) {
  const double vx = static_cast<double>(motion.vx), vy = static_cast<double>(motion.vy), u = static_cast<double>(motion.u);
  return {0.5 * mass * (vx * vx + vy * vy + 0.5 * u * u), mass * gravity * height};
}
/// `base`: the height from which the potential energy counts [m].
template <class Real>
Energy energy(const ContactSystem<Real>& system, const Grains& grains, double gravity, double base,
              base::Crew* crew = nullptr);

}  // namespace seapile::grains
