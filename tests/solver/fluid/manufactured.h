// A flow that is chosen, and the source that makes it a solution of solver/fluid/element.h (the method of manufactured
// solutions). Each term of the equations can be left out.
//
//   porosity    phi = 0.7 + a sin 2x cos wt + b cos 2y, or 1
//   velocity    u = (P, 0) + curl psi,  P = -(a w/2) cos 2x sin wt
//               so that dphi/dt + div u = 0 in both geometries, exactly: the mass equation has no source.
//     planar         psi = 0.3 sin X cos Y + 0.4 y,          u = (dpsi/dy, -dpsi/dx)
//     axisymmetric   psi = y^2 g, g = 0.3 cos X cos 2y,      u = (dpsi/dy, -dpsi/dx)/y
//               with X = 2x + 0.5 + wt, Y = 3y + 0.3
//   pressure    p = P0 sin(1.5 x + 0.4) cos 2y (1 + 0.5 sin wt)
//   drag        beta = B (1 + 0.5 cos 2y)
//   source      s = rho phi (dv/dt + v.grad v) + phi grad p - div(mu phi (grad v + grad v^T)) + beta u,  v = u/phi
//
// Axisymmetric, x is the axis and y the radius: fields are even in y but for u_y, which is odd, so they are smooth on
// the axis. div has 1/y terms there, S_xy/y and (S_yy - S_hoop)/y, whose limits on the axis are dS_xy/dy and 0.
//
// The domain is the unit square; its vertices have been moved, and move, along its sides and inside it:
//
//   place       (xi, eta) + (0.06 + m sin t) (sin pi xi cos pi eta, cos pi xi sin pi eta)
//
// Velocities are held on the left and on top, and below unless that is the axis (where only u_y = 0 is). On the right
// u_y is held and the normal traction given, so that no pressure has to be held.
#pragma once

#include <cmath>
#include <numbers>

#include "solver/fluid/flow.h"
#include "solver/mesh/rectangle.h"
#include "tests/solver/fluid/jet.h"

namespace seapile::fluid::support {

/// What is switched on.
struct Manufactured {
  Properties fluid{0, 1, Geometry::planar};
  double porosity_x = 0;  ///< a
  double porosity_y = 0;  ///< b
  double frequency = 0;   ///< w [1/s]
  double pressure = 1;    ///< P0
  double drag = 0;        ///< B
  double motion = 0;      ///< m

  bool axisymmetric() const { return fluid.geometry == Geometry::axisymmetric; }

  Jet porosity(const Arguments& at) const {
    if (porosity_x == 0 && porosity_y == 0) return 1;
    return 0.7 + porosity_x * sin(2 * at.x) * cos(frequency * at.t) + porosity_y * cos(2 * at.y);
  }
  struct Velocity {
    Jet x, y;
  };
  Velocity superficial(const Arguments& at) const {
    const Jet P = -0.5 * porosity_x * frequency * cos(2 * at.x) * sin(frequency * at.t);
    const Jet X = 2 * at.x + 0.5 + frequency * at.t, Y = 3 * at.y + 0.3;
    if (!axisymmetric()) return {P + 0.4 - 0.9 * sin(X) * sin(Y), -0.6 * cos(X) * cos(Y)};
    return {P + 0.6 * cos(X) * (cos(2 * at.y) - at.y * sin(2 * at.y)), 0.6 * at.y * sin(X) * cos(2 * at.y)};
  }
  Velocity interstitial(const Arguments& at) const {
    const Jet phi = porosity(at);
    const Velocity u = superficial(at);
    return {u.x / phi, u.y / phi};
  }
  Jet pressure_at(const Arguments& at) const {
    return pressure * sin(1.5 * at.x + 0.4) * cos(2 * at.y) * (1 + 0.5 * sin(frequency * at.t));
  }
  double drag_at(double y) const { return drag * (1 + 0.5 * std::cos(2 * y)); }

  /// s with dv/dt at a place that moves with `mesh`, when the caller counts it elsewhere (with_rate false: without it).
  base::Vec2 source(base::Vec2 place, double time) const { return source(place, time, {}, true); }
  base::Vec2 source_without_rate(base::Vec2 place, double time, base::Vec2 mesh) const {
    return source(place, time, mesh, false);
  }

  /// Traction on the right side, as a pressure from outside.
  double pressure_outside(base::Vec2 place, double time) const {
    const Arguments at(place.x, place.y, time);
    return pressure_at(at).value - 2 * fluid.viscosity * interstitial(at).x.x;
  }

 private:
  base::Vec2 source(base::Vec2 place, double time, base::Vec2 mesh, bool with_rate) const {
    const Arguments at(place.x, place.y, time);
    const Jet phi = porosity(at), p = pressure_at(at);
    const auto [vx, vy] = interstitial(at);
    const auto [ux, uy] = superficial(at);
    // dv/dt of the equation is at a fixed place. Without it: that at the moving vertex, dv/dt + w.grad v, is left out.
    const double rate = with_rate ? 1 : 0;
    const double rx = rate * vx.t + (vx.value - mesh.x) * vx.x + (vy.value - mesh.y) * vx.y;
    const double ry = rate * vy.t + (vx.value - mesh.x) * vy.x + (vy.value - mesh.y) * vy.y;
    const double shear = vx.y + vy.x, shear_x = vx.xy + vy.xx, shear_y = vx.yy + vy.xy;
    double fx = 2 * (phi.x * vx.x + phi.value * vx.xx) + phi.y * shear + phi.value * shear_y;
    double fy = phi.x * shear + phi.value * shear_x + 2 * (phi.y * vy.y + phi.value * vy.yy);
    if (axisymmetric()) {
      const double y = place.y;
      fx += phi.value * (y > 0 ? shear / y : shear_y);
      fy += y > 0 ? 2 * phi.value * (vy.y - vy.value / y) / y : 0;
    }
    const double inertia = fluid.density * phi.value, mu = fluid.viscosity, beta = drag_at(place.y);
    return {inertia * rx + phi.value * p.x - mu * fx + beta * ux.value,
            inertia * ry + phi.value * p.y - mu * fy + beta * uy.value};
  }
};

/// The mesh of `cells` x `cells` cells at a time.
inline mesh::TriangleMesh manufactured_mesh(int cells) {
  return mesh::rectangle(mesh::even(0, 1, cells), mesh::even(0, 1, cells));
}
struct Motion {
  base::Vec2 place, velocity;
};
/// Where the vertex that is at `start` in the regular grid is, and how fast.
inline Motion motion_of(const Manufactured& flow, base::Vec2 start, double time) {
  constexpr double pi = std::numbers::pi;
  const base::Vec2 shift{std::sin(pi * start.x) * std::cos(pi * start.y),
                         std::cos(pi * start.x) * std::sin(pi * start.y)};
  // sin pi is no zero of doubles; vertices of the sides stay on them.
  const base::Vec2 by{start.x == 1 ? 0 : shift.x, start.y == 1 ? 0 : shift.y};
  return {start + (0.06 + flow.motion * std::sin(time)) * by, flow.motion * std::cos(time) * by};
}

/// Moves the mesh to a time and sets porosity, drag, source and boundary values there. `regular` is the regular grid.
/// Unknowns are left alone but for those that are held.
inline void set_time(Flow& flow, const Manufactured& exact, const mesh::TriangleMesh& regular, double time) {
  const auto count = static_cast<std::int32_t>(flow.mesh.vertices());
  for (std::int32_t v = 0; v < count; ++v) {
    const base::Vec2 p = flow.mesh.position[v] = motion_of(exact, regular.position[v], time).place;
    flow.porosity[v] = exact.porosity({p.x, p.y, time}).value;
    flow.drag[v] = exact.drag_at(p.y);
    flow.source[v] = exact.source(p, time);
  }
  flow.open.clear();
  for (const mesh::BoundaryEdge& e : flow.mesh.boundary) {
    if (e.tag == mesh::kRight)
      flow.open.push_back({e.from,
                           e.to,
                           {exact.pressure_outside(flow.mesh.position[e.from], time),
                            exact.pressure_outside(flow.mesh.position[e.to], time)}});
    for (const std::int32_t v : {e.from, e.to}) {
      const base::Vec2 p = flow.mesh.position[v];
      const auto u = exact.superficial({p.x, p.y, time});
      const bool axis = e.tag == mesh::kBottom && exact.axisymmetric();
      if (e.tag != mesh::kRight && !axis) hold(flow, v, kVelocityX, u.x.value);
      hold(flow, v, kVelocityY, u.y.value);
    }
  }
}

/// The exact unknowns at the vertices.
inline void set_exact(Flow& flow, const Manufactured& exact, double time) {
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v) {
    const Arguments at(flow.mesh.position[v].x, flow.mesh.position[v].y, time);
    const auto u = exact.superficial(at);
    flow.unknown[3 * v] = u.x.value;
    flow.unknown[3 * v + 1] = u.y.value;
    flow.unknown[3 * v + 2] = exact.pressure_at(at).value;
  }
}

/// Errors in L2, by the exact field's own norm: over the domain with the geometry's weight, and over the triangles that
/// touch the bottom (the axis) without weight, which near an axis would hide them.
struct Errors {
  double velocity = 0, pressure = 0, velocity_below = 0, pressure_below = 0;
};
inline Errors errors_of(const Flow& flow, const Manufactured& exact, double time) {
  double wrong[4] = {}, norm[4] = {};
  for (const auto& t : flow.mesh.triangle) {
    const auto& p = flow.mesh.position;
    const double area = 0.5 * mesh::doubled_area(p[t[0]], p[t[1]], p[t[2]]);
    const bool below = p[t[0]].y == 0 || p[t[1]].y == 0 || p[t[2]].y == 0;
    for (const QuadraturePoint& point : kQuadrature<Geometry::axisymmetric>) {
      double x = 0, y = 0, u[3] = {};
      for (int i = 0; i < 3; ++i) {
        x += point.at[i] * p[t[i]].x;
        y += point.at[i] * p[t[i]].y;
        for (int c = 0; c < 3; ++c) u[c] += point.at[i] * flow.unknown[3 * t[i] + c];
      }
      const Arguments at(x, y, time);
      const auto v = exact.superficial(at);
      const double ux = v.x.value, uy = v.y.value, q = exact.pressure_at(at).value, weight = area * point.weight;
      const double du = (u[0] - ux) * (u[0] - ux) + (u[1] - uy) * (u[1] - uy), dp = (u[2] - q) * (u[2] - q);
      const double whole = weight * (exact.axisymmetric() ? y : 1), strip = below ? weight : 0;
      const double squares[] = {whole * du, whole * dp, strip * du, strip * dp};
      const double scales[] = {whole * (ux * ux + uy * uy), whole * q * q, strip * (ux * ux + uy * uy), strip * q * q};
      for (int k = 0; k < 4; ++k) wrong[k] += squares[k], norm[k] += scales[k];
    }
  }
  return {std::sqrt(wrong[0] / norm[0]), std::sqrt(wrong[1] / norm[1]), std::sqrt(wrong[2] / norm[2]),
          std::sqrt(wrong[3] / norm[3])};
}

}  // namespace seapile::fluid::support
