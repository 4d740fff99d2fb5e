// Grains in a box of water on a regular mesh, without a pile: what the laws of the coupling are stated on.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "solver/grains/contact_lists.h"
#include "solver/simulation/simulation.h"
#include "solver/simulation/step.h"
#include "solver/simulation/water.h"

namespace seapile::support {

struct Immersed {
  double width = 1, depth = 1;                  ///< of the water [m]; x in [-width/2, width/2], y in [0, depth]
  std::int64_t columns = 10, rows = 10;         ///< of rectangles, halved; columns even
  double density = 1000, grain_density = 1500;  ///< [kg/m3]
  double kinematic_viscosity = 1e-6;            ///< [m2/s]
  double gravity = 9.81;                        ///< [m/s2]
  double step = 1e-3;                           ///< of the fluid [s]
  int grain_steps = 1;                          ///< in a step of the fluid
  int substeps = 10;                            ///< in a step of the grains
  std::int64_t order = 1;                       ///< in time
  bool surface = false;                         ///< free; otherwise an open top at fixed height
  double tolerance = 1e-10;                     ///< of the flow's equations
  coupling::CouplingSpec coupling = {};
};

/// Double precision throughout.
inline simulation::Simulation immersed(const Immersed& scene, const std::vector<grains::Disc>& discs) {
  simulation::Simulation sim;
  sim.clock.dt = scene.step / scene.grain_steps;
  sim.box = {-0.5 * scene.width, 0.5 * scene.width, 0};
  sim.law.gravity = scene.gravity * (1 - scene.density / scene.grain_density);
  sim.law.step = sim.clock.dt;
  sim.law.substeps = scene.substeps;
  for (const grains::Disc& d : discs) {
    sim.grains.id.push_back(static_cast<std::int64_t>(sim.grains.id.size()));
    sim.grains.disc.push_back(d);
    sim.grains.mass.push_back(scene.grain_density * std::numbers::pi * d.radius * d.radius);
    sim.origin.push_back({d.x, d.y});
  }
  sim.contacts.emplace<grains::ContactSystem<double>>();
  std::visit([&](auto& system) { enclose(system, sim.grains); }, sim.contacts);
  sim.totals.feature.resize(2);

  basin::BasinSpec basin;
  basin.width = scene.width;
  basin.depth = scene.depth;
  basin.gravity = scene.gravity;
  basin.density = scene.density;
  basin.viscosity = scene.density * scene.kinematic_viscosity;
  if (!scene.surface) basin.surface.reset();
  basin.mesh.pattern = basin::StructuredMesh{scene.columns, scene.rows};
  basin.time.step = scene.step;
  basin.time.order = scene.order;
  basin.time.tolerance = scene.tolerance;
  basin.time.iterated = false;
  sim.water.emplace(water_around(sim, basin, scene.coupling, scene.grain_density));
  return sim;
}

inline base::Vec2 velocity_of(const simulation::Simulation& sim, std::size_t grain) {
  return std::visit(
      [&](const auto& system) {
        const auto& m = system.motion(static_cast<std::int32_t>(grain));
        return base::Vec2{static_cast<double>(m.vx), static_cast<double>(m.vy)};
      },
      sim.contacts);
}

/// sum m v of the grains [kg/s].
inline base::Vec2 momentum_of_grains(const simulation::Simulation& sim) {
  base::Vec2 sum;
  for (std::size_t i = 0; i < sim.grains.count(); ++i) sum = sum + sim.grains.mass[i] * velocity_of(sim, i);
  return sum;
}

}  // namespace seapile::support
