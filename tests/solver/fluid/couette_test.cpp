// Plane Couette flow is linear: functions of the mesh have it exactly, between walls that move, stick or let slip, and
// between grains whose porosity is linear too.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "solver/fluid/steady.h"
#include "tests/solver/fluid/flow_scenes.h"

namespace seapile::fluid {
namespace {

using support::hold_side;
using support::open_side;

constexpr double kMu = 0.7;

void let_slip(Flow& flow, mesh::Side side, double friction, double wall) {
  for (const mesh::BoundaryEdge& e : flow.mesh.boundary)
    if (e.tag == side) flow.slip.push_back({e.from, e.to, friction, {wall, 0}});
}

// Linear in y, so exact on any mesh: walls that move and stick, and walls that move and let slip.
TEST(Couette, IsExactOnAnyMesh) {
  constexpr double kWall = 0.8, kFriction = 0.6;
  for (const double porosity : {1.0, 0.5})
    for (const bool slip : {false, true}) {
      Flow flow = at_rest(support::uneven_mesh(8, 6, 3), {1.4, kMu, Geometry::planar});
      flow.porosity.assign(flow.mesh.vertices(), porosity);
      for (const mesh::Side side : {mesh::kLeft, mesh::kRight, mesh::kBottom, mesh::kTop})
        hold_side(flow, side, kVelocityY, 0);
      // The shear stress on both ends, which are free of traction otherwise, is part of a linear profile: hold it
      // there.
      const double shear = slip ? kWall / (1 + 2 * kMu / kFriction) : kWall;
      const auto exact = [&](base::Vec2 p) { return slip ? shear * (kMu / kFriction + p.y) : kWall * p.y; };
      hold_side(flow, mesh::kLeft, kVelocityX, [&](base::Vec2 p) { return porosity * exact(p); });
      open_side(flow, mesh::kRight, [](base::Vec2) { return 0.0; });
      if (slip) {
        let_slip(flow, mesh::kBottom, kFriction, 0);
        let_slip(flow, mesh::kTop, kFriction, kWall);
      } else {
        hold_side(flow, mesh::kBottom, kVelocityX, 0);
        hold_side(flow, mesh::kTop, kVelocityX, porosity * kWall);
      }
      ASSERT_TRUE(solve_steady(flow, nullptr).converged);
      for (std::size_t v = 0; v < flow.mesh.vertices(); ++v) {
        // Rounding, through a matrix of a few hundred unknowns.
        EXPECT_NEAR(flow.unknown[3 * v], porosity * exact(flow.mesh.position[v]), 1e-11);
        EXPECT_NEAR(flow.unknown[3 * v + 1], 0, 1e-11);
        EXPECT_NEAR(flow.unknown[3 * v + 2], 0, 1e-10);
      }
    }
}

// v = c y along x in a porosity phi(y), and the same with x and y exchanged. The stress mu phi c varies with phi, and a
// source bears it; the stabilisation sees that they balance.
TEST(Couette, IsExactInALinearPorosity) {
  constexpr double kShear = 0.8;
  const auto phi = [](double across) { return 0.4 + 0.3 * across; };
  for (const bool upright : {false, true}) {
    const auto along = mesh::even(0, 2, 7), across = mesh::even(0, 1, 5);
    Flow flow = at_rest(upright ? mesh::rectangle(across, along) : mesh::rectangle(along, across),
                        {1.4, kMu, Geometry::planar});
    const Component forward = upright ? kVelocityY : kVelocityX, sideways = upright ? kVelocityX : kVelocityY;
    const auto place_across = [&](base::Vec2 p) { return upright ? p.x : p.y; };
    const auto exact = [&](base::Vec2 p) { return phi(place_across(p)) * kShear * place_across(p); };
    for (std::size_t v = 0; v < flow.mesh.vertices(); ++v) {
      flow.porosity[v] = phi(place_across(flow.mesh.position[v]));
      const double source = -kMu * 0.3 * kShear;
      flow.source[v] = upright ? base::Vec2{0, source} : base::Vec2{source, 0};
    }
    const mesh::Side outlet = upright ? mesh::kTop : mesh::kRight;
    for (const mesh::Side side : {mesh::kLeft, mesh::kRight, mesh::kBottom, mesh::kTop}) {
      if (side != outlet) hold_side(flow, side, forward, exact);
      hold_side(flow, side, sideways, 0);
    }
    open_side(flow, outlet, [](base::Vec2) { return 0.0; });
    ASSERT_TRUE(solve_steady(flow, nullptr).converged);
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(flow.mesh.vertices()); ++v) {
      EXPECT_NEAR(flow.u(v, forward), exact(flow.mesh.position[v]), 1e-12);  // Rounding.
      EXPECT_NEAR(flow.u(v, sideways), 0, 1e-12);
      EXPECT_NEAR(flow.u(v, kPressure), 0, 1e-11);
    }
  }
}

}  // namespace
}  // namespace seapile::fluid
