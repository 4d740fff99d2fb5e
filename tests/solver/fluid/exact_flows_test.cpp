// Flows whose profiles are known: in channels, pipes and annuli, between grains, along walls that move or let slip.
//
// x runs along the channel; y across it from the middle plane, the axis, or an annulus' inner wall. A pressure from
// outside drives the fluid, which leaves as it enters (u_y = 0 at both ends). Profiles are compared half way along: the
// pressure's stabilisation disturbs the ends by a share h^2.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <vector>

#include "solver/fluid/advance.h"
#include "solver/fluid/steady.h"
#include "tests/solver/fluid/flow_scenes.h"

namespace seapile::fluid {
namespace {

using support::hold_side;
using support::open_side;

constexpr double kMu = 0.7, kGradient = 1.9, kH = 1.3, kLength = 2.6;

/// A channel from y = inner to kH with `rows` cells across, driven by kGradient [Pa/m]; its walls are up to the caller.
Flow channel(Geometry geometry, int rows, double inner = 0, double gradient = kGradient) {
  Flow flow = at_rest(mesh::rectangle(mesh::even(0, kLength, rows), mesh::even(inner, kH, rows)), {1.4, kMu, geometry});
  for (const mesh::Side side : {mesh::kLeft, mesh::kRight, mesh::kBottom, mesh::kTop})
    hold_side(flow, side, kVelocityY, 0);
  open_side(flow, mesh::kLeft, [gradient](base::Vec2) { return gradient * kLength; });
  open_side(flow, mesh::kRight, [](base::Vec2) { return 0.0; });
  return flow;
}

/// The vertices half way along a channel, from the middle to the wall; the number of rows is even.
std::vector<std::int32_t> half_way(int rows) {
  std::vector<std::int32_t> column;
  for (int j = 0; j <= rows; ++j) column.push_back(rows / 2 + j * (rows + 1));
  return column;
}

/// Errors of v_x half way along, by the largest v_x there: the largest one, and the mean square over the section.
struct ProfileError {
  double largest = 0, mean = 0;
};
ProfileError profile_error(const Flow& flow, int rows, const std::function<double(double)>& exact) {
  double largest = 0, square = 0, section = 0, scale = 0;
  for (const std::int32_t v : half_way(rows)) {
    const double y = flow.mesh.position[v].y, error = flow.u(v, kVelocityX) / flow.porosity[v] - exact(y);
    const double weight = flow.fluid.geometry == Geometry::axisymmetric ? y : 1;
    largest = std::max(largest, std::abs(error));
    square += weight * error * error;
    section += weight;
    scale = std::max(scale, std::abs(exact(y)));
  }
  return {largest / scale, std::sqrt(square / section) / scale};
}

/// Mean of u_x half way along, by the trapezoidal rule with the weight of the geometry.
double mean_speed(const Flow& flow, int rows) {
  double sum = 0, section = 0;
  const auto column = half_way(rows);
  for (int j = 0; j < rows; ++j) {
    const double y0 = flow.mesh.position[column[j]].y, y1 = flow.mesh.position[column[j + 1]].y;
    const bool round = flow.fluid.geometry == Geometry::axisymmetric;
    const double area = (y1 - y0) * (round ? 0.5 * (y0 + y1) : 1);
    sum += area * 0.5 * (flow.u(column[j], kVelocityX) + flow.u(column[j + 1], kVelocityX));
    section += area;
  }
  return sum / section;
}

constexpr Geometry kGeometries[] = {Geometry::planar, Geometry::axisymmetric};
const char* name(Geometry geometry) { return geometry == Geometry::planar ? "planar" : "axisymmetric"; }

/// Solves on 8, 16 and 32 rows and prints errors. Expects an error of at most `most` anywhere on the finest grid, and
/// second order of the mean one, less what the last pair of grids lacks of its limit. (On the axis itself the error of
/// linear functions is h^2 log h: 1.76, 1.80 and 1.83 in a pipe with 16, 32 and 64 rows.)
template <class Make>
void expect_profile(const char* what, Geometry geometry, double most, const std::function<double(double)>& exact,
                    Make&& make) {
  std::printf("%s, %s\n%6s %12s %12s %6s\n", what, name(geometry), "rows", "largest", "mean", "order");
  ProfileError error, last;
  double order = 0;
  for (const int rows : {8, 16, 32}) {
    Flow flow = make(rows);
    const NewtonReport report = solve_steady(flow, nullptr);
    ASSERT_TRUE(report.converged) << report.reason;
    last = error;
    error = profile_error(flow, rows, exact);
    order = last.mean > 0 ? std::log2(last.mean / error.mean) : 0;
    std::printf("%6d %12.3e %12.3e %6.2f\n", rows, error.largest, error.mean, order);
  }
  EXPECT_GT(order, 1.8) << what;
  EXPECT_LT(error.largest, most) << what;
}

double poiseuille(Geometry geometry, double y) {
  return kGradient / ((geometry == Geometry::planar ? 2 : 4) * kMu) * (kH * kH - y * y);
}

TEST(ExactFlows, PoiseuillesProfile) {
  for (const Geometry geometry : kGeometries)
    expect_profile(
        "Poiseuille", geometry, 1e-3, [&](double y) { return poiseuille(geometry, y); },
        [&](int rows) {
          Flow flow = channel(geometry, rows);
          hold_side(flow, mesh::kTop, kVelocityX, 0);
          return flow;
        });
}

// The pressure drop of a given flow, 3 mu U/H^2 and 8 mu U/R^2 per length. A stress 2 mu d with d = grad v + grad v^T
// would double it.
TEST(ExactFlows, ViscosityIsNotDoubled) {
  for (const Geometry geometry : kGeometries) {
    constexpr int kRows = 32;
    Flow flow = channel(geometry, kRows);
    hold_side(flow, mesh::kTop, kVelocityX, 0);
    ASSERT_TRUE(solve_steady(flow, nullptr).converged);
    const double factor = kGradient * kH * kH / (kMu * mean_speed(flow, kRows));
    std::printf("%s: dp/dx H^2/(mu U) = %.4f\n", name(geometry), factor);
    // The trapezoidal rule and the profile are each off by a few h^2 = 0.001.
    EXPECT_NEAR(factor, geometry == Geometry::planar ? 3 : 8, 0.01 * (geometry == Geometry::planar ? 3 : 8));
  }
}

TEST(ExactFlows, GrainsThatDoNotResistLeaveTheInterstitialProfile) {
  for (const Geometry geometry : kGeometries)
    expect_profile(
        "Poiseuille, porosity 0.4", geometry, 1e-3, [&](double y) { return poiseuille(geometry, y); },
        [&](int rows) {
          Flow flow = channel(geometry, rows);
          flow.porosity.assign(flow.mesh.vertices(), 0.4);
          hold_side(flow, mesh::kTop, kVelocityX, 0);
          return flow;
        });
}

// Brinkman: beta v - mu div grad v = -dp/dx for a uniform porosity.
TEST(ExactFlows, GrainsThatResistLeaveALayerAtTheWall) {
  constexpr double kBeta = 30;
  const double k = std::sqrt(kBeta / kMu);
  for (const Geometry geometry : kGeometries)
    expect_profile(
        "Brinkman, porosity 0.4", geometry, 2e-3,
        [&](double y) {
          const double layer = geometry == Geometry::planar
                                   ? std::cosh(k * y) / std::cosh(k * kH)
                                   : std::cyl_bessel_i(0, k * y) / std::cyl_bessel_i(0, k * kH);
          return kGradient / kBeta * (1 - layer);
        },
        [&](int rows) {
          Flow flow = channel(geometry, rows);
          flow.porosity.assign(flow.mesh.vertices(), 0.4);
          flow.drag.assign(flow.mesh.vertices(), kBeta);
          hold_side(flow, mesh::kTop, kVelocityX, 0);
          return flow;
        });
}

void let_slip(Flow& flow, mesh::Side side, double friction, double wall) {
  for (const mesh::BoundaryEdge& e : flow.mesh.boundary)
    if (e.tag == side) flow.slip.push_back({e.from, e.to, friction, {wall, 0}});
}

// mu dv/dn = -friction v at the wall: the profile is shifted by G H/friction, or half of it in a pipe.
TEST(ExactFlows, NaviersSlipShiftsTheProfile) {
  constexpr double kFriction = 0.9;
  for (const Geometry geometry : kGeometries)
    for (const double porosity : {1.0, 0.5})
      expect_profile(
          "Poiseuille with slip", geometry, 1e-3,
          [&](double y) {
            const double shift = kGradient * kH / kFriction;
            return poiseuille(geometry, y) + (geometry == Geometry::planar ? shift : 0.5 * shift);
          },
          [&](int rows) {
            Flow flow = channel(geometry, rows);
            flow.porosity.assign(flow.mesh.vertices(), porosity);
            let_slip(flow, mesh::kTop, kFriction, 0);
            return flow;
          });
}

// An annulus whose inner wall moves along the axis: v = C ln(R/y), C = W/ln(R/a) when the fluid sticks to it.
TEST(ExactFlows, AnInnerCylinderDragsTheFluidAlong) {
  constexpr double kInner = 0.4, kWall = 1.1, kFriction = 2;
  const double decades = std::log(kH / kInner);
  for (const bool slip : {false, true}) {
    const double C = slip ? kFriction * kWall / (kFriction * decades + kMu / kInner) : kWall / decades;
    expect_profile(
        slip ? "annulus, inner wall lets slip" : "annulus, inner wall holds", Geometry::axisymmetric, 2e-3,
        [&](double y) { return C * std::log(kH / y); },
        [&](int rows) {
          Flow flow = channel(Geometry::axisymmetric, rows, kInner, 0);
          hold_side(flow, mesh::kTop, kVelocityX, 0);
          if (slip)
            let_slip(flow, mesh::kBottom, kFriction, kWall);
          else
            hold_side(flow, mesh::kBottom, kVelocityX, kWall);
          return flow;
        });
  }
}

// A line source, v_y = c/y without inertia: the viscous stress is 2 mu (-c/y^2) across and 2 mu c/y^2 around the axis,
// in equilibrium under a uniform pressure. The outside pressure at R balances p + 2 mu c/R^2.
TEST(ExactFlows, ALineSourceIsInEquilibriumWithItsHoopStress) {
  constexpr double kInner = 0.5, kSource = 0.6, kOutside = 3;
  double last = 0, last_p = 0;
  for (const int rows : {8, 16, 32}) {
    Flow flow = at_rest(mesh::rectangle(mesh::even(0, kLength, rows), mesh::even(kInner, kH, rows)),
                        {0, kMu, Geometry::axisymmetric});
    for (const mesh::Side side : {mesh::kLeft, mesh::kRight, mesh::kBottom, mesh::kTop})
      hold_side(flow, side, kVelocityX, 0);
    hold_side(flow, mesh::kBottom, kVelocityY, kSource / kInner);
    open_side(flow, mesh::kTop, [](base::Vec2) { return kOutside; });
    ASSERT_TRUE(solve_steady(flow, nullptr).converged);
    const double pressure = kOutside - 2 * kMu * kSource / (kH * kH);
    double error = 0, square = 0;
    for (const std::int32_t v : half_way(rows)) {
      error = std::max(error, std::abs(flow.u(v, kVelocityY) - kSource / flow.mesh.position[v].y));
      square += std::pow(flow.u(v, kPressure) - pressure, 2) / (rows + 1);
    }
    const double error_p = std::sqrt(square);
    std::printf("line source, %2d rows: largest error of u %.2e, mean one of p %.2e\n", rows, error, error_p);
    if (rows == 32) {
      EXPECT_GT(std::log2(last / error), 1.7);      // 2 in the limit.
      EXPECT_GT(std::log2(last_p / error_p), 1.3);  // 1.5 in the limit: a layer of one cell at the wall.
    }
    last = error;
    last_p = error_p;
  }
  // The stress at the inner wall is 2 mu c/a^2 = 3.4 Pa.
  EXPECT_LT(last, 2e-3);
  EXPECT_LT(last_p, 0.04);
}

// A pressure sets a fluid at rest in motion: before friction has reached the middle it moves there with G t/rho.
TEST(ExactFlows, AFluidAtRestIsSetInMotion) {
  constexpr int kRows = 16, kSteps = 10;
  for (const Geometry geometry : kGeometries) {
    Flow flow = channel(geometry, kRows);
    hold_side(flow, mesh::kTop, kVelocityX, 0);
    const double time = 0.01 * kH * kH * flow.fluid.density / kMu;  // sqrt(nu t) = H/10
    FlowSolver solver;
    Past past;
    base::Profile profile;
    for (int step = 0; step < kSteps; ++step) {
      remember(past, flow, time / kSteps);
      set_rates(flow, past, solver.order);
      const FlowReport report = advance(flow, past, solver, profile);
      ASSERT_TRUE(report.converged) << report.reason;
    }
    const std::int32_t middle = half_way(kRows)[0];
    EXPECT_NEAR(flow.u(middle, kVelocityX), kGradient * time / flow.fluid.density,
                1e-3 * kGradient * time / flow.fluid.density);
  }
}

}  // namespace
}  // namespace seapile::fluid
