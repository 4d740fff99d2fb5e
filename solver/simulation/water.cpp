#include "solver/simulation/water.h"

#include <cmath>
#include <utility>

#include "solver/basin/remesh.h"
#include "solver/simulation/simulation.h"

namespace seapile::simulation {

basin::BasinSpec basin_of(const scene::SceneSpec& scene, double tip) {
  const scene::FluidSpec& fluid = *scene.fluid;
  basin::BasinSpec basin;
  basin.width = scene.bed.domain.width;
  basin.depth = fluid.depth;
  basin.gravity = scene.bed.domain.gravity;
  basin.density = fluid.density;
  basin.viscosity = fluid.density * fluid.kinematic_viscosity;
  basin.walls = fluid.walls;
  basin.bottom = fluid.bottom;
  basin.surface = fluid.surface;
  basin.convection = fluid.convection;
  if (scene.pile)
    basin.pile = basin::BasinPileSpec{scene.pile->radius, scene.pile->tip, scene.pile->driving, fluid.depth - tip};
  basin.mesh = {basin::UnstructuredMesh{fluid.mesh.size, fluid.mesh.pile_size, fluid.mesh.growth}, fluid.mesh.motion,
                fluid.mesh.remesh};
  basin.time.step = fluid.time.step;
  basin.time.order = fluid.time.order;
  basin.time.tolerance = fluid.time.tolerance;
  basin.time.rate = fluid.time.rate;
  // The grains are found once on the moved domain; waves of the surface are slow beside the step.
  basin.time.iterated = false;
  return basin;
}

Water water_around(const Simulation& sim, const basin::BasinSpec& spec, const coupling::CouplingSpec& coupling,
                   double grain_density) {
  basin::Basin basin = basin::filled(spec, sim.team.instructions);
  coupling::Location location(basin.flow.mesh);
  Water water{.basin = std::move(basin), .coupling = coupling, .location = std::move(location)};
  water.grain_steps = static_cast<int>(std::lround(spec.time.step / sim.clock.dt));
  water.buoyancy = spec.density / grain_density * spec.gravity;
  water.drag.assign(sim.grains.count(), {});
  water.pressure.assign(sim.grains.count(), {});
  water.velocity = velocities_of(sim);
  // The mesh's first porosity is that of the grains.
  water.expected =
      coupling::put_on(water.basin.flow.mesh, water.location, {sim.grains.disc.begin(), sim.grains.disc.end()},
                       water.coupling.porosity, sim.team.instructions, nullptr);
  water.basin.flow.porosity = water.expected.porosity.phi;
  water.basin.past.level[0].porosity = water.expected.porosity.phi;
  water.around = coupling::surroundings(water.basin.flow, water.expected.deposit);
  return water;
}

void remesh_water(Simulation& sim) {
  Water& water = *sim.water;
  const double dt = water.basin.clock.size();
  coupling::OnMesh renewed;
  basin::remesh(water.basin, [&](fluid::Flow& flow) {
    water.location = coupling::Location(flow.mesh);
    const auto put = [&](std::vector<grains::Disc> disc) {
      return coupling::put_on(flow.mesh, water.location, std::move(disc), water.coupling.porosity,
                              sim.team.instructions, sim.team.crew.get());
    };
    std::vector<grains::Disc> before = water.expected.disc;
    const std::vector<base::Vec2> velocity = velocities_of(sim);
    for (std::size_t i = 0; i < before.size(); ++i) {
      before[i].x -= dt * velocity[i].x;
      before[i].y -= dt * velocity[i].y;
    }
    const coupling::OnMesh from = put(std::move(before));
    renewed = put(water.expected.disc);
    flow.porosity = renewed.porosity.phi;
    for (std::size_t v = 0; v < flow.porosity.size(); ++v)
      flow.porosity_rate[v] = (flow.porosity[v] - from.porosity.phi[v]) / dt;
  });
  water.expected = std::move(renewed);
  water.around = coupling::surroundings(water.basin.flow, water.expected.deposit);
}

}  // namespace seapile::simulation
