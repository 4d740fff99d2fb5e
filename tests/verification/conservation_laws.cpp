// What collisions keep, what they may only lose, and what the absence of friction forbids.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tests/verification/law.h"
#include "tests/verification/measure.h"

namespace seapile::verification {
namespace {

/// Discs that fly towards the origin, each a little astray, and meet there: nothing else acts.
Setup implosion(double restitution, double friction, std::uint64_t seed) {
  constexpr int kColumns = 8;
  Setup setup;
  setup.discs = support::jittered_lattice(kColumns * kColumns, kColumns, 0.012, 0.02, seed);
  const double middle = 0.5 * kColumns * 2.04 * 0.02;
  for (std::size_t i = 0; i < setup.discs.size(); ++i) {
    grains::Disc& d = setup.discs[i];
    d.x -= middle, d.y -= middle;
    setup.velocities.push_back(
        {-4 * d.x + base::uniform(-0.5, 0.5, seed, 3, i), -4 * d.y + base::uniform(-0.5, 0.5, seed, 4, i)});
    setup.surface_speeds.push_back(base::uniform(-0.5, 0.5, seed, 5, i));
  }
  setup.box.base = -support::kFar;
  setup.law.gravity = 0;
  setup.law.restitution = restitution;
  setup.law.friction_grain = friction;
  return setup;
}

std::vector<Row> free_cluster(const Solver& solver, Size) {
  std::vector<Row> rows;
  for (const double e : {0.0, 0.5, 1.0}) {
    Worst linear, angular, energy;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const auto run = solver.start(implosion(e, 0.5, seed));
      double scale = 0, turning = 0;
      for (int i = 0; i < run->count(); ++i) {
        const double p = run->mass(i) * norm(run->velocity(i));
        scale += p, turning += p * std::hypot(run->disc(i).x, run->disc(i).y);
      }
      const base::Vec2 before = momentum(*run);
      const double spin_before = angular_momentum(*run), energy_before = kinetic_energy(*run);
      double largest = 0;
      for (int k = 0; k < 600; ++k) {
        const double now = kinetic_energy(*run);
        run->step();
        largest = std::max(largest, (kinetic_energy(*run) - now) / energy_before);
      }
      const std::string where = fmt::format("cluster {}", seed);
      linear.add(where, norm(momentum(*run) - before) / scale, 0, 100 * solver.rounding);
      angular.add(where, (angular_momentum(*run) - spin_before) / turning, 0, 2e-3);
      energy.add(where, largest, 0, 1e-3);
    }
    const std::string of = fmt::format(", e = {}", e);
    rows.push_back(linear.row("change of momentum over the sum of its magnitudes" + of, "-",
                              "rounding of each impulse on either grain"));
    rows.push_back(angular.row("change of angular momentum over the sum of its magnitudes" + of, "-",
                               "normals stay within a step and friction's arms are the radii: 0.2 %"));
    rows.push_back(energy.row("largest growth of the kinetic energy in a step, as a share" + of, "-",
                              "a soft contact gives back what its overlap holds: 0.1 %"));
  }
  return rows;
}

// Only single impacts are exact: those that fall into one step are solved one after the other, which loses energy in
// proportion to the step.
std::vector<Row> elastic_cluster(const Solver& solver, Size) {
  std::vector<Row> rows;
  for (const double step : solver.slow ? std::vector{5e-4} : std::vector{5e-4, 1e-4, 2e-5}) {
    Worst energy;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      Setup setup = implosion(1, 0, seed);
      setup.law.step = step;
      const auto run = solver.start(setup);
      const double before = kinetic_energy(*run);
      run->run(0.3);
      energy.add(fmt::format("cluster {}, dt = {} s", seed, step), kinetic_energy(*run) / before, 1, 300 * step);
    }
    rows.push_back(energy.row(fmt::format("kinetic energy after over before, dt = {} s", step), "-",
                              "3 % for each 1e-4 s of the step: impacts in one step are solved one by one"));
  }
  return rows;
}

/// Kinetic and potential energy; a sub-step moves the velocities first, so that places belong half a sub-step later.
double mechanical_energy(Running& run) {
  return kinetic_energy(run) + potential_energy(run) - 0.5 * run.substep() * run.law().gravity * momentum(run).y;
}

std::vector<Row> falling_heap(const Solver& solver, Size) {
  std::vector<Row> rows;
  for (const double e : {0.0, 0.5, 1.0}) {
    Setup setup;
    setup.discs = support::jittered_lattice(48, 8, 0.012, 0.02, 1);
    setup.box = {0, 8 * 2.04 * 0.02, 0};
    setup.law.friction_wall = 0.3;
    setup.law.restitution = e;
    const auto run = solver.start(setup);
    const double start = mechanical_energy(*run);
    double largest = 0, last = start;
    for (int k = 0; k < 2000; ++k) {
      run->step();
      const double now = mechanical_energy(*run);
      largest = std::max(largest, now - last);
      last = now;
    }
    rows.push_back({"largest growth of kinetic and potential energy in a step, as a share", "-",
                    fmt::format("e = {}", e), largest / start, 0, 1e-3,
                    "a soft contact gives back what its overlap holds: 0.1 %", Relation::at_most});
    rows.push_back({"energy after 1 s over that at the start", "-", fmt::format("e = {}", e), last / start, 1, 0,
                    "nothing does work on it", Relation::at_most});
  }
  return rows;
}

std::vector<Row> frictionless(const Solver& solver, Size) {
  const int columns = solver.fast ? 14 : 6, count = solver.fast ? 150 : 30;
  Setup heap;
  heap.discs = support::jittered_lattice(count, columns, 0.012, 0.02, 1);
  heap.box = {0, columns * 2.04 * 0.02, 0};
  heap.law.friction_grain = 0;
  const auto run = solver.start(heap);
  double spin = 0, tangential = 0;
  for (int k = 0; k < 1500; ++k) {
    run->step();
    for (const grains::TouchingContact& c : run->contacts()) tangential = std::max(tangential, std::abs(c.pt));
  }
  for (int i = 0; i < count; ++i) spin = std::max(spin, std::abs(run->surface_speed(i)));

  Setup sliding{{{0, 0.03, 0.02, 0}}};
  sliding.velocities = {{1.5, 0}};
  sliding.surface_speeds = {0.25};
  const auto disc = solver.start(sliding);
  disc->run(1);
  const char* const why = "no force, not a bit";
  return {{"largest surface speed in a heap", "m/s", "", spin, 0, 0, why},
          {"largest tangential impulse in a heap", "N s/m", "", tangential, 0, 0, why},
          {"velocity of a disc that fell on a smooth base at 1.5 m/s", "m/s", "", disc->velocity(0).x, 1.5, 0, why},
          {"its surface speed, 0.25 m/s at the start", "m/s", "", disc->surface_speed(0), 0.25, 0, why}};
}

}  // namespace

std::vector<Law> conservation_laws() {
  return {{"AFreeClusterKeepsItsMomentum", free_cluster},
          {"AnElasticClusterKeepsItsEnergyAsTheStepGoesToZero", elastic_cluster},
          {"EnergyDoesNotGrowWithoutWork", falling_heap},
          {"WithoutFrictionNothingSpins", frictionless}};
}

}  // namespace seapile::verification
