// Preparation of a bed: drop, settle, and where a solid fraction is asked for, search the friction that gives it.
//
// Grains settled with less friction pack denser: the friction used while settling is the one knob, found by bisection
// in the logarithm (the solid fraction falls with it, monotonically but for the noise of a packing). After settling the
// grains' own friction is put back and the bed comes to rest once more. A bed is settled when the rms speed of the grains
// is below 1e-4 m/s and the base carries their weight within 0.1 %, both over 50 ms.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "solver/grains/deposit.h"
#include "solver/grains/packing.h"
#include "solver/simulation/build.h"
#include "solver/simulation/observe.h"
#include "solver/simulation/run.h"
#include "solver/simulation/settle.h"
#include "solver/simulation/step.h"
#include "solver/simulation/stepping.h"

namespace seapile::simulation {
namespace {

constexpr double kLeastFriction = 1e-3;     // below it nothing changes
constexpr int kMostTrials = 14;

std::span<const grains::Disc> discs(const Simulation& sim) { return {sim.grains.disc.data(), sim.grains.count()}; }

double surface(const Simulation& sim) { return grains::bed_surface(discs(sim), sim.box.left, sim.box.right); }

double solid_fraction(const Simulation& sim) {
  const double top = surface(sim);
  return grains::solid_fraction(discs(sim), sim.box.right - sim.box.left, grains::kBandBottom * top, grains::kBandTop * top);
}

grains::Grains start_of(const scene::BedSpec& bed, const std::vector<Array>& given) {
  if (!given.empty()) return grains_of(given, bed.grains.density);
  const grains::Box box{-bed.domain.width / 2, bed.domain.width / 2, 0};
  return grains::deposit(bed.grains, box, bed.seed);
}

}  // namespace

Bed prepare_bed(const scene::BedSpec& spec, const std::vector<Array>& given, const Execution& execution,
                const std::function<void(const Progress&)>& progress) {
  Bed bed;
  // Settling takes some multiples of the fall from the top of the heap; only the bar of the progress depends on this.
  const double guess = 1.5 + 2 * std::sqrt(2 * spec.domain.height / spec.domain.gravity);
  int trial = 0;
  const auto report = [&](double time) {
    const double share = std::min(0.99, time / guess);
    if (progress) progress({time, 1 - (1 - share) / std::max(trial, 1), std::numeric_limits<double>::quiet_NaN()});
  };

  // Settled with a friction, then at rest with the grains' own.
  const auto prepare = [&](double friction) {
    ++trial;
    bed.records.clear();
    Simulation sim = build_bed(spec, start_of(spec, given), friction, execution);
    Settled settled = settle(sim, spec.preparation.longest, execution.trying, bed.records, report);
    if (friction != spec.grains.friction.grain) {
      sim.law.friction_grain = spec.grains.friction.grain;
      const Settled again = settle(sim, spec.preparation.longest, execution.trying, bed.records, report);
      settled = {settled.time + again.time, again.base_error, again.rms_speed};
    }
    return std::pair(std::move(sim), settled);
  };

  double friction = spec.grains.friction.grain;
  auto [sim, settled] = prepare(spec.preparation.solid_fraction ? kLeastFriction : friction);
  if (spec.preparation.solid_fraction) {
    const double target = *spec.preparation.solid_fraction, tolerance = spec.preparation.tolerance;
    friction = kLeastFriction;
    double densest = solid_fraction(sim), low = kLeastFriction, high = 10, reached = densest;
    if (densest < target - tolerance)
      throw std::runtime_error("the bed cannot be made as dense as " + std::to_string(target) + ": without friction it reaches " +
                               std::to_string(densest));
    while (std::abs(reached - target) > tolerance) {
      if (trial > kMostTrials || high / low < 1.0001)
        throw std::runtime_error("no settling friction gives the solid fraction " + std::to_string(target) +
                                 "; nearest: " + std::to_string(reached) + " with friction " + std::to_string(friction));
      friction = std::sqrt(low * high);
      auto next = prepare(friction);
      sim = std::move(next.first);
      settled = next.second;
      reached = solid_fraction(sim);
      (reached > target ? low : high) = friction;
    }
  }

  bed.grains = arrays_of(sim.grains);
  const double top = surface(sim);
  double touching = 0;  // seen from the grains: a contact of two counts twice
  std::visit(
      [&, &sim = sim](const auto& system) {
        const grains::OverlapStatistics contacts = overlaps(system, sim.grains, nullptr);
        touching = static_cast<double>(contacts.touching + contacts.between_grains);
      },
      sim.contacts);
  const Record& last = bed.records.back();
  bed.metrics = {{"solid_fraction", solid_fraction(sim), "-", "area share of the grains between 15 and 85 % of the surface's height"},
                 {"coordination_number", touching / static_cast<double>(sim.grains.count()), "-", "touching contacts per grain"},
                 {"surface", top, "m", "mean over columns of 0.1 m of the top of the highest grain"},
                 {"settling_friction", friction, "-", "friction between grains while settling"},
                 {"settling_time", settled.time, "s", "simulated time until at rest"},
                 {"trials", static_cast<double>(trial), "-", "settlings needed to reach the target"},
                 {"rms_speed", settled.rms_speed, "m/s", "rms speed of the grains at rest"},
                 {"base_force_error", settled.base_error, "-", "base force over weight, less one"},
                 {"kinetic_energy", last.kinetic_energy, "J/m", "left, spin included"},
                 {"overlap_max", last.overlap_max, "-", "largest overlap"},
                 {"overlap_mean", last.overlap_mean, "-", "mean overlap of the touching contacts"}};
  std::ranges::move(metrics_of(sim.stepping, sim.clock.dt), std::back_inserter(bed.metrics));
  const double width = sim.box.right - sim.box.left;
  for (double y = 0; y < top; y += bed.profile_spacing)
    bed.porosity_profile.push_back(1 - grains::solid_fraction(discs(sim), width, y, y + bed.profile_spacing));
  for (const auto& e : sim.profile.entries()) bed.profile.push_back({e.part, e.seconds, e.calls});
  return bed;
}

}  // namespace seapile::simulation
