// Rest stays rest and a uniform flow stays uniform, whatever the mesh, its motion and the grains between.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "solver/fluid/advance.h"
#include "solver/fluid/steady.h"
#include "tests/solver/fluid/flow_scenes.h"

namespace seapile::fluid {
namespace {

using support::Draw;
using support::hold_side;
using support::open_side;
using support::uneven_mesh;

/// A basin with an open top, held walls (the axis when axisymmetric), grains at random and fluid at rest in it.
Flow basin(Geometry geometry, double pressure, std::uint64_t seed) {
  Flow flow = at_rest(uneven_mesh(9, 7, seed), {1000, 1e-3, geometry});
  Draw draw(seed);
  for (double& phi : flow.porosity) phi = draw(0.15, 1);
  for (double& beta : flow.drag) beta = draw(0, 1e6);
  for (const mesh::Side side : {mesh::kLeft, mesh::kRight}) {
    hold_side(flow, side, kVelocityX, 0);
    hold_side(flow, side, kVelocityY, 0);
  }
  hold_side(flow, mesh::kBottom, kVelocityY, 0);
  if (geometry == Geometry::planar) hold_side(flow, mesh::kBottom, kVelocityX, 0);
  open_side(flow, mesh::kTop, [pressure](base::Vec2) { return pressure; });
  return flow;
}

double fastest(const Flow& flow) {
  double most = 0;
  for (std::size_t i = 0; i < flow.unknown.size(); ++i)
    if (i % 3 != kPressure) most = std::max(most, std::abs(flow.unknown[i]));
  return most;
}
double pressure_error(const Flow& flow, double expected) {
  double most = 0;
  for (std::size_t i = kPressure; i < flow.unknown.size(); i += 3)
    most = std::max(most, std::abs(flow.unknown[i] - expected));
  return most;
}

constexpr Geometry kGeometries[] = {Geometry::planar, Geometry::axisymmetric};

// The residual of rest under a uniform pressure is the sum of p times the gradients of hat functions and of the
// outside pressure on the edges: it cancels to the rounding of p h.
TEST(Rest, IsASteadySolutionWithThePressureFromOutside) {
  for (const Geometry geometry : kGeometries)
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Flow flow = basin(geometry, 1e3, seed);
      solve_steady(flow, nullptr, {3, 1e-10, 0});  // Linear in what is there: two iterations and one to spare.
      EXPECT_LT(fastest(flow), 1e-10);
      EXPECT_LT(pressure_error(flow, 1e3), 1e-9 * 1e3);
    }
}

// From rest under another pressure: the fluid takes the one from outside at once, and does not move.
TEST(Rest, StaysThroughSteps) {
  for (const Geometry geometry : kGeometries)
    for (const TimeOrder order : {TimeOrder::first, TimeOrder::second})
      for (const double pressure : {0.0, 1.0, 1e5}) {
        Flow flow = basin(geometry, pressure, 7);
        FlowSolver solver;
        solver.order = order;
        Past past;
        base::Profile profile;
        for (int step = 0; step < 6; ++step) {
          remember(past, flow, 1e-3);
          set_rates(flow, past, order);
          const FlowReport report = advance(flow, past, solver, profile);
          EXPECT_TRUE(report.converged) << "step " << step << ": " << report.reason;
          EXPECT_LE(report.iterations, 2);
          EXPECT_LE(fastest(flow), 1e-12 * pressure);  // Rounding of p dt/(rho h).
          EXPECT_LE(pressure_error(flow, pressure), 1e-9 * pressure);
        }
      }
}

// Where porosity is uniform, a uniform force is borne by a pressure that is linear in space.
TEST(Rest, AUniformForceIsBorneByThePressure) {
  constexpr double kForce = -9810, kPorosity = 0.4;
  for (const Geometry geometry : kGeometries) {
    // Axisymmetric, y is the radius: the force lies along the axis, and the open side is the right one.
    const bool round = geometry == Geometry::axisymmetric;
    Flow flow = at_rest(uneven_mesh(9, 7, 3), {1000, 1e-3, geometry});
    flow.porosity.assign(flow.mesh.vertices(), kPorosity);
    flow.source.assign(flow.mesh.vertices(), round ? base::Vec2{kForce, 0} : base::Vec2{0, kForce});
    const mesh::Side open = round ? mesh::kRight : mesh::kTop;
    for (const mesh::Side side : {mesh::kLeft, mesh::kRight, mesh::kBottom, mesh::kTop}) {
      if (side == open) continue;
      if (!(round && side == mesh::kBottom)) hold_side(flow, side, kVelocityX, 0);
      hold_side(flow, side, kVelocityY, 0);
    }
    FlowSolver solver;
    Past past;
    base::Profile profile;
    for (int step = 0; step < 4; ++step) {
      remember(past, flow, 1e-3);
      set_rates(flow, past, solver.order);
      const FlowReport report = advance(flow, past, solver, profile);
      EXPECT_TRUE(report.converged) << report.reason;
      EXPECT_LT(fastest(flow), 1e-10);
      for (std::size_t v = 0; v < flow.mesh.vertices(); ++v) {
        const double depth = round ? 2 - flow.mesh.position[v].x : 1 - flow.mesh.position[v].y;
        EXPECT_NEAR(flow.unknown[3 * v + kPressure], -kForce / kPorosity * depth, 1e-9 * -kForce / kPorosity);
      }
    }
  }
}

/// Moves every vertex of a mesh at random about the place it had at the start; on the axis along it.
void shake(mesh::TriangleMesh& mesh, const mesh::TriangleMesh& start, bool axisymmetric, Draw& draw) {
  for (std::size_t v = 0; v < mesh.vertices(); ++v) {
    base::Vec2 by = draw.vector(0.012);
    if (axisymmetric && start.position[v].y == 0) by.y = 0;
    mesh.position[v] = start.position[v] + by;
  }
  mesh::check(mesh);
}

// A flow v = U + a t under the force that accelerates it: linear in time, which both orders have exactly. Every vertex
// moves at random in every step, those of the boundary too, by a tenth of its cell and more.
TEST(UniformFlow, StaysUniformOnAMovingMesh) {
  constexpr double kDensity = 1000, kPorosity = 0.6, kStep = 0.01;
  for (const Geometry geometry : kGeometries)
    for (const TimeOrder order : {TimeOrder::first, TimeOrder::second}) {
      const bool round = geometry == Geometry::axisymmetric;
      const base::Vec2 start{0.7, round ? 0.0 : -0.3}, acceleration{2, round ? 0.0 : 1.5};
      const mesh::TriangleMesh mesh = uneven_mesh(8, 6, 5);
      Flow flow = at_rest(mesh, {kDensity, 1e-3, geometry});
      flow.porosity.assign(mesh.vertices(), kPorosity);
      flow.source.assign(mesh.vertices(), kDensity * kPorosity * acceleration);
      for (std::size_t v = 0; v < mesh.vertices(); ++v) {
        flow.unknown[3 * v] = kPorosity * start.x;
        flow.unknown[3 * v + 1] = kPorosity * start.y;
      }
      FlowSolver solver;
      solver.order = order;
      solver.tolerance = 1e-12;
      Past past;
      base::Profile profile;
      Draw draw(11);
      for (int step = 1; step <= 8; ++step) {
        remember(past, flow, kStep);
        shake(flow.mesh, mesh, round, draw);
        set_rates(flow, past, order);
        const base::Vec2 u = kPorosity * (start + step * kStep * acceleration);
        for (const mesh::Side side : {mesh::kLeft, mesh::kBottom, mesh::kTop}) {
          if (!(round && side == mesh::kBottom)) hold_side(flow, side, kVelocityX, u.x);
          hold_side(flow, side, kVelocityY, u.y);
        }
        const FlowReport report = advance(flow, past, solver, profile);
        ASSERT_TRUE(report.converged) << report.reason;
        double error = 0, moved = 0;
        for (std::size_t v = 0; v < mesh.vertices(); ++v) {
          error = std::max(error, std::abs(flow.unknown[3 * v] - u.x));
          error = std::max(error, std::abs(flow.unknown[3 * v + 1] - u.y));
          moved = std::max(moved, norm(flow.mesh_velocity[v]));
        }
        EXPECT_GT(moved, 1.5);  // Faster than the fluid.
        // 1e-10 of the velocity, and of rho U L/dt = 1e5 Pa, the pressure that would stop the flow within a step.
        EXPECT_LT(error, 1e-10) << "step " << step;
        EXPECT_LT(pressure_error(flow, 0), 1e-5);
      }
    }
}

}  // namespace
}  // namespace seapile::fluid
