// Orders in time, on meshes that move.
//
// Where space has no error: v and p linear in space and phi uniform are functions of the mesh, the residual vanishes in
// every point, and what is left at the vertices is the error in time. Then a flow that has everything (manufactured.h):
// against the same grid with small steps, and with cells and steps refined together.
//
// The stabilisation depends on the step, tau = 1/(2 rho phi rate) where inertia rules. Tests of one grid keep to steps
// for which friction rules it, rho rate << 6 mu/h^2. On a given mesh the pressure has no limit for ever smaller steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "solver/fluid/advance.h"
#include "tests/solver/fluid/flow_scenes.h"
#include "tests/solver/fluid/manufactured.h"

namespace seapile::fluid {
namespace {

using support::Errors;
using support::Manufactured;

constexpr Geometry kGeometries[] = {Geometry::planar, Geometry::axisymmetric};
constexpr TimeOrder kOrders[] = {TimeOrder::first, TimeOrder::second};

/// v = (a + b x + c y, d + e x + f y), p = g + h x + k y, of time, and phi of time.
///
///   planar         b + f = -phi'/phi
///   axisymmetric   b + 2 f = -phi'/phi;  c = d = e = k = 0, so that it is smooth on the axis
struct LinearFlow {
  Properties fluid;
  double swell = 0;  ///< amplitude of the porosity
  double drag = 4;

  bool round() const { return fluid.geometry == Geometry::axisymmetric; }
  double phi(double t) const { return 0.6 + swell * std::sin(3 * t); }
  base::Vec2 v(base::Vec2 at, double t) const {
    const double spread = -3 * swell * std::cos(3 * t) / phi(t), f = 0.5 * std::sin(2 * t);
    if (round()) return {0.7 * std::cos(4 * t) + (spread - 2 * f) * at.x, f * at.y};
    return {0.7 * std::cos(4 * t) + (spread - f) * at.x + 0.8 * std::sin(2 * t) * at.y,
            std::sin(3 * t) - std::cos(t) * at.x + f * at.y};
  }
  base::Vec2 u(base::Vec2 at, double t) const { return phi(t) * v(at, t); }
  double p(base::Vec2 at, double t) const {
    return std::cos(2 * t) + 3 * std::sin(t) * at.x + (round() ? 0 : std::cos(3 * t) * at.y);
  }
  /// By differences, exact in space and of fourth order in time.
  base::Vec2 source(base::Vec2 at, double t) const {
    constexpr double kStep = 1e-3;
    const base::Vec2 rate = (1 / (12 * kStep)) * (8.0 * (v(at, t + kStep) - v(at, t - kStep)) -
                                                  (v(at, t + 2 * kStep) - v(at, t - 2 * kStep)));
    const base::Vec2 here = v(at, t), right{at.x + 1, at.y}, above{at.x, at.y + 1};
    const base::Vec2 gradient{p(right, t) - p(at, t), p(above, t) - p(at, t)};
    // The stress is uniform and, when round, equal across and around the axis: it has no divergence.
    const base::Vec2 carried = here.x * (v(right, t) - here) + here.y * (v(above, t) - here);
    return fluid.density * phi(t) * (rate + carried) + phi(t) * gradient + drag * slip(t);
  }
  /// u - u_g, uniform: drag, which is lumped, is exact for it.
  static base::Vec2 slip(double t) { return {std::cos(5 * t), 0}; }
  double pressure_outside(base::Vec2 at, double t) const {
    return p(at, t) - 2 * fluid.viscosity * (v({at.x + 1, at.y}, t).x - v(at, t).x);
  }
};

/// Largest errors at the vertices after `steps` steps to t = 0.5.
Errors linear_flow_after(const LinearFlow& exact, int steps, TimeOrder order) {
  constexpr double kTime = 0.5;
  const mesh::TriangleMesh start = support::uneven_mesh(4, 3, 2);
  Flow flow = at_rest(start, exact.fluid);
  flow.drag.assign(start.vertices(), exact.drag);
  const auto set_time = [&](double t) {
    for (std::size_t v = 0; v < start.vertices(); ++v) {
      // Upright sides stay upright, and the axis where it is.
      const base::Vec2 from = start.position[v];
      flow.mesh.position[v] = {from.x + 0.1 * std::sin(5 * t + from.x), from.y * (1 + 0.1 * std::sin(6 * t + from.x))};
      flow.porosity[v] = exact.phi(t);
      flow.source[v] = exact.source(flow.mesh.position[v], t);
      flow.carried[v] = exact.u(flow.mesh.position[v], t) - LinearFlow::slip(t);
    }
    flow.open.clear();
    support::open_side(flow, mesh::kRight, [&](base::Vec2 at) { return exact.pressure_outside(at, t); });
    for (const mesh::Side side : {mesh::kLeft, mesh::kRight, mesh::kBottom, mesh::kTop}) {
      const bool free = side == mesh::kRight || (side == mesh::kBottom && exact.round());
      if (!free) support::hold_side(flow, side, kVelocityX, [&](base::Vec2 at) { return exact.u(at, t).x; });
      support::hold_side(flow, side, kVelocityY, [&](base::Vec2 at) { return exact.u(at, t).y; });
    }
  };
  set_time(0);
  for (std::size_t v = 0; v < start.vertices(); ++v) {
    const base::Vec2 at = flow.mesh.position[v], u = exact.u(at, 0);
    flow.unknown[3 * v] = u.x;
    flow.unknown[3 * v + 1] = u.y;
    flow.unknown[3 * v + 2] = exact.p(at, 0);
  }
  FlowSolver solver;
  solver.order = order;
  solver.tolerance = 1e-11;
  Past past;
  base::Profile profile;
  for (int step = 1; step <= steps; ++step) {
    remember(past, flow, kTime / steps);
    set_time(kTime * step / steps);
    set_rates(flow, past, order);
    const FlowReport report = advance(flow, past, solver, profile);
    EXPECT_TRUE(report.converged) << report.reason;
  }
  Errors errors;
  for (std::size_t v = 0; v < start.vertices(); ++v) {
    const base::Vec2 at = flow.mesh.position[v],
                     wrong = base::Vec2{flow.unknown[3 * v], flow.unknown[3 * v + 1]} - exact.u(at, kTime);
    errors.velocity = std::max(errors.velocity, norm(wrong));
    errors.pressure = std::max(errors.pressure, std::abs(flow.unknown[3 * v + 2] - exact.p(at, kTime)));
  }
  return errors;
}

/// Prints a row and returns the orders since the last one.
Errors row(const char* what, int count, const Errors& error, const Errors& last) {
  const Errors order{std::log2(last.velocity / error.velocity), std::log2(last.pressure / error.pressure)};
  std::printf("%s %4d %12.3e %6.2f %12.3e %6.2f\n", what, count, error.velocity, last.velocity > 0 ? order.velocity : 0,
              error.pressure, last.velocity > 0 ? order.pressure : 0);
  return order;
}

// Without a swelling porosity the error is that of dv/dt and of the mesh's velocity; with it, and little inertia, that
// of dphi/dt.
TEST(TimeOrder, IsThatOfTheSchemeWhereSpaceIsExact) {
  for (const Geometry geometry : kGeometries)
    for (const bool swelling : {false, true})
      for (const TimeOrder order : kOrders) {
        const LinearFlow exact{{2, swelling ? 30 : 0.3, geometry}, swelling ? 0.2 : 0};
        std::printf("%s, order %d%s: steps, v, p\n", geometry == Geometry::planar ? "planar" : "axisymmetric",
                    static_cast<int>(order), swelling ? ", swelling" : "");
        Errors last, found;
        for (const int steps : {10, 20, 40, 80}) {
          const Errors error = linear_flow_after(exact, steps, order);
          found = row("", steps, error, last);
          last = error;
        }
        // Of the last pair; constants fall to their limit from either side.
        EXPECT_GT(found.velocity, static_cast<int>(order) - 0.1);
        EXPECT_GT(found.pressure, static_cast<int>(order) - 0.1);
      }
}

/// A flow that has everything, after `steps` steps to t = 0.8.
Flow full_flow_after(const Manufactured& exact, int cells, int steps, TimeOrder order) {
  constexpr double kTime = 0.8;
  const mesh::TriangleMesh regular = support::manufactured_mesh(cells);
  Flow flow = at_rest(regular, exact.fluid);
  support::set_time(flow, exact, regular, 0);
  support::set_exact(flow, exact, 0);
  FlowSolver solver;
  solver.order = order;
  solver.instructions = base::fastest();
  Past past;
  base::Profile profile;
  for (int step = 1; step <= steps; ++step) {
    remember(past, flow, kTime / steps);
    support::set_time(flow, exact, regular, kTime * step / steps);
    set_rates(flow, past, order);
    const FlowReport report = advance(flow, past, solver, profile);
    EXPECT_TRUE(report.converged) << report.reason;
  }
  return flow;
}

/// Root mean squares of what two states on one mesh differ by, relative to the second.
Errors difference(const Flow& a, const Flow& b) {
  double wrong[2] = {}, norm[2] = {};
  for (std::size_t i = 0; i < a.unknown.size(); ++i) {
    const int k = i % 3 == kPressure;
    wrong[k] += std::pow(a.unknown[i] - b.unknown[i], 2);
    norm[k] += std::pow(b.unknown[i], 2);
  }
  return {std::sqrt(wrong[0] / norm[0]), std::sqrt(wrong[1] / norm[1])};
}

TEST(TimeOrder, IsThatOfTheSchemeOnAGivenMesh) {
  constexpr int kCells = 16;
  for (const Geometry geometry : kGeometries) {
    const Manufactured exact{{1, 5, geometry}, 0.15, 0.1, 3, 10, 30, 0.2};
    const Flow reference = full_flow_after(exact, kCells, 256, TimeOrder::second);
    for (const TimeOrder order : kOrders) {
      std::printf("%s, order %d: steps, u, p\n", geometry == Geometry::planar ? "planar" : "axisymmetric",
                  static_cast<int>(order));
      Errors last, found;
      for (const int steps : {8, 16, 32}) {
        const Errors error = difference(full_flow_after(exact, kCells, steps, order), reference);
        found = row("", steps, error, last);
        last = error;
      }
      EXPECT_GT(found.velocity, static_cast<int>(order) - 0.15);
      EXPECT_GT(found.pressure, static_cast<int>(order) - 0.15);
    }
  }
}

// Porosity in space and time, motion of the mesh, inertia, friction and drag at Re 40.
TEST(ManufacturedFlow, HasItsOrderInSpaceAndTimeTogether) {
  for (const Geometry geometry : kGeometries) {
    const Manufactured exact{{20, 0.5, geometry}, 0.15, 0.1, 2, 10, 30, 0.2};
    std::printf("%s: cells, u, p\n", geometry == Geometry::planar ? "planar" : "axisymmetric");
    Errors last, found;
    for (const int cells : {8, 16, 32, 64}) {
      const Errors error = support::errors_of(full_flow_after(exact, cells, cells / 2, TimeOrder::second), exact, 0.8);
      found = row("", cells, error, last);
      last = error;
    }
    EXPECT_GT(found.velocity, 1.85);
    EXPECT_GT(found.pressure, 1.5);
  }
}

}  // namespace
}  // namespace seapile::fluid
