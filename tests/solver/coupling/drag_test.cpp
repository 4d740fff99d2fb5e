// The drag laws against their closed forms, and against what they say of a grain, a swarm and a bed.
//
// Homogeneous swarm. With n discs of area V per area, phi = 1 - n V, and p without the hydrostatic one, the fluid of
// the full-gradient momentum equation is in balance when
//   0 = -grad p - n (D - V grad p),
// D the drag on a disc and -V grad p the pressure's part; so -grad p = n D/phi. A disc feels
//   D - V grad p = D + V n D/phi = D/phi,
// which carries its buoyant weight (rho_p - rho) g V. Where the mixture has no flux, phi v_f + (1 - phi) v_i = 0, the
// superficial slip is U = phi (v_f - v_i) = -v_i: the swarm falls with |U|.
#include "solver/coupling/drag.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "solver/coupling/drag_dallavalle1948.h"
#include "solver/coupling/drag_difelice1994.h"

namespace seapile::coupling {
namespace {

constexpr double kGravity = 9.81, kGrain = 1500;
constexpr std::array<DragClosure, 2> kClosures = {DragClosure::dallavalle, DragClosure::di_felice};
constexpr std::array<DragPorosity, 2> kPorosities = {DragPorosity::equivalent, DragPorosity::plane};

/// D/phi of a disc [N/m].
double whole_force(const DragSpec& law, const fluid::Properties& water, double d, double phi, double u) {
  return drag_coefficient(law, water, d, phi, u) * (u / phi) / phi;
}

/// Where a rising function of a positive number passes 0.
double root_of(const std::function<double(double)>& f) {
  double low = 1e-12, high = 1e3;
  for (int k = 0; k < 200; ++k) {
    const double middle = std::sqrt(low * high);
    (f(middle) < 0 ? low : high) = middle;
  }
  return low;
}

/// The superficial slip that carries discs [m/s].
double carrying(const DragSpec& law, const fluid::Properties& water, double d, double phi) {
  const double weight = (kGrain - water.density) * kGravity * std::numbers::pi * d * d / 4;
  return root_of([&](double u) { return whole_force(law, water, d, phi, u) - weight; });
}

fluid::Properties water_of(double density) { return {density, 1e-6 * density}; }

TEST(Drag, HasTheClosedFormsOfItsSources) {
  const fluid::Properties water = water_of(1000);
  for (const double d : {1e-3, 0.03})
    for (const double phi : {0.2, 0.5, 0.9, 1.0})
      for (const double u : {1e-4, 0.01, 0.7}) {
        const double re = 1000 * d * u / 1e-3, c_d = std::pow(0.63 + 4.8 / std::sqrt(re), 2);
        const double beta = 3.7 - 0.65 * std::exp(-std::pow(1.5 - std::log10(re), 2) / 2);
        const double v = u / phi;  // the slip
        const double phi_3 = 1 - 0.857383 * std::pow(1 - phi, 1.5);
        // Literally: phi^-1.8 1/2 rho C_d A |v| v, and 1/2 rho C_d A phi^2 |v| v phi^-beta.
        const double dallavalle = std::pow(phi, -1.8) * 0.5 * 1000 * c_d * d * v,
                     di_felice = 0.5 * 1000 * c_d * d * phi * phi * v * std::pow(phi, -beta);
        const auto gamma = [&](DragClosure closure, DragPorosity porosity) {
          return drag_coefficient({closure, porosity}, water, d, phi, u);
        };
        EXPECT_NEAR(gamma(kClosures[0], DragPorosity::plane) / dallavalle, 1, 1e-13);
        EXPECT_NEAR(gamma(kClosures[1], DragPorosity::plane) / di_felice, 1, 1e-13);
        EXPECT_NEAR(gamma(kClosures[0], DragPorosity::equivalent) / dallavalle, std::pow(phi / phi_3, 4.8),
                    1e-5 * std::pow(phi / phi_3, 4.8));
        EXPECT_NEAR(gamma(kClosures[1], DragPorosity::equivalent) / di_felice, std::pow(phi / phi_3, beta + 1),
                    1e-5 * std::pow(phi / phi_3, beta + 1));
      }
}

TEST(Drag, PowersOfThePorosityAreThoseOfTheLibrary) {
  for (double x = 1e-4; x < 1.5; x *= 1.0003) {
    ASSERT_NEAR(inverse_fifth_root(x) * std::pow(x, 0.2), 1, 1e-15) << x;
    ASSERT_NEAR(power_minus_4_8(x) * std::pow(x, 4.8), 1, 3e-15) << x;
  }
  for (const double x : {1e-30, 1e30}) EXPECT_NEAR(inverse_fifth_root(x) * std::pow(x, 0.2), 1, 1e-15);
}

TEST(Drag, OfManyDiscsIsThatOfEach) {
  const std::vector<double> d = {0.02, 0.03, 0.04, 1e-3, 0.03}, phi = {0.1, 0.5, 1, 0.3, 0.9},
                            slip = {0, 1e-6, 0.3, 2, 0.01};
  for (const auto closure : kClosures)
    for (const auto porosity : kPorosities) {
      std::vector<double> gamma(d.size());
      drag_coefficients({closure, porosity}, water_of(1300), d, phi, slip, gamma);
      for (std::size_t i = 0; i < d.size(); ++i)
        EXPECT_EQ(gamma[i], drag_coefficient({closure, porosity}, water_of(1300), d[i], phi[i], slip[i])) << i;
    }
}

TEST(Drag, TheDensestDiscsAreTheDensestSpheres) {
  const double pi = std::numbers::pi;
  EXPECT_NEAR(equivalent_porosity(1 - pi / std::sqrt(12.0)), 1 - pi / std::sqrt(18.0), 1e-15);
  EXPECT_EQ(equivalent_porosity(1), 1);
  EXPECT_NEAR(equivalent_porosity(0.18), 0.363, 5e-4);
}

TEST(Drag, IsFiniteAtRestAndWithoutInertia) {
  for (const auto closure : kClosures)
    for (const auto porosity : kPorosities) {
      const DragSpec law{closure, porosity};
      const double d = 0.03, stokes = 0.5 * 4.8 * 4.8 * 1e-3;  // phi = 1: 1/2 d 23.04 mu/d
      EXPECT_NEAR(drag_coefficient(law, water_of(1000), d, 1, 0) / stokes, 1, 1e-15);
      EXPECT_NEAR(drag_coefficient(law, {0, 1e-3}, d, 1, 0.5) / stokes, 1, 1e-15);
      EXPECT_NEAR(drag_coefficient(law, {0, 1e-3}, d, 1, 0) / stokes, 1, 1e-15);
      EXPECT_NEAR(drag_coefficient(law, water_of(1000), d, 0.4, 1e-18) / drag_coefficient(law, {0, 1e-3}, d, 0.4, 0), 1,
                  1e-6);
    }
}

TEST(Drag, ADiscFallsWithItsTerminalVelocity) {
  // U^2 = pi/2 (rho_p - rho)/rho g d/C_d. A lone disc knows no porosity, so all laws agree.
  for (const auto& [d, velocity] : {std::pair{1e-3, 0.07385}, {5e-3, 0.2569}, {0.03, 0.7257}, {0.0384, 0.8280}})
    for (const auto closure : kClosures)
      for (const auto porosity : kPorosities)
        EXPECT_NEAR(carrying({closure, porosity}, water_of(1000), d, 1) / velocity, 1, 2e-4) << d;
}

TEST(Drag, ASwarmFallsByRichardsonAndZaki) {
  struct Row {
    double reynolds, at_08, at_06;
  };
  // The exponent of U = U_t phi^n depends on the shape only through Re_t.
  for (const Row& row : {Row{3e-4, 4.79, 4.79}, Row{0.25, 4.58, 4.63}, Row{66, 3.26, 3.40}, Row{3600, 2.56, 2.60},
                         Row{2e4, 2.47, 2.49}}) {
    const fluid::Properties water = water_of(1000);
    const DragSpec law{DragClosure::dallavalle, DragPorosity::plane};
    const double d = root_of([&](double x) { return carrying(law, water, x, 1) * x / 1e-6 - row.reynolds; });
    const double alone = carrying(law, water, d, 1);
    const auto exponent = [&](double phi) { return std::log(carrying(law, water, d, phi) / alone) / std::log(phi); };
    EXPECT_NEAR(exponent(0.8), row.at_08, 0.015) << row.reynolds;
    EXPECT_NEAR(exponent(0.6), row.at_06, 0.015) << row.reynolds;
  }
}

TEST(Drag, DiFeliceSwarmsStayNearRichardsonAndZaki) {
  // His exponent beta + 1 = 4.7 in creeping and in fast flow: n = 4.7 and 2.35.
  const DragSpec law{DragClosure::di_felice, DragPorosity::plane};
  const auto exponent = [&](double d) {
    return std::log(carrying(law, water_of(1000), d, 0.8) / carrying(law, water_of(1000), d, 1)) / std::log(0.8);
  };
  EXPECT_NEAR(exponent(1e-5), 4.7, 0.03);
  EXPECT_NEAR(exponent(1), 2.36, 0.03);
  EXPECT_NEAR(di_felice_exponent(std::pow(10, 1.5)), 3.05, 1e-15);
  EXPECT_EQ(di_felice_exponent(0), 3.7);
}

TEST(Drag, TheBedOfThePileIsFluidisedAtItsVelocity) {
  // Radii from 11.2 to 19.2 mm, uniformly, at a plane porosity of 0.18: discs of the mean area.
  const double d = 2 * std::sqrt(0.0152 * 0.0152 + 0.008 * 0.008 / 12);
  const DragSpec plane{DragClosure::dallavalle, DragPorosity::plane}, equivalent{};
  EXPECT_NEAR(carrying(plane, water_of(1000), d, 0.18), 8.6e-3, 0.05e-3);
  EXPECT_NEAR(carrying(plane, water_of(1300), d, 0.18), 4.2e-3, 0.05e-3);
  EXPECT_NEAR(carrying(equivalent, water_of(1000), d, 0.18), 58e-3, 0.5e-3);
  EXPECT_NEAR(carrying(equivalent, water_of(1300), d, 0.18), 30e-3, 0.5e-3);
}

TEST(Drag, WithTheEquivalentPorosityABedResistsAsOneOfThatPorosity) {
  // The whole force is that of discs in a plane bed of porosity phi_3.
  const fluid::Properties water = water_of(1000);
  for (const auto closure : kClosures)
    for (const double phi : {0.18, 0.4, 0.8})
      EXPECT_NEAR(whole_force({closure, DragPorosity::equivalent}, water, 0.03, phi, 0.02) /
                      whole_force({closure, DragPorosity::plane}, water, 0.03, equivalent_porosity(phi), 0.02),
                  1, 1e-13);
}

TEST(Drag, APackedBedOfSpheresIsNearErgun) {
  // dP/L = n F/phi with n = (1 - phi)/(pi d^3/6) spheres, whose area is pi d^2/4 in place of d.
  const fluid::Properties water = water_of(1000);
  const DragSpec law{DragClosure::dallavalle, DragPorosity::plane};
  const double d = 1e-3, phi = 0.4, mu = water.viscosity, rho = water.density, pi = std::numbers::pi;
  double u = 1e-5;
  for (const double ratio : {1.03, 1.08, 1.25, 1.68, 1.81, 1.30}) {
    const double model = (1 - phi) / (pi * d * d * d / 6) * (pi * d / 4) * whole_force(law, water, d, phi, u);
    const double ergun = 150 * mu * (1 - phi) * (1 - phi) * u / (phi * phi * phi * d * d) +
                         1.75 * rho * (1 - phi) * u * u / (phi * phi * phi * d);
    EXPECT_NEAR(model / ergun, ratio, 0.01) << u;
    u *= 10;
  }
}

}  // namespace
}  // namespace seapile::coupling
