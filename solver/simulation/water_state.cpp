#include "solver/simulation/water_state.h"

#include "solver/simulation/basin_state.h"
#include "solver/simulation/flow_state.h"

namespace seapile::simulation {
namespace {

constexpr const char* kPrefix = "water/";

void add_gathering(std::vector<Array>& state, const std::string& name, const WaterGathering& g) {
  state.push_back({{name + "/steps", "-", "steps of the fluid, and those with u3", 1, Entity::run},
                   std::vector<std::int64_t>{g.steps, g.sleeve_steps}});
  state.push_back(
      {{name + "/sums", "-",
        "forces on tip (2), sleeve (2), grains (2), pressures at face, shoulder, sleeve, lowest porosity, "
        "clipped volume",
        1, Entity::run},
       std::vector<double>{g.tip_force.x, g.tip_force.y, g.sleeve_force.x, g.sleeve_force.y, g.grain_force.x,
                           g.grain_force.y, g.face, g.shoulder, g.sleeve, g.lowest_porosity, g.clipped_volume}});
}

WaterGathering gathering_of(const std::vector<Array>& state, const std::string& name) {
  const auto& steps = array_of<std::int64_t>(state, name + "/steps", 2);
  const auto& s = array_of<double>(state, name + "/sums", 11);
  return {steps[0], steps[1], {s[0], s[1]}, {s[2], s[3]}, {s[4], s[5]}, s[6], s[7], s[8], s[9], s[10]};
}

std::vector<double> places(const std::vector<grains::Disc>& disc) {
  std::vector<double> place;
  for (const grains::Disc& d : disc) place.insert(place.end(), {d.x, d.y});
  return place;
}

}  // namespace

bool is_of_water(const Array& array) { return array.info.name.starts_with(kPrefix); }

std::vector<Array> snapshot(const Water& water) {
  std::vector<Array> state = snapshot(water.basin);
  state.insert(
      state.end(),
      {{{"grains/drag", "N/m", "drag of the last exchange", 2, Entity::grain}, flat(water.drag)},
       {{"grains/pressure", "N/m", "force of the last exchange's pressure", 2, Entity::grain}, flat(water.pressure)},
       {{"grains/velocity", "m/s", "velocity when the fluid's last step began", 2, Entity::grain},
        flat(water.velocity)},
       {{"grains/expected", "m", "place where the fluid's last step expected it", 2, Entity::grain},
        places(water.expected.disc)}});
  add_gathering(state, "gathering", water.gathering);
  add_gathering(state, "recorded", water.recorded);
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
  std::vector<grains::Disc> expected = water.expected.disc;
  const auto& place = array_of<double>(state, "grains/expected", 2 * count);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    expected[i].x = place[2 * i];
    expected[i].y = place[2 * i + 1];
  }
  back.expected = coupling::put_on(back.basin.flow.mesh, back.location, std::move(expected), back.coupling.porosity,
                                   back.basin.solver.instructions, nullptr);
  back.around = coupling::surroundings(back.basin.flow, back.expected.deposit);
  back.gathering = gathering_of(state, "gathering");
  back.recorded = gathering_of(state, "recorded");
  water = std::move(back);
}

}  // namespace seapile::simulation
