#include "solver/simulation/water_state.h"

#include "solver/simulation/basin_state.h"
#include "solver/simulation/flow_state.h"

namespace seapile::simulation {
namespace {

constexpr const char* kPrefix = "water/";

}  // namespace

bool is_of_water(const Array& array) { return array.info.name.starts_with(kPrefix); }

std::vector<Array> snapshot(const Water& water) {
  std::vector<Array> state = snapshot(water.basin);
  const WaterGathering& g = water.gathering;
  state.insert(
      state.end(),
      {{{"grains/drag", "N/m", "drag of the last exchange", 2, Entity::grain}, flat(water.drag)},
       {{"grains/pressure", "N/m", "force of the last exchange's pressure", 2, Entity::grain}, flat(water.pressure)},
       {{"grains/velocity", "m/s", "velocity when the fluid's last step began", 2, Entity::grain}, flat(water.velocity)},
       {{"gathering/steps", "-", "steps of the fluid since the last record, and those with u3", 1, Entity::run},
        std::vector<std::int64_t>{g.steps, g.sleeve_steps}},
       {{"gathering/sums", "-",
         "forces on tip (2), sleeve (2), grains (2), pressures at face, shoulder, sleeve, lowest porosity, clipped volume, "
         "share in the water",
         1, Entity::run},
        std::vector<double>{g.tip_force.x, g.tip_force.y, g.sleeve_force.x, g.sleeve_force.y, g.grain_force.x,
                            g.grain_force.y, g.face, g.shoulder, g.sleeve, g.lowest_porosity, g.clipped_volume,
                            g.immersed}}});
  for (Array& array : state) array.info.name = kPrefix + array.info.name;
  return state;
}

void restore(Water& water, const std::vector<Array>& all) {
  std::vector<Array> state;
  for (const Array& array : all) {
    if (!is_of_water(array)) continue;
    state.push_back(array);
    state.back().info.name.erase(0, std::string(kPrefix).size());
  }
  const auto count = static_cast<std::ptrdiff_t>(water.drag.size());
  Water back{.basin = restored(water.basin.spec, water.basin.solver.instructions, state),
             .coupling = water.coupling,
             .location = water.location,
             .grain_steps = water.grain_steps,
             .buoyancy = water.buoyancy};
  back.basin.flow.porosity = back.basin.past.level.at(0).porosity;
  back.location = coupling::Location(back.basin.flow.mesh);
  back.drag = vectors(array_of<double>(state, "grains/drag", 2 * count));
  back.pressure = vectors(array_of<double>(state, "grains/pressure", 2 * count));
  back.velocity = vectors(array_of<double>(state, "grains/velocity", 2 * count));
  const auto& steps = array_of<std::int64_t>(state, "gathering/steps", 2);
  const auto& sums = array_of<double>(state, "gathering/sums", 12);
  back.gathering = {steps[0], steps[1], {sums[0], sums[1]}, {sums[2], sums[3]}, {sums[4], sums[5]}, sums[6], sums[7],
                    sums[8],  sums[9],  sums[10],           sums[11]};
  water = std::move(back);
}

}  // namespace seapile::simulation
