// What the laws of grains in water are measured with: closed forms, written out here once more, and the water at a
// grain.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "solver/coupling/deposit.h"
#include "solver/coupling/drag.h"
#include "solver/simulation/objection.h"
#include "tests/support/immersed_scene.h"

namespace seapile::simulation {

inline constexpr double kGravity = 9.81, kGrainDensity = 1500, kViscosity = 1e-6;  // [m/s2, kg/m3, m2/s]

inline double sphere_coefficient(double reynolds) { return std::pow(0.63 + 4.8 / std::sqrt(reynolds), 2); }

/// Of the plane, or of spheres packed alike, for which the law of drag asks (solver/coupling/drag.h).
inline double porosity_in_law(const coupling::DragSpec& law, double porosity) {
  return law.porosity == coupling::DragPorosity::plane
             ? porosity
             : 1 - 2 / std::sqrt(std::numbers::pi * std::sqrt(3.0)) * std::pow(1 - porosity, 1.5);
}

/// U in U^2 C_d(U) phi_d^-4.8 = pi/2 |rho_p - rho|/rho g d: the superficial slip that carries discs among others
/// (Dallavalle's law) [m/s].
inline double carrying_slip(double diameter, double density, double porosity_of_law,
                            double grain_density = kGrainDensity) {
  const double wanted = std::numbers::pi / 2 * std::abs(grain_density - density) / density * kGravity * diameter *
                        std::pow(porosity_of_law, 4.8);
  double low = 1e-12, high = 1e3;
  for (int k = 0; k < 200; ++k) {
    const double u = std::sqrt(low * high);
    (u * u * sphere_coefficient(u * diameter / kViscosity) < wanted ? low : high) = u;
  }
  return low;
}

/// -dp/dx of a bed of discs that superficial velocity u goes through (Dallavalle's law) [Pa/m].
inline double bed_gradient(const coupling::DragSpec& law, double diameter, double density, double porosity, double u) {
  return 2 / std::numbers::pi * (1 - porosity) * density * sphere_coefficient(u * diameter / kViscosity) * u * u *
         std::pow(porosity_in_law(law, porosity), -4.8) / diameter;
}

/// The water at a grain, as the grain's drag sees it.
struct AtGrain {
  base::Vec2 velocity;  ///< v_f [m/s]
  double porosity = 0;
};
inline std::vector<AtGrain> water_at_grains(const Simulation& sim) {
  const fluid::Flow& flow = sim.water->basin.flow;
  coupling::Location location(flow.mesh);
  const coupling::Deposit on = coupling::deposit(flow.mesh, location, {sim.grains.disc.data(), sim.grains.count()});
  std::vector<AtGrain> at(sim.grains.count());
  for (std::size_t i = 0; i < at.size(); ++i) {
    double all = 0;
    for (std::int32_t k = on.first[i]; k < on.first[i + 1]; ++k) all += on.volume[k];
    for (std::int32_t k = on.first[i]; k < on.first[i + 1]; ++k) {
      const std::int32_t v = on.vertex[k];
      const double share = on.volume[k] / all;
      at[i].velocity = at[i].velocity + (share / flow.porosity[v]) *
                                            base::Vec2{flow.u(v, fluid::kVelocityX), flow.u(v, fluid::kVelocityY)};
      at[i].porosity += share * flow.porosity[v];
    }
  }
  return at;
}

/// Water enters through the bottom.
inline void hold_inflow(Simulation& sim, double u) {
  fluid::Flow& flow = sim.water->basin.flow;
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v)
    if (flow.mesh.position[v].y == 0) fluid::hold(flow, static_cast<std::int32_t>(v), fluid::kVelocityY, u);
}

/// One step that nothing objects to.
inline void take_step(Simulation& sim) { ASSERT_EQ(objection(sim, step(sim)).why, ""); }
inline void take_steps(Simulation& sim, int count) {
  for (int k = 0; k < count && !testing::Test::HasFatalFailure(); ++k) take_step(sim);
}

/// Mean excess pressure along a horizontal line of vertices of an even grid [Pa].
inline double pressure_at_height(const Simulation& sim, double height) {
  const fluid::Flow& flow = sim.water->basin.flow;
  const double wall = sim.box.right - 1e-9 * (sim.box.right - sim.box.left);
  double sum = 0, weight = 0;
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v) {
    const base::Vec2 at = flow.mesh.position[v];
    if (std::abs(at.y - height) > 1e-9 * sim.water->basin.spec.depth) continue;
    const double share = std::abs(at.x) > wall ? 0.5 : 1;
    sum += share * flow.u(static_cast<std::int32_t>(v), fluid::kPressure);
    weight += share;
  }
  return sum / weight;
}

/// Weight of the grains less their buoyancy [N/m].
inline double buoyant_weight(const Simulation& sim) {
  double mass = 0;
  for (const double m : sim.grains.mass) mass += m;
  return mass * sim.law.gravity;
}

/// Force of the water on all grains in the last step, without the hydrostatic one [N/m].
inline base::Vec2 force_on_grains(const Simulation& sim) {
  base::Vec2 sum;
  for (std::size_t i = 0; i < sim.grains.count(); ++i) sum = sum + sim.water->drag[i] + sim.water->pressure[i];
  return sum;
}

}  // namespace seapile::simulation
