// Many grains in still water: as a lattice they fall by Richardson and Zaki, as a cloud faster than one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "solver/coupling/porosity.h"
#include "tests/solver/simulation/immersed_laws.h"

namespace seapile::simulation {
namespace {

constexpr double kWater = 1000;  // [kg/m3]

double diameter_for(double reynolds) {
  double low = 1e-8, high = 1;
  for (int k = 0; k < 200; ++k) {
    const double d = std::sqrt(low * high);
    (carrying_slip(d, kWater, 1) * d / kViscosity < reynolds ? low : high) = d;
  }
  return low;
}

struct Swarm {
  double velocity = 0;  ///< of the grains in the middle, downwards, by that of a lone one [-]
  double exponent = 0;  ///< n in velocity = phi^n, of the superficial slip [-]
  double spread = 0;    ///< of the slips in the middle, largest distance from the mean by it [-]
};

/// A lattice, two grains to a cell each way, so that every vertex has the same porosity: between clear water above and
/// below, on a closed bottom. It is looked at in its middle when it falls evenly and its ends are far. Then waves of
/// porosity grow: the swarm is unstable, as fluidised beds are.
Swarm settling_lattice(double reynolds, double porosity, const coupling::DragSpec& law, double steps_per_tau,
                       double taus) {
  constexpr int kColumns = 6, kRows = 26, kFirst = 8, kLast = 22, kPerCell = 2;
  const double d = diameter_for(reynolds), pitch = d / std::sqrt(4 * (1 - porosity) / std::numbers::pi),
               alone = carrying_slip(d, kWater, 1), u = carrying_slip(d, kWater, porosity_in_law(law, porosity)),
               tau = u / (kGravity * (1 - kWater / kGrainDensity));
  support::Immersed scene;
  scene.columns = kColumns;
  scene.rows = kRows;
  scene.width = kColumns * kPerCell * pitch;
  scene.depth = kRows * kPerCell * pitch;
  scene.step = tau / steps_per_tau;
  scene.coupling.drag = law;
  std::vector<grains::Disc> discs;
  for (int i = 0; i < kPerCell * kColumns; ++i)
    for (int j = kPerCell * kFirst; j < kPerCell * kLast; ++j)
      discs.push_back({-scene.width / 2 + (i + 0.5) * pitch, (j + 0.5) * pitch, d / 2, 0});
  Simulation sim = support::immersed(scene, discs);
  take_steps(sim, static_cast<int>(taus * steps_per_tau));
  const std::vector<AtGrain> at = water_at_grains(sim);
  Swarm swarm;
  double sum = 0, low = 1e300, high = -1e300;
  int count = 0;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const double row = discs[i].y / (kPerCell * pitch);
    if (row < 12 || row > 18) continue;
    const double v = support::velocity_of(sim, i).y, slip = at[i].porosity * (at[i].velocity.y - v);
    sum += slip;
    swarm.velocity -= v;
    low = std::min(low, slip);
    high = std::max(high, slip);
    ++count;
  }
  sum /= count;
  swarm.velocity /= count * alone;
  swarm.exponent = std::log(sum / alone) / std::log(porosity);
  swarm.spread = std::max(high / sum - 1, 1 - low / sum);
  return swarm;
}

/// Until 0.05 % of the velocity is missing: exp(-t/tau) in creeping flow, 2 exp(-2 t/tau) in fast flow.
double taus_for(double reynolds) { return reynolds < 1 ? 10 : reynolds < 1000 ? 7.5 : 5; }

constexpr coupling::DragSpec kEquivalent{}, kPlane{coupling::DragClosure::dallavalle, coupling::DragPorosity::plane};

TEST(Swarm, FallsByRichardsonAndZaki) {
  std::printf("%8s %5s %8s %10s %9s %9s %8s\n", "Re_t", "phi", "n", "closed", "U/U_t", "-v/U", "spread");
  struct Row {
    double reynolds, at_08, at_06;
  };
  for (const auto& [reynolds, at_08, at_06] :
       {Row{3e-4, 4.79, 4.79}, Row{0.25, 4.58, 4.63}, Row{66, 3.26, 3.40}, Row{3600, 2.56, 2.60}, Row{2e4, 2.47, 2.49}})
    for (const double porosity : {0.8, 0.6}) {
      // 0.1 % of the velocity is 0.0045 of n at phi = 0.8; the values of the table are rounded by 0.005.
      const Swarm swarm = settling_lattice(reynolds, porosity, kPlane, 20, taus_for(reynolds));
      const double expected = porosity == 0.8 ? at_08 : at_06, u = std::pow(porosity, swarm.exponent);
      std::printf("%8g %5g %8.4f %10.2f %9.5f %9.5f %8.3f\n", reynolds, porosity, swarm.exponent, expected, u,
                  swarm.velocity / u, swarm.spread);
      EXPECT_NEAR(swarm.exponent, expected, 0.015) << reynolds << " " << porosity;
      // On a closed bottom the mixture does not flow: the superficial slip is the grains' velocity.
      EXPECT_NEAR(swarm.velocity / u, 1, 5e-3) << reynolds << " " << porosity;
      // Waves of porosity are small yet.
      EXPECT_LT(swarm.spread, 0.08) << reynolds << " " << porosity;
    }
}

TEST(Swarm, WithTheEquivalentPorosityItFallsAsOneOfThatPorosity) {
  for (const double reynolds : {0.25, 66.0, 2e4})
    for (const double porosity : {0.8, 0.6}) {
      const double d = diameter_for(reynolds),
                   expected =
                       carrying_slip(d, kWater, porosity_in_law(kEquivalent, porosity)) / carrying_slip(d, kWater, 1);
      const Swarm swarm = settling_lattice(reynolds, porosity, kEquivalent, 20, taus_for(reynolds));
      // As above: the last of the start, and the first of the waves.
      std::printf("%8g %5g  U/U_t %.5f, closed form %.5f\n", reynolds, porosity, std::pow(porosity, swarm.exponent),
                  expected);
      EXPECT_NEAR(std::pow(porosity, swarm.exponent) / expected, 1, 4e-3) << reynolds << " " << porosity;
    }
}

// dt gamma/m of 0.2 and of 0.0125 in a swarm that is denser than water by less than it weighs: pressure and grains do
// not push each other to and fro.
TEST(Swarm, ItsVelocityDoesNotDependOnTheStep) {
  const Swarm coarse = settling_lattice(66, 0.6, kPlane, 5, taus_for(66)),
              fine = settling_lattice(66, 0.6, kPlane, 80, taus_for(66));
  EXPECT_NEAR(coarse.exponent, fine.exponent, 3e-3);
}

/// Vertical and horizontal integrals of the superficial velocity [m3/s].
base::Vec2 flux_of(const fluid::Flow& flow) {
  const std::vector<double> volume = coupling::vertex_volume(flow.mesh);
  base::Vec2 sum;
  for (std::size_t v = 0; v < volume.size(); ++v)
    sum = sum + volume[v] * base::Vec2{flow.unknown[3 * v], flow.unknown[3 * v + 1]};
  return sum;
}

TEST(Swarm, ACloudFallsFasterThanAGrain) {
  // 288 grains of 1 mm in a circle of 38 mm, at a porosity of 0.8, mirrored in x = 0.
  constexpr double kDiameter = 1e-3, kRadius = 19e-3, kPorosity = 0.8;
  const double pitch = kDiameter / std::sqrt(4 * (1 - kPorosity) / std::numbers::pi),
               alone = carrying_slip(kDiameter, kWater, 1);
  support::Immersed scene;
  scene.columns = 24;
  scene.rows = 40;
  scene.width = 0.12;
  scene.depth = 0.2;
  scene.step = 2e-3;
  scene.grain_steps = 2;
  std::vector<grains::Disc> discs;
  for (int i = 0; i < 20; ++i)
    for (int j = -20; j <= 20; ++j) {
      const double x = (i + 0.5) * pitch, y = j * pitch;
      if (std::hypot(x, y) > kRadius) continue;
      for (const double side : {1.0, -1.0}) discs.push_back({side * x, 0.15 + y, kDiameter / 2, 0});
    }
  Simulation sim = support::immersed(scene, discs);
  const double weight = buoyant_weight(sim), area = std::numbers::pi * kDiameter * kDiameter / 4;
  const auto count = static_cast<double>(discs.size());

  std::printf("%zu grains\n%6s %8s %8s %10s %10s %10s\n", discs.size(), "t [s]", "v/U_t", "width", "asymmetry",
              "volume", "momentum");
  double impulse = 0, most = 0, symmetric_until = 0;
  for (int k = 1; k <= 300; ++k) {
    take_steps(sim, scene.grain_steps);
    ASSERT_FALSE(HasFatalFailure());
    const double time = k * scene.step;
    // What acts on water and grains together: their weight and the bottom's excess pressure.
    impulse += scene.step * (pressure_at_height(sim, 0) * scene.width - weight);
    double velocity = 0, asymmetry = 0, width = 0;
    for (std::size_t i = 0; i < discs.size(); ++i) {
      velocity += support::velocity_of(sim, i).y / count;
      width = std::max(width, std::abs(sim.grains.disc[i].x));
      if (i % 2 == 1)
        asymmetry = std::max({asymmetry, std::abs(sim.grains.disc[i].x + sim.grains.disc[i - 1].x),
                              std::abs(sim.grains.disc[i].y - sim.grains.disc[i - 1].y)});
    }
    if (asymmetry < 1e-9 * kDiameter) symmetric_until = time;
    most = std::max(most, -velocity / alone);
    if (k % 30 != 0) continue;
    const base::Vec2 flux = flux_of(sim.water->basin.flow), grains = support::momentum_of_grains(sim);
    const double volume = flux.y / (velocity * area * count) + 1,
                 momentum = (kWater * flux.y + grains.y - impulse) / (weight * time);
    std::printf("%6.2f %8.3f %8.1f %10.1e %10.1e %10.1e\n", time, -velocity / alone, width / kDiameter,
                asymmetry / kDiameter, volume, momentum);
    // Grains that fall lift as much water. The stabilisation's share of the equation of mass is left, most of it while
    // they gain speed.
    EXPECT_LT(std::abs(volume), 0.02) << time;
    // All that the weight has brought went into the bottom or is still there. What is left is the convective form of
    // the fluid's equations, and the pressure read at the bottom's vertices.
    EXPECT_LT(std::abs(momentum), 0.005) << time;
  }
  std::printf("fastest %.3f U_t, symmetric until %.2f s\n", most, symmetric_until);
  // A drop of mixture is driven by sqrt((1 - phi) (rho_p - rho)/rho g R) = 1.9 U_t.
  EXPECT_GT(most, 1.5);
  EXPECT_LT(most, 2.2);
  // Until grains touch each other, in an order that knows no mirror, and then as long as rounding needs to grow.
  EXPECT_GE(symmetric_until, 0.2);
}

}  // namespace
}  // namespace seapile::simulation
