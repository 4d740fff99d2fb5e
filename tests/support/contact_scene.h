// A few discs, walls, perhaps a rigid body, and nothing else: what the laws of the contact solver are stated on.
#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "solver/base/random.h"
#include "solver/grains/contact_lists.h"
#include "solver/grains/brute_force.h"
#include "solver/grains/contact_solver.h"

namespace seapile::support {

inline constexpr double kDensity = 1500;  // [kg/m3], of every grain here
inline constexpr double kFar = 1e3;       // [m], where a wall is out of the way

/// Discs, not yet enclosed. `masses`: [kg/m], (discs); empty: those of kDensity.
inline grains::Grains grains_from(const std::vector<grains::Disc>& discs, const std::vector<double>& masses = {}) {
  grains::Grains grains;
  for (const grains::Disc& d : discs) {
    grains.id.push_back(static_cast<std::int64_t>(grains.id.size()));
    grains.disc.push_back(d);
    grains.mass.push_back(kDensity * std::numbers::pi * d.radius * d.radius);
  }
  if (!masses.empty()) grains.mass = masses;
  return grains;
}

/// Discs of radii between r_min and r_max on a jittered square lattice `columns` wide, lowest row on the base: none
/// overlap. They stand in [0, columns * 2.04 r_max].
inline std::vector<grains::Disc> jittered_lattice(int count, int columns, double r_min, double r_max,
                                                  std::uint64_t seed) {
  const double pitch = 2.04 * r_max;
  std::vector<grains::Disc> discs;
  for (int k = 0; k < count; ++k) {
    const auto index = static_cast<std::uint64_t>(k);
    const double r = base::uniform(r_min, r_max, seed, 0, index), room = pitch / 2 - r;
    discs.push_back({pitch * (k % columns + 0.5) + base::uniform(-room, room, seed, 1, index),
                     pitch * (k / columns + 0.5) + base::uniform(-room, room, seed, 2, index), r, 0});
  }
  return discs;
}

/// A push of its own for every grain, up to `size` along each axis [m/s2].
inline std::vector<base::Vec2> random_push(std::size_t count, double size, std::uint64_t seed) {
  std::vector<base::Vec2> push;
  for (std::size_t i = 0; i < count; ++i)
    push.push_back({base::uniform(-size, size, seed, 0, i), base::uniform(-size, size, seed, 1, i)});
  return push;
}

/// The system of a solver: blocks in one of two number formats, or all pairs.
template <class Solver>
struct SystemOf {
  using Type = grains::ContactSystem<Solver>;
};
template <>
struct SystemOf<grains::AllPairs> {
  using Type = grains::AllPairs;
};

/// A contact solver with everything it works on. `Solver`: float or double for blocks, or AllPairs.
template <class Solver>
struct ContactScene {
  using System = typename SystemOf<Solver>::Type;
  using Real = decltype(grains::Motion(std::declval<System&>().motion(0)).vx);

  explicit ContactScene(const std::vector<grains::Disc>& discs, const std::vector<double>& masses = {})
      : grains(grains_from(discs, masses)) {
    enclose(system, grains);
    totals.feature.resize(2);
  }

  grains::Box box{-kFar, kFar, 0};
  grains::ContactLaw law;
  grains::Grains grains;
  System system;
  std::optional<grains::RigidBody> body;  ///< prescribed where its inverse mass is 0
  double body_speed = 0;                  ///< downwards, of a prescribed body [m/s]
  grains::ContactTotals totals;
  grains::ContactReport report;  ///< of the last step
  grains::Team team;
  base::Profile profile;

  void step() {
    std::vector<double> path;
    const double h = law.step / substeps(law);
    for (int k = 0; body && body->inverse_mass == 0 && k < substeps(law); ++k) path.push_back(body_speed * h * (k + 1));
    report = integrate(system, grains, box, law, body ? &*body : nullptr, path, true, totals, team, profile);
  }
  void steps(int count) {
    for (int k = 0; k < count; ++k) step();
  }
  /// Steps over a time, rounded to whole steps [s].
  void run(double time) { steps(static_cast<int>(time / law.step + 0.5)); }

  const grains::Disc& disc(int i) const { return grains.disc[i]; }
  base::Vec2 velocity(int i) const {
    const auto& m = system.motion(i);
    return {static_cast<double>(m.vx), static_cast<double>(m.vy)};
  }
  /// Angular velocity, anticlockwise [rad/s].
  double spin(int i) const { return static_cast<double>(system.motion(i).u) / grains.disc[i].radius; }
  void set_velocity(int i, base::Vec2 v) {
    system.motion(i).vx = static_cast<Real>(v.x);
    system.motion(i).vy = static_cast<Real>(v.y);
  }

  double weight() const {
    double mass = 0;
    for (const double m : grains.mass) mass += m;
    return mass * law.gravity;
  }
  base::Vec2 momentum() const {
    base::Vec2 sum;
    for (std::size_t i = 0; i < grains.count(); ++i) sum = sum + grains.mass[i] * velocity(static_cast<int>(i));
    return sum;
  }
  double kinetic_energy() const {
    double sum = 0;
    for (std::size_t i = 0; i < grains.count(); ++i) {
      const base::Vec2 v = velocity(static_cast<int>(i));
      const double u = static_cast<double>(system.motion(static_cast<std::int32_t>(i)).u);
      sum += 0.5 * grains.mass[i] * (dot(v, v) + 0.5 * u * u);
    }
    return sum;
  }
  double potential_energy() const {
    double sum = 0;
    for (std::size_t i = 0; i < grains.count(); ++i) sum += grains.mass[i] * law.gravity * grains.disc[i].y;
    return sum;
  }
  std::vector<grains::TouchingContact> touching() const {
    return touching_contacts(system, grains, body ? &*body : nullptr);
  }
};

/// Between two frictionless walls, as wide as the lattice of jittered_lattice().
template <class Solver>
ContactScene<Solver> heap(int count, int columns, double r_min, double r_max, std::uint64_t seed) {
  ContactScene<Solver> scene(jittered_lattice(count, columns, r_min, r_max, seed));
  scene.box = {0, columns * 2.04 * r_max, 0};
  return scene;
}

}  // namespace seapile::support
