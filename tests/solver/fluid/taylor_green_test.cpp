// Decaying vortices, an exact solution of the whole equations in time (Taylor, Green 1937):
//
//   v = (sin x cos y, -cos x sin y) f,   p = rho/4 (cos 2x + cos 2y) f^2,   f = exp(-2 nu t)
//
// in a box [0, pi] x [0, pi], whose walls it does not cross and where its shear stress vanishes: the walls let slip.
// The pressure has no level there; one vertex holds it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "solver/fluid/advance.h"
#include "tests/solver/fluid/flow_scenes.h"

namespace seapile::fluid {
namespace {

using std::numbers::pi;

constexpr double kDensity = 1, kViscosity = 0.05, kTime = 2;

Flow vortex(int cells, double porosity) {
  Flow flow = at_rest(mesh::rectangle(mesh::even(0, pi, cells), mesh::even(0, pi, cells)),
                      {kDensity, kViscosity, Geometry::planar});
  flow.porosity.assign(flow.mesh.vertices(), porosity);
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v) {
    const auto [x, y] = flow.mesh.position[v];
    flow.unknown[3 * v] = porosity * std::sin(x) * std::cos(y);
    flow.unknown[3 * v + 1] = -porosity * std::cos(x) * std::sin(y);
    flow.unknown[3 * v + 2] = kDensity / 4 * (std::cos(2 * x) + std::cos(2 * y));
  }
  for (const mesh::Side side : {mesh::kLeft, mesh::kRight}) support::hold_side(flow, side, kVelocityX, 0);
  for (const mesh::Side side : {mesh::kBottom, mesh::kTop}) support::hold_side(flow, side, kVelocityY, 0);
  return flow;
}

struct Error {
  double velocity = 0, pressure = 0;
};

/// Root mean squares over the vertices, of the velocity by its own, of the pressure by rho/4.
Error error_of(const Flow& flow, double time) {
  const double f = std::exp(-2 * kViscosity / kDensity * time);
  double square = 0, scale = 0, square_p = 0, shift = 0;
  const auto pressure = [&](std::size_t v) {
    const auto [x, y] = flow.mesh.position[v];
    return kDensity / 4 * (std::cos(2 * x) + std::cos(2 * y)) * f * f;
  };
  const auto count = static_cast<double>(flow.mesh.vertices());
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v) shift += (flow.unknown[3 * v + 2] - pressure(v)) / count;
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v) {
    const auto [x, y] = flow.mesh.position[v];
    const base::Vec2 exact{f * std::sin(x) * std::cos(y), -f * std::cos(x) * std::sin(y)};
    const double phi = flow.porosity[v];
    const base::Vec2 wrong = base::Vec2{flow.unknown[3 * v] / phi, flow.unknown[3 * v + 1] / phi} - exact;
    square += dot(wrong, wrong);
    scale += dot(exact, exact);
    square_p += std::pow(flow.unknown[3 * v + 2] - pressure(v) - shift, 2);
  }
  return {std::sqrt(square / scale), std::sqrt(square_p / count) / (kDensity / 4 * f * f)};
}

Error after(int cells, int steps, TimeOrder order, double porosity = 1) {
  Flow flow = vortex(cells, porosity);
  flow.held[kPressure] =
      1;  // Of the first vertex: where the exact pressure decays, a wrong level that does not matter.
  FlowSolver solver;
  solver.order = order;
  solver.instructions = base::fastest();
  Past past;
  base::Profile profile;
  for (int step = 0; step < steps; ++step) {
    remember(past, flow, kTime / steps);
    set_rates(flow, past, order);
    const FlowReport report = advance(flow, past, solver, profile);
    EXPECT_TRUE(report.converged) << report.reason;
  }
  return error_of(flow, kTime);
}

// Step and cell are halved together.
TEST(TaylorGreen, DecaysWithSecondOrder) {
  std::printf("%6s %6s %12s %6s %12s %6s\n", "cells", "steps", "error of u", "order", "error of p", "order");
  Error last, error;
  double order = 0, order_p = 0;
  for (const int cells : {8, 16, 32}) {
    last = error;
    error = after(cells, cells, TimeOrder::second);
    if (last.velocity > 0) {
      order = std::log2(last.velocity / error.velocity);
      order_p = std::log2(last.pressure / error.pressure);
    }
    std::printf("%6d %6d %12.3e %6.2f %12.3e %6.2f\n", cells, cells, error.velocity, order, error.pressure, order_p);
  }
  EXPECT_GT(order, 1.85);
  EXPECT_GT(order_p, 1.5);
  EXPECT_LT(error.velocity, 3e-3);
}

// A uniform porosity changes neither the interstitial velocity nor the pressure: phi divides out of every equation.
TEST(TaylorGreen, DecaysAlikeBetweenGrainsThatDoNotResist) {
  const Error pure = after(12, 8, TimeOrder::second), grains = after(12, 8, TimeOrder::second, 0.35);
  EXPECT_NEAR(grains.velocity, pure.velocity, 1e-6);  // The iteration's tolerance, relative to the velocity.
  EXPECT_NEAR(grains.pressure, pure.pressure, 1e-6);
}

}  // namespace
}  // namespace seapile::fluid
