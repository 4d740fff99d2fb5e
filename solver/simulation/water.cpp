#include "solver/simulation/water.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/basin/remesh.h"
#include "solver/basin/step.h"
#include "solver/coupling/exchange.h"
#include "solver/coupling/porosity.h"
#include "solver/simulation/basin_state.h"
#include "solver/simulation/simulation.h"

namespace seapile::simulation {
namespace {

std::vector<base::Vec2> velocities_of(const Simulation& sim) {
  std::vector<base::Vec2> velocity(sim.grains.count());
  std::visit(
      [&](const auto& system) {
        for (std::size_t i = 0; i < velocity.size(); ++i) {
          const auto& m = system.motion(static_cast<std::int32_t>(i));
          velocity[i] = {static_cast<double>(m.vx), static_cast<double>(m.vy)};
        }
      },
      sim.contacts);
  return velocity;
}

std::span<const grains::Disc> discs_of(const Simulation& sim) { return {sim.grains.disc.data(), sim.grains.count()}; }

/// The grains on one mesh.
struct OnMesh {
  coupling::Deposit deposit;
  std::vector<double> volume;  ///< of the vertices
  coupling::Porosity porosity;
};
OnMesh put_on(const mesh::TriangleMesh& mesh, coupling::Location& location, std::span<const grains::Disc> disc,
              const coupling::PorositySpec& spec, base::Crew* crew) {
  OnMesh on{coupling::deposit(mesh, location, disc, spec.kernel, crew), coupling::vertex_volume(mesh), {}};
  on.porosity = coupling::porosity(coupling::solid_volume(on.deposit, on.volume.size()), on.volume, spec.least);
  return on;
}

double immersed_share(const coupling::Deposit& deposit, std::span<const grains::Disc> disc) {
  double inside = 0, all = 0;
  for (std::size_t i = 0; i < disc.size(); ++i) {
    inside += coupling::immersed_volume(deposit, i);
    all += std::numbers::pi * disc[i].radius * disc[i].radius;
  }
  return inside / all;
}

void gather(Water& water, const OnMesh& on, std::span<const grains::Disc> disc) {
  WaterGathering& g = water.gathering;
  ++g.steps;
  for (std::size_t i = 0; i < water.drag.size(); ++i) g.grain_force = g.grain_force + water.drag[i] + water.pressure[i];
  g.lowest_porosity = std::min(g.lowest_porosity, on.porosity.lowest);
  g.clipped_volume = std::max(g.clipped_volume, on.porosity.clipped);
  g.immersed = immersed_share(on.deposit, disc);
  if (!water.basin.spec.pile) return;
  g.tip_force = g.tip_force + water.basin.tip_force;
  g.sleeve_force = g.sleeve_force + water.basin.sleeve_force;
  const basin::PorePressure pore = basin::pore_pressure(water.basin);
  g.face += pore.face;
  g.shoulder += pore.shoulder;
  if (!pore.sleeve) return;
  g.sleeve += *pore.sleeve;
  ++g.sleeve_steps;
}

}  // namespace

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
  OnMesh on = put_on(water.basin.flow.mesh, water.location, discs_of(sim), water.coupling.porosity, nullptr);
  water.basin.flow.porosity = on.porosity.phi;
  water.basin.past.level[0].porosity = std::move(on.porosity.phi);
  return water;
}

std::string step_water(Simulation& sim) {
  Water& water = *sim.water;
  basin::Basin& basin = water.basin;
  const double dt = basin.spec.time.step;
  base::Crew* crew = sim.team.crew.get();
  const std::size_t count = sim.grains.count(), in_deposit = sim.profile.index("porosity"),
                    in_exchange = sim.profile.index("exchange");

  // The grains where they are, on the mesh as it is.
  const std::vector<base::Vec2> velocity = velocities_of(sim);
  OnMesh now;
  {
    const base::Stopwatch watch(sim.profile, in_deposit);
    now = put_on(basin.flow.mesh, water.location, discs_of(sim), water.coupling.porosity, crew);
  }
  basin.flow.porosity = now.porosity.phi;
  basin.past.level[0].porosity = now.porosity.phi;

  // Where they will be if this step's exchange is none, and what they then answer to drag.
  std::vector<grains::Disc> ahead(discs_of(sim).begin(), discs_of(sim).end());
  coupling::Suspended suspended{sim.grains.mass, {}, std::vector<base::Vec2>(count)};
  {
    const base::Stopwatch watch(sim.profile, in_exchange);
    suspended.drag = coupling::drag_coefficients(water.coupling.drag, basin.flow, now.deposit, discs_of(sim), velocity);
    for (std::size_t i = 0; i < count; ++i) {
      const double mass = sim.grains.mass[i];
      suspended.drag[i] *= mass / (mass + dt * suspended.drag[i]);
      suspended.velocity[i] = 2 * velocity[i] - water.velocity[i] - (dt / mass) * water.drag[i];
      const base::Vec2 way = dt * (velocity[i] - (dt / mass) * (water.drag[i] + water.pressure[i]));
      ahead[i].x += way.x;
      ahead[i].y += way.y;
    }
  }

  OnMesh then;
  coupling::Forces forces;
  basin::Suspension suspension;
  suspension.moved = [&](basin::Basin& moved) {
    {
      const base::Stopwatch watch(sim.profile, in_deposit);
      then = put_on(moved.flow.mesh, water.location, ahead, water.coupling.porosity, crew);
    }
    const base::Stopwatch watch(sim.profile, in_exchange);
    moved.flow.porosity = then.porosity.phi;
    coupling::set_porosity_rate(moved.flow, moved.past, moved.solver.order);
    coupling::put_grains(moved.flow, then.deposit, then.volume, then.porosity.kept, suspended, dt);
  };
  suspension.solved = [&](const basin::Basin& solved) {
    const base::Stopwatch watch(sim.profile, in_exchange);
    forces = coupling::forces_on(then.deposit, solved.flow, then.volume, then.porosity.kept, suspended);
  };
  suspension.remeshed = [&](fluid::Flow& flow) {
    coupling::Location location(flow.mesh);
    const OnMesh from = put_on(flow.mesh, location, discs_of(sim), water.coupling.porosity, crew),
                 to = put_on(flow.mesh, location, ahead, water.coupling.porosity, crew);
    flow.porosity = to.porosity.phi;
    for (std::size_t v = 0; v < flow.porosity.size(); ++v)
      flow.porosity_rate[v] = (to.porosity.phi[v] - from.porosity.phi[v]) / dt;
    water.location = std::move(location);
  };
  if (std::string why = basin::step(basin, sim.profile, suspension); !why.empty()) return why;

  water.drag = std::move(forces.drag);
  water.pressure = std::move(forces.pressure);
  water.velocity = velocity;
  sim.grains.push.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double radius = sim.grains.disc[i].radius, area = std::numbers::pi * radius * radius,
                 outside = std::max(0.0, 1 - coupling::immersed_volume(then.deposit, i) / area);
    sim.grains.push[i] =
        (1 / sim.grains.mass[i]) * (water.drag[i] + water.pressure[i]) - base::Vec2{0, water.buoyancy * outside};
  }
  gather(water, then, discs_of(sim));
  return {};
}

FlowRecord take_flow_record(Simulation& sim) {
  Water& water = *sim.water;
  FlowRecord record = record_of(water.basin);
  const WaterGathering& g = water.gathering;
  if (g.steps > 0) {
    const double share = 1 / static_cast<double>(g.steps);
    record.grain_force_x = share * g.grain_force.x;
    record.grain_force_y = share * g.grain_force.y;
    record.grain_work = sim.totals.push_work;
    record.lowest_porosity = g.lowest_porosity;
    record.clipped_volume = g.clipped_volume;
    record.immersed = g.immersed;
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
  double shortest = 1e300, largest = 0;
  for (const auto& t : water.basin.flow.mesh.triangle)
    for (int k = 0; k < 3; ++k)
      shortest = std::min(shortest, norm(water.basin.flow.mesh.position[t[k]] -
                                         water.basin.flow.mesh.position[t[(k + 1) % 3]]));
  for (const grains::Disc& disc : discs_of(sim)) largest = std::max(largest, 2 * disc.radius);
  record.element_ratio = shortest / largest;
  water.gathering = {};
  return record;
}

}  // namespace seapile::simulation
