// What the stabilisation owes to flows in time, by the share c of the time scheme's rate that is told to it
// (FlowSolver::unsteadiness). The more of it, the worse it holds the pressure at small steps; without any of it, flows
// of low viscosity are not solved: the residual's inertia counts tau rho rate >> 1 times in the mass equation, and tau
// changes with the velocity faster than the iteration. A tenth serves both.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "solver/fluid/advance.h"
#include "tests/solver/fluid/flow_scenes.h"
#include "tests/solver/fluid/manufactured.h"

namespace seapile::fluid {
namespace {

using support::Errors;
using support::Manufactured;

constexpr Geometry kGeometries[] = {Geometry::planar, Geometry::axisymmetric};

constexpr double kShares[] = {1, 0.1};

/// Of a step with BDF2.
double unsteadiness(double share, double dt) { return share * 1.5 / dt; }

struct Outcome {
  Errors error;
  double iterations = 0;  ///< mean of a step
  bool converged = true;
};

Outcome after(const Manufactured& exact, int cells, int steps, double dt, double share) {
  const mesh::TriangleMesh regular = support::manufactured_mesh(cells);
  Flow flow = at_rest(regular, exact.fluid);
  support::set_time(flow, exact, regular, 0);
  support::set_exact(flow, exact, 0);
  FlowSolver solver;
  solver.instructions = base::fastest();
  solver.unsteadiness = unsteadiness(share, dt);
  Past past;
  base::Profile profile;
  Outcome outcome;
  for (int step = 1; step <= steps && outcome.converged; ++step) {
    remember(past, flow, dt);
    support::set_time(flow, exact, regular, step * dt);
    set_rates(flow, past, solver.order);
    const FlowReport report = advance(flow, past, solver, profile);
    outcome.converged = report.converged;
    outcome.iterations += static_cast<double>(report.iterations) / steps;
  }
  outcome.error = support::errors_of(flow, exact, steps * dt);
  return outcome;
}

// Re 2e5, porosity and mesh in motion: orders with dt = h/4, and iterations from dt = h down to h/16.
TEST(Stabilisation, FlowsOfLowViscosityAreSolvedInTheirOrder) {
  for (const Geometry geometry : kGeometries)
    for (const double share : kShares) {
      const Manufactured exact{{20, 1e-4, geometry}, 0.15, 0.1, 2, 20, 0, 0.2};
      std::printf("%s, c = %g\n%6s %8s %12s %12s %11s\n", geometry == Geometry::planar ? "planar" : "axisymmetric",
                  share, "cells", "dt/h", "u", "p", "iterations");
      const auto row = [&](int cells, int steps_per_h) {
        const Outcome o = after(exact, cells, 2 * cells * steps_per_h / 5, 1.0 / cells / steps_per_h, share);
        std::printf("%6d %8.4f %12.3e %12.3e %11.1f\n", cells, 1.0 / steps_per_h, o.error.velocity, o.error.pressure,
                    o.iterations);
        EXPECT_TRUE(o.converged);
        return o;
      };
      for (const int steps_per_h : {1, 16}) EXPECT_LT(row(16, steps_per_h).iterations, 12);
      std::array<Outcome, 3> o;
      for (int k = 0; k < 3; ++k) o[k] = row(8 << k, 4);
      EXPECT_GT(std::log2(o[1].error.velocity / o[2].error.velocity), 1.85);
      EXPECT_GT(std::log2(o[1].error.pressure / o[2].error.pressure), 1.5);
    }
}

// On a given mesh at Re 40, down to a thousandth of the time in which the flow crosses a cell.
TEST(Stabilisation, SmallStepsLeaveThePressureItsAccuracy) {
  const Manufactured exact{{20, 0.5, Geometry::planar}, 0.15, 0.1, 2, 10, 30, 0.2};
  for (const double share : kShares)
    for (const double dt : {1e-2, 1e-3, 1e-4}) {
      const Outcome o = after(exact, 16, 40, dt, share);
      std::printf("c = %g, dt %g: u %.2e, p %.2e\n", share, dt, o.error.velocity, o.error.pressure);
      EXPECT_TRUE(o.converged);
      EXPECT_LT(o.error.velocity, 0.012);
      // 0.02 at large steps. With the whole rate 0.19 at 1e-4; with a tenth it grows below that, as 1/dt.
      EXPECT_LT(o.error.pressure, share == 1 && dt < 1e-3 ? 0.3 : 0.06);
    }
}

struct Response {
  double velocity = 0;  ///< rms of u [m/s]
  double rough = 0;     ///< rms of what p differs by from the mean of its neighbours [Pa]
  bool converged = true;
};

/// Water of cells of 0.1 m under an open top, at rest until the porosity between its grains changes by up to 0.1/s at
/// random, vertex by vertex, linear between them; on the same mesh or with each cell cut in `finer` x `finer`.
Response response_to_noise(double drag, double dt, double share, int finer) {
  constexpr int kColumns = 20, kRows = 10;
  const int columns = kColumns * finer, rows = kRows * finer;
  Flow flow =
      at_rest(mesh::rectangle(mesh::even(0, 2, columns), mesh::even(0, 1, rows)), {1000, 1e-3, Geometry::planar});
  const auto noise = [](int i, int j) { return base::uniform(-0.1, 0.1, 5, 0, i + 1000 * j); };
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      const int v = column + row * (columns + 1), i = std::min(column / finer, kColumns - 1),
                j = std::min(row / finer, kRows - 1);
      const double a = static_cast<double>(column) / finer - i, b = static_cast<double>(row) / finer - j;
      flow.porosity_rate[v] = a >= b ? noise(i, j) * (1 - a) + noise(i + 1, j) * (a - b) + noise(i + 1, j + 1) * b
                                     : noise(i, j) * (1 - b) + noise(i, j + 1) * (b - a) + noise(i + 1, j + 1) * a;
      flow.porosity[v] = 0.2;
      flow.drag[v] = drag;
    }
  for (const mesh::Side side : {mesh::kLeft, mesh::kRight}) support::hold_side(flow, side, kVelocityX, 0);
  support::hold_side(flow, mesh::kBottom, kVelocityY, 0);
  support::open_side(flow, mesh::kTop, [](base::Vec2) { return 0.0; });

  FlowSolver solver;
  solver.instructions = base::fastest();
  solver.unsteadiness = unsteadiness(share, dt);
  Past past;
  base::Profile profile;
  Response response;
  for (int step = 0; step < 10; ++step) {
    remember(past, flow, dt);
    response.converged = advance(flow, past, solver, profile).converged && response.converged;
  }
  const auto at = [&](int i, int j) { return finer * i + finer * j * (columns + 1); };
  for (int j = 1; j < kRows; ++j)
    for (int i = 1; i < kColumns; ++i) {
      const auto p = [&](int di, int dj) { return flow.u(at(i + di, j + dj), kPressure); };
      const double rough = p(0, 0) - 0.25 * (p(1, 0) + p(-1, 0) + p(0, 1) + p(0, -1));
      response.rough += rough * rough / ((kColumns - 1) * (kRows - 1));
      response.velocity += (std::pow(flow.u(at(i, j), kVelocityX), 2) + std::pow(flow.u(at(i, j), kVelocityY), 2)) /
                           ((kColumns - 1) * (kRows - 1));
    }
  return {std::sqrt(response.velocity), std::sqrt(response.rough), response.converged};
}

// Grains that come and go make a flow; what they make of the pressure is noise unless drag resists that flow. The step
// is short against the time in which anything happens, as it is beside grains.
TEST(Stabilisation, APorosityThatFluctuatesMovesTheWater) {
  constexpr double kStep = 5e-4;
  std::printf("%8s %10s %6s %10s %10s\n", "drag", "", "", "u", "p rough");
  for (const double drag : {0.0, 1e5, 1e6}) {
    const Response finer = response_to_noise(drag, kStep, 1, 4);
    std::printf("%8g %10s %6s %10.3e %10.2f\n", drag, "cells/4", "", finer.velocity, finer.rough);
    for (const double share : kShares) {
      const Response here = response_to_noise(drag, kStep, share, 1);
      std::printf("%8s %10s %6g %10.3e %10.2f\n", "", "c =", share, here.velocity, here.rough);
      EXPECT_TRUE(here.converged && finer.converged);
      EXPECT_NEAR(here.velocity, finer.velocity, 0.35 * finer.velocity);  // A mesh that just resolves the noise.
      // Of a tenth, three times what is true is left, or 100 Pa: a centimetre of water. Of the whole, 300 Pa more.
      EXPECT_LT(here.rough, std::max(3 * finer.rough, 100.0) + (share == 1 ? 300 : 0));
    }
  }
}

}  // namespace
}  // namespace seapile::fluid
