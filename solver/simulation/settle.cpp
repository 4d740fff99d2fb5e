#include "solver/simulation/settle.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "solver/simulation/objection.h"
#include "solver/simulation/observe.h"
#include "solver/simulation/step.h"

namespace seapile::simulation {
namespace {

constexpr double kRecordTime = 0.01;     // [s] between two records
constexpr double kRestTime = 0.05;       // [s] over which a bed must be at rest
constexpr double kRestSpeed = 1e-4;      // [m/s] rms
constexpr double kRestBaseError = 1e-3;  // of the weight

double rms_speed(const Simulation& sim) {
  double sum = 0;
  for (const base::Vec2 v : velocities_of(sim)) sum += dot(v, v);
  return std::sqrt(sum / static_cast<double>(sim.grains.count()));
}

double weight(const Simulation& sim) {
  double mass = 0;
  for (const double m : sim.grains.mass) mass += m;
  return mass * sim.law.gravity;
}

}  // namespace

Settled settle(Simulation& sim, double longest, std::vector<Record>& records,
               const std::function<void(double)>& progress) {
  const double start = sim.clock.time(), heavy = weight(sim);
  int at_rest = 0;
  Settled settled;
  while (at_rest < std::lround(kRestTime / kRecordTime)) {
    const double until = sim.clock.time() + kRecordTime;
    while (sim.clock.time() < until - 0.5 * sim.clock.dt) {
      const StepReport report = step(sim);
      if (const Objection why = objection(sim, report); !why.empty())
        throw std::runtime_error("the bed does not settle: " + why.why);
      gather(sim, report);
    }
    records.push_back(take_record(sim));
    settled = {sim.clock.time() - start, std::abs(records.back().base_force / heavy - 1), rms_speed(sim)};
    at_rest = settled.rms_speed < kRestSpeed && settled.base_error < kRestBaseError ? at_rest + 1 : 0;
    progress(settled.time);
    if (settled.time > longest)
      throw std::runtime_error("the bed is not at rest after the longest settling time: rms speed " +
                               std::to_string(settled.rms_speed) + " m/s, base force off by " +
                               std::to_string(100 * settled.base_error) + " %");
  }
  return settled;
}

}  // namespace seapile::simulation
