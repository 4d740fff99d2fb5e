// What an edge of the boundary adds to the residuals of its two ends. Scalar is double or a dual number.
//
//   pressure from outside     - integral of t.w,  t = -phi p_ext n
//   Navier slip               - integral of t.w,  t = -friction phi (v - wall)
//   free surface              the outside pressure, and gamma times the derivative of the surface's area in the
//   direction of w kinematic condition       integral of (dh/dt + v_x dh/dx - v_y)(N + share (dx/2) sign(v_x) N')
//
// Surface tension: integral of gamma kappa n.w = -(integral of gamma div_s w) + [gamma s.w] at the film's ends, s
// pointing out of the film. It is the exact derivative of the polygon's length (planar) or of its area of revolution,
// and needs no curvature. Axisymmetric integrals have the weight y, as those over triangles.
#pragma once

#include <array>
#include <cmath>

#include "solver/base/vec2.h"
#include "solver/fluid/element.h"

namespace seapile::fluid {

/// An end of an edge: its place, and the velocity there.
template <class Scalar>
struct EdgeEnd {
  Scalar x, y, ux, uy;
};
/// Forces of the two ends in x and y.
template <class Scalar>
using EdgeForces = std::array<std::array<Scalar, 2>, 2>;

/// Points of Gauss on [0, 1], exact to degree 3; each has the weight 1/2.
inline constexpr double kGauss[2] = {0.21132486540518713, 0.78867513459481287};

/// Residuals from the outside pressure; the domain lies to the left of the edge from [0] to [1]. `porosity` at its
/// ends.
template <class Scalar>
EdgeForces<Scalar> pressure_force(Geometry geometry, const std::array<EdgeEnd<Scalar>, 2>& end,
                                  const std::array<double, 2>& porosity, const std::array<double, 2>& pressure) {
  // n ds = (dy, -dx): to the right.
  const Scalar nx = end[1].y - end[0].y, ny = end[0].x - end[1].x;
  EdgeForces<Scalar> force;
  for (auto& f : force) f = {0 * nx, 0 * nx};
  for (const double at : kGauss) {
    const double p = ((1 - at) * porosity[0] + at * porosity[1]) * ((1 - at) * pressure[0] + at * pressure[1]);
    Scalar weight = 0.5 * p + 0 * nx;
    if (geometry == Geometry::axisymmetric) weight *= (1 - at) * end[0].y + at * end[1].y;
    for (int i = 0; i < 2; ++i) {
      const double N = i == 0 ? 1 - at : at;
      force[i][0] += N * weight * nx;
      force[i][1] += N * weight * ny;
    }
  }
  return force;
}

/// Residuals from Navier's slip; `porosity` at the two ends.
template <class Scalar>
EdgeForces<Scalar> slip_force(Geometry geometry, const std::array<EdgeEnd<Scalar>, 2>& end,
                              const std::array<double, 2>& porosity, double friction, base::Vec2 wall) {
  using std::sqrt;
  const Scalar dx = end[1].x - end[0].x, dy = end[1].y - end[0].y, length = sqrt(dx * dx + dy * dy);
  EdgeForces<Scalar> force;
  for (auto& f : force) f = {0 * dx, 0 * dx};
  for (const double at : kGauss) {
    const base::Vec2 carried = ((1 - at) * porosity[0] + at * porosity[1]) * wall;
    Scalar slide = ((1 - at) * end[0].ux + at * end[1].ux - carried.x) * dx +
                   ((1 - at) * end[0].uy + at * end[1].uy - carried.y) * dy;
    slide = 0.5 * friction * slide / length;
    if (geometry == Geometry::axisymmetric) slide *= (1 - at) * end[0].y + at * end[1].y;
    for (int i = 0; i < 2; ++i) {
      const double N = i == 0 ? 1 - at : at;
      force[i][0] += N * slide * dx;
      force[i][1] += N * slide * dy;
    }
  }
  return force;
}

/// Residuals from tension and outside pressure on an edge of the free surface; the domain lies to the left.
template <class Scalar>
EdgeForces<Scalar> surface_force(Geometry geometry, const std::array<EdgeEnd<Scalar>, 2>& end,
                                 const std::array<double, 2>& porosity, double tension, double outside_pressure) {
  using std::sqrt;
  EdgeForces<Scalar> force = pressure_force(geometry, end, porosity, {outside_pressure, outside_pressure});
  const Scalar dx = end[1].x - end[0].x, dy = end[1].y - end[0].y, length = sqrt(dx * dx + dy * dy);
  Scalar pull = tension / length;
  if (geometry == Geometry::axisymmetric) {
    pull = pull * 0.5 * (end[0].y + end[1].y);
    for (auto& f : force) f[1] += 0.5 * tension * length;
  }
  force[1][0] += pull * dx;
  force[1][1] += pull * dy;
  force[0][0] -= pull * dx;
  force[0][1] -= pull * dy;
  return force;
}

/// Residuals of a film's last vertex: what pulls it on where the film is cut off. `inner`: the vertex before it.
template <class Scalar>
std::array<Scalar, 2> film_pull(Geometry geometry, const EdgeEnd<Scalar>& end, const EdgeEnd<Scalar>& inner,
                                double tension) {
  using std::sqrt;
  const Scalar dx = end.x - inner.x, dy = end.y - inner.y;
  Scalar pull = tension / sqrt(dx * dx + dy * dy);
  if (geometry == Geometry::axisymmetric) pull = pull * end.y;
  return {-pull * dx, -pull * dy};
}

/// Residuals of the kinematic condition on an edge of the surface, x rising from [0] to [1]; dh/dt = rate[i] (h -
/// before[i]).
template <class Scalar>
std::array<Scalar, 2> kinematic_residual(const std::array<EdgeEnd<Scalar>, 2>& end, const std::array<double, 2>& rate,
                                         const std::array<double, 2>& before, double upwinding) {
  const Scalar dx = end[1].x - end[0].x, slope = (end[1].y - end[0].y) / dx;
  std::array<Scalar, 2> residual{0 * dx, 0 * dx};
  for (const double at : kGauss) {
    const Scalar vx = (1 - at) * end[0].ux + at * end[1].ux, vy = (1 - at) * end[0].uy + at * end[1].uy;
    const Scalar rise = (1 - at) * rate[0] * (end[0].y - before[0]) + at * rate[1] * (end[1].y - before[1]);
    const Scalar balance = rise + vx * slope - vy;
    const double direction = plain(vx) < 0 ? -1 : 1;
    for (int i = 0; i < 2; ++i) {
      // N' dx/2 = -+1/2.
      const double test = (i == 0 ? 1 - at : at) + (i == 0 ? -0.5 : 0.5) * upwinding * direction;
      residual[i] += 0.5 * test * dx * balance;
    }
  }
  return residual;
}

}  // namespace seapile::fluid
