// A record of the water of a saturated drive: the basin's, and what was gathered on the grains since the last one.
#include <algorithm>
#include <numbers>
#include <utility>

#include "solver/simulation/basin_state.h"
#include "solver/simulation/simulation.h"
#include "solver/simulation/water.h"

namespace seapile::simulation {

FlowRecord take_flow_record(Simulation& sim) {
  Water& water = *sim.water;
  FlowRecord record = record_of(water.basin);
  if (water.gathering.steps > 0) water.recorded = std::exchange(water.gathering, {});
  record.grain_work = sim.totals.push_work;
  const WaterGathering& g = water.recorded;
  if (g.steps > 0) {
    const double share = 1 / static_cast<double>(g.steps);
    record.grain_force_x = share * g.grain_force.x;
    record.grain_force_y = share * g.grain_force.y;
    record.lowest_porosity = g.lowest_porosity;
    record.clipped_volume = g.clipped_volume;
    if (sim.pile) {
      record.tip_force_x = share * g.tip_force.x;
      record.tip_force_y = share * g.tip_force.y;
      record.sleeve_force_x = share * g.sleeve_force.x;
      record.sleeve_force_y = share * g.sleeve_force.y;
      record.face_pressure = share * g.face;
      record.shoulder_pressure = share * g.shoulder;
      if (g.sleeve_steps > 0) record.sleeve_pressure = g.sleeve / static_cast<double>(g.sleeve_steps);
    }
  }
  double in_mesh = 0, all = 0;
  for (std::size_t i = 0; i < water.expected.disc.size(); ++i) {
    in_mesh += water.expected.deposit.immersed[i];
    all += std::numbers::pi * water.expected.disc[i].radius * water.expected.disc[i].radius;
  }
  record.immersed = in_mesh / all;
  double shortest = 1e300, largest = 0;
  for (const auto& t : water.basin.flow.mesh.triangle)
    for (int k = 0; k < 3; ++k)
      shortest = std::min(shortest,
                          norm(water.basin.flow.mesh.position[t[k]] - water.basin.flow.mesh.position[t[(k + 1) % 3]]));
  for (std::size_t i = 0; i < sim.grains.count(); ++i) largest = std::max(largest, 2 * sim.grains.disc[i].radius);
  record.element_ratio = shortest / largest;
  return record;
}

}  // namespace seapile::simulation
