// Orders in space, term by term and all at once, by manufactured solutions (manufactured.h).
//
// A single instant of a flow that may change in time, on a mesh that may move: the rates dphi/dt and w are given, and
// dv/dt at the vertices is part of the source. What is left are the terms in space.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "solver/fluid/steady.h"
#include "tests/solver/fluid/manufactured.h"

namespace seapile::fluid {
namespace {

using support::Errors;
using support::Manufactured;

constexpr double kInstant = 0.4;

Errors error_on(const Manufactured& exact, int cells) {
  const mesh::TriangleMesh regular = support::manufactured_mesh(cells);
  Flow flow = at_rest(regular, exact.fluid);
  support::set_time(flow, exact, regular, kInstant);
  for (std::size_t v = 0; v < regular.vertices(); ++v) {
    const base::Vec2 p = flow.mesh.position[v], w = support::motion_of(exact, regular.position[v], kInstant).velocity;
    const support::Jet phi = exact.porosity({p.x, p.y, kInstant});
    flow.mesh_velocity[v] = w;
    flow.porosity_rate[v] = phi.t + w.x * phi.x + w.y * phi.y;
    flow.source[v] = exact.source_without_rate(p, kInstant, w);
  }
  support::set_exact(flow, exact, kInstant);
  const NewtonReport report = solve_steady(flow, nullptr);
  EXPECT_TRUE(report.converged) << report.reason;
  return support::errors_of(flow, exact, kInstant);
}

struct Term {
  std::string name;
  Manufactured flow;
  std::vector<int> cells{8, 16, 32, 64};
  double order_below = 1.6;  ///< least of the velocity along the lowest row
};

/// P0 is of the size of the forces, so that relative errors of the pressure say something.
std::vector<Term> terms(Geometry geometry) {
  const Properties creeping{0, 1, geometry}, inertial{20, 0.5, geometry}, fast{20, 0.1, geometry};
  return {
      {"viscous stress alone", {creeping}},
      {"inertia, Re 40", {inertial, 0, 0, 0, 10}},
      {"inertia, Re 200", {fast, 0, 0, 0, 10}, {8, 16, 32, 64}},
      {"porosity in space", {creeping, 0.15, 0.1}},
      {"porosity in space and time", {creeping, 0.15, 0.1, 2, 1}},
      {"inertia on a moving mesh", {inertial, 0, 0, 0, 10, 0, 0.2}},
      {"porosity on a moving mesh", {creeping, 0.15, 0.1, 2, 1, 0, 0.2}},
      {"drag", {creeping, 0, 0, 0, 10, 30}},
      // The velocity is the gradient of the pressure, of first order where it is not held: on the axis.
      {"drag that rules", {creeping, 0, 0, 0, 3e4, 1e5}, {8, 16, 32, 64}, 1.0},
      {"porosity and drag", {creeping, 0.15, 0.1, 0, 300, 1000}},
      {"all", {inertial, 0.15, 0.1, 2, 10, 30, 0.2}, {8, 16, 32, 64}},
  };
}

constexpr double Errors::*kWhich[] = {&Errors::velocity, &Errors::pressure, &Errors::velocity_below,
                                      &Errors::pressure_below};

void expect_orders(Geometry geometry) {
  for (const Term& term : terms(geometry)) {
    std::printf("%s\n%6s %12s %6s %12s %6s %12s %6s %12s %6s\n", term.name.c_str(), "cells", "u", "order", "p", "order",
                "u, lowest", "order", "p, lowest", "order");
    Errors last;
    double order[4] = {};
    for (const int cells : term.cells) {
      const Errors error = error_on(term.flow, cells);
      std::printf("%6d", cells);
      for (int k = 0; k < 4; ++k) {
        order[k] = last.velocity > 0 ? std::log2(last.*kWhich[k] / error.*kWhich[k]) : 0;
        std::printf(" %12.3e %6.2f", error.*kWhich[k], order[k]);
      }
      std::printf("\n");
      last = error;
    }
    // Of the last two grids. The limits are 2 for the velocity and, in theory, 1 for the pressure; 1.5 is what a layer
    // of one cell with an error of order 1 along the walls leaves.
    EXPECT_GT(order[0], 1.85) << term.name;
    EXPECT_GT(order[1], 1.5) << term.name;
    // Along the axis, without the weight that vanishes there: h^2 log h, which is 1.7 here, and the layer of the
    // pressure.
    EXPECT_GT(order[2], term.order_below) << term.name;
    EXPECT_GT(order[3], 1.0) << term.name;
  }
}

TEST(ManufacturedFlow, EveryTermHasItsOrderInSpacePlanar) { expect_orders(Geometry::planar); }
TEST(ManufacturedFlow, EveryTermHasItsOrderInSpaceAxisymmetric) { expect_orders(Geometry::axisymmetric); }

}  // namespace
}  // namespace seapile::fluid
