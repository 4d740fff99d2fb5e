// Momentum and mass of a fluid between grains, on one triangle of a moving mesh: what the solver assembles.
//
//   rho phi (dv/dt + (v - w).grad v) = -phi grad p + div(mu phi (grad v + grad v^T)) - beta (u - u_g) + s   momentum
//   dphi/dt + div u + div q = 0,   u = phi v,   q = -kappa grad p + chi (u - u_g)                            mass
//
// with phi the porosity, v the interstitial and u the superficial velocity, w the velocity of the mesh, d/dt at a fixed
// vertex (in the mass equation dphi/dt at a fixed place: dphi/dt - w.grad phi), p the pressure without the hydrostatic
// one, beta a drag coefficient, u_g the velocity of what drags (phi times that of the grains), s a source. q is the
// grains' answer within the step: what pressure and drag of this step add to the volume that the grains carry
// (solver/coupling/exchange.h); without it a light, dense bed and the water take turns in pushing each other, the more
// the shorter the step. It is the thesis' (5.1) and (5.2) (its div(u u / phi) is phi v.grad v with
// the mass equation), where the grains' pressure force (1 - phi) grad p stands inside (docs/formulation.md), and the
// viscous stress is mu phi (grad v + grad v^T), not doubled (a slip of the thesis: 2 mu phi d with d the full sum).
//
// Scheme: linear u and p on triangles. Galerkin terms, with v interpolated between its values u/phi at the vertices,
// the drag's Galerkin term lumped at the vertices, so that what each grain gives is the sum of what the vertices
// around it get, and
//   PSPG   phi tau (grad q).R       makes equal orders stable             Tezduyar et al. 1992
//   SUPG   rho phi tau ((v-w).grad w).R                                   Brooks, Hughes 1982
//   LSIC   tau_L (div w)(dphi/dt + div u)                                 Tezduyar, Osawa 2000
// with R the momentum residual, all terms of which are there that linear functions have. phi grad p is integrated by
// parts as a whole, to -p div(phi w), so the natural boundary condition is the full traction on the fluid's share of
// the boundary: phi (-p I + mu (grad v + grad v^T)) n = phi t. With grad p alone integrated, and (1 - phi) grad p left
// inside, a flow between grains through an open boundary had an error of first order in p.
// Order: 2 in velocity, at least 1.5 in pressure (L2). tau belongs to the state before the iteration: it is not
// differentiated. Axisymmetric: x is the axis, y the radius; every integral has the weight y, strain has v_y / y, and a
// factor 2 pi is left out. Without convection a = v - w is a = -w everywhere, in SUPG, tau and tau_L too.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <type_traits>

namespace seapile::fluid {

enum class Geometry { planar, axisymmetric };

/// Whether v.grad v is in the momentum equation. Omitted: the unsteady Stokes equations, linear in u and p, for flows
/// whose Reynolds number is small. What the mesh's own motion adds, -w.grad v, stays: without it d/dt would not be that
/// of a place.
enum class Convection { included, omitted };

/// The fluid. SI, or any consistent units.
struct Properties {
  double density = 1000;    ///< rho [kg/m3]; 0: creeping flow
  double viscosity = 1e-3;  ///< mu [Pa s]
  Geometry geometry = Geometry::planar;
  Convection convection = Convection::included;
};

/// What is known at a triangle's vertices when its velocities and pressures are asked for. Real is double, or a vector
/// of doubles for as many triangles.
template <class Real>
struct ElementInput {
  std::array<Real, 3> porosity;                      ///< phi [-]
  std::array<Real, 3> porosity_rate;                 ///< dphi/dt at the (moving) vertex [1/s]
  std::array<std::array<Real, 2>, 3> mesh_velocity;  ///< w [m/s]
  std::array<std::array<Real, 2>, 3> history;        ///< dv/dt = rate v + history [m/s2]
  std::array<std::array<Real, 2>, 3> source;         ///< s [N/m3]
  std::array<Real, 3> drag;                          ///< beta [kg/m3/s]
  std::array<std::array<Real, 2>, 3> carried;        ///< u_g [m/s]
  std::array<Real, 3> mobility;                      ///< kappa [m3 s/kg]
  std::array<Real, 3> response;                      ///< chi [-]
  double rate = 0;                                   ///< [1/s], of the time scheme; 0: steady
  double unsteadiness = 0;                           ///< s of the stabilisation [1/s]
};

/// A triangle's unknowns: superficial velocity u [m/s] and pressure p [Pa], by vertex.
inline constexpr int kUnknowns = 9;

/// A number without its derivatives.
inline double plain(double value) { return value; }
template <class Dual>
requires requires(const Dual& dual) { dual.value(); }
auto plain(const Dual& dual) { return dual.value(); }
inline double root(double value) { return std::sqrt(value); }
inline double smaller(double a, double b) { return a < b ? a : b; }

/// Scales of the stabilisation.
template <class Real>
struct Stabilisation {
  Real tau;   ///< of the momentum residual [m3 s/kg]
  Real lsic;  ///< tau_L [Pa s]
};

/// tau = 1/sqrt((2 rho phi s)^2 + (2 rho phi |a|/h)^2 + (12 mu phi/h^2)^2 + (beta phi)^2), a = v - w, of Tezduyar's
/// family; h is the diameter of the circle of equal area. tau_L = rho |a| h/2 min(Re/3, 1), Re = |a| h/(2 nu)
/// (Tezduyar, Osawa 2000). s is the fastest rate at which the flow changes. Usually it is that of the time scheme,
/// 1/dt; but then a steady state depends on the step that led to it (die swell: 5e-4 of the swell ratio at dt = 0.005
/// H/U), and the pressure on a moving mesh gets worse as dt -> 0 (Taylor-Green on 16^2 cells, dt = 2.5e-4: an error of
/// 0.40 instead of 0.024 with s = 0). Without s a slow wave is spoilt: of its mass equation the stabilisation is a
/// share of rho tau s (k h)^2. So a scene that knows s says it.
template <class Real>
Stabilisation<Real> stabilisation(const Properties& fluid, const Real& area, const Real& porosity, double unsteadiness,
                                  const Real& relative_speed, const Real& drag) {
  const Real h = root(area * (4 / std::numbers::pi)), inertia = fluid.density * porosity;
  const Real in_time = 2 * unsteadiness * inertia, along = 2 * inertia * relative_speed / h,
             across = 12 * fluid.viscosity * porosity / (h * h), resisted = drag * porosity;
  const Real tau = 1 / root(in_time * in_time + along * along + across * across + resisted * resisted);
  const Real momentum = fluid.density * relative_speed * h;
  return {tau, 0.5 * momentum * smaller(momentum * (1 / (6 * fluid.viscosity)), Real(1.0))};
}

/// A point of a quadrature over triangles.
struct QuadraturePoint {
  std::array<double, 3> at;  ///< barycentric coordinates
  double weight;             ///< of the area
};
/// Planar: exact to degree 2. Axisymmetric, where integrands have y or 1/y: exact to degree 4 (Strang and Fix 1973).
template <Geometry kGeometry>
inline constexpr std::array kQuadrature = [] {
  if constexpr (kGeometry == Geometry::planar) {
    return std::array<QuadraturePoint, 3>{{{{2.0 / 3, 1.0 / 6, 1.0 / 6}, 1.0 / 3},
                                           {{1.0 / 6, 2.0 / 3, 1.0 / 6}, 1.0 / 3},
                                           {{1.0 / 6, 1.0 / 6, 2.0 / 3}, 1.0 / 3}}};
  } else {
    constexpr double a = 0.445948490915965, u = 0.223381589678011, b = 0.091576213509771, v = 0.109951743655322;
    return std::array<QuadraturePoint, 6>{{{{1 - 2 * a, a, a}, u},
                                           {{a, 1 - 2 * a, a}, u},
                                           {{a, a, 1 - 2 * a}, u},
                                           {{1 - 2 * b, b, b}, v},
                                           {{b, 1 - 2 * b, b}, v},
                                           {{b, b, 1 - 2 * b}, v}}};
  }
}();

/// Residuals of a triangle's nine equations (momentum in x and y, mass; by vertex) [N/m, N/m, m2/s; times m when
/// axisymmetric]. `x`, `y`: places of the vertices [m]; `u`: the unknowns. Scalar is Real, or a number with
/// derivatives.
template <Geometry kGeometry, Convection kConvection, class Real, class Scalar>
std::array<Scalar, kUnknowns> element_residual_in(const Properties& fluid, const ElementInput<Real>& in,
                                                  const std::array<Scalar, 3>& x, const std::array<Scalar, 3>& y,
                                                  const std::array<Scalar, kUnknowns>& u) {
  const double rho = fluid.density, mu = fluid.viscosity;
  constexpr bool axisymmetric = kGeometry == Geometry::axisymmetric, convects = kConvection == Convection::included;
  // a = v - w, or -w.
  const auto relative = [](const auto& v, const Real& w) {
    if constexpr (convects)
      return std::remove_cvref_t<decltype(v)>(v - w);
    else
      return Real(Real(0.0) - w);
  };

  // The gradients of the three linear functions, the same all over the triangle.
  const Scalar doubled = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  const Scalar inverse = 1 / doubled;
  std::array<Scalar, 3> bx, by;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    bx[i] = (y[j] - y[k]) * inverse;
    by[i] = (x[k] - x[j]) * inverse;
  }
  const auto slope = [&](const std::array<Scalar, 3>& b, const auto& f) {
    return Scalar(b[0] * f(0) + b[1] * f(1) + b[2] * f(2));
  };

  // v = u/phi at the vertices.
  std::array<Scalar, 3> vx, vy;
  for (int i = 0; i < 3; ++i) {
    const Real inverse_porosity = 1 / in.porosity[i];
    vx[i] = u[3 * i] * inverse_porosity;
    vy[i] = u[3 * i + 1] * inverse_porosity;
  }
  const auto at_vertex = [](const auto& values) {
    return [&values](int i) -> const auto& { return values[i]; };
  };
  const auto unknown = [&](int c) { return [&u, c](int i) -> const Scalar& { return u[3 * i + c]; }; };
  const Scalar divergence = slope(bx, unknown(0)) + slope(by, unknown(1));
  const Scalar dvx_dx = slope(bx, at_vertex(vx)), dvx_dy = slope(by, at_vertex(vx)), dvy_dx = slope(bx, at_vertex(vy)),
               dvy_dy = slope(by, at_vertex(vy)), dp_dx = slope(bx, unknown(2)), dp_dy = slope(by, unknown(2)),
               dphi_dx = slope(bx, at_vertex(in.porosity)), dphi_dy = slope(by, at_vertex(in.porosity));

  const Real third = Real(1.0 / 3);
  const auto mean = [&](const std::array<Scalar, 3>& v, int c) {
    Real carried = Real(0.0);
    if constexpr (convects) carried = plain(v[0]) + plain(v[1]) + plain(v[2]);
    return Real(third * (carried - in.mesh_velocity[0][c] - in.mesh_velocity[1][c] - in.mesh_velocity[2][c]));
  };
  const Real ax_mean = mean(vx, 0), ay_mean = mean(vy, 1);
  const Stabilisation<Real> stable = stabilisation<Real>(
      fluid, 0.5 * plain(doubled), third * (in.porosity[0] + in.porosity[1] + in.porosity[2]), in.unsteadiness,
      root(ax_mean * ax_mean + ay_mean * ay_mean), third * (in.drag[0] + in.drag[1] + in.drag[2]));

  std::array<Scalar, kUnknowns> residual;
  residual.fill(0 * doubled);
  for (const QuadraturePoint& point : kQuadrature<kGeometry>) {
    const std::array<double, 3>& N = point.at;
    const auto here = [&](const auto& f) {
      return std::remove_cvref_t<decltype(f(0))>(N[0] * f(0) + N[1] * f(1) + N[2] * f(2));
    };
    const auto component = [](const auto& values, int c) {
      return [&values, c ](int i) -> const auto& { return values[i][c]; };
    };
    const Real phi = here(at_vertex(in.porosity)), beta = here(at_vertex(in.drag));
    const Real mesh_x = here(component(in.mesh_velocity, 0)), mesh_y = here(component(in.mesh_velocity, 1));
    const Scalar ux = here(unknown(0)), uy = here(unknown(1)), p = here(unknown(2)), wx = here(at_vertex(vx)),
                 wy = here(at_vertex(vy));
    const auto ax = relative(wx, mesh_x), ay = relative(wy, mesh_y);
    Scalar volume = (0.5 * point.weight) * doubled;

    // Stress mu phi (grad v + grad v^T), and its divergence as far as linear functions have one.
    const Real viscous = mu * phi;
    const Scalar shear = dvx_dy + dvy_dx;
    const Scalar txx = 2 * viscous * dvx_dx, tyy = 2 * viscous * dvy_dy, txy = viscous * shear;
    Scalar div_x = mu * (2 * dphi_dx * dvx_dx + dphi_dy * shear), div_y = mu * (dphi_dx * shear + 2 * dphi_dy * dvy_dy);
    Scalar continuity = here(at_vertex(in.porosity_rate)) - mesh_x * dphi_dx - mesh_y * dphi_dy + divergence;
    Scalar inverse_r = 0 * doubled, hoop = 0 * doubled;
    if constexpr (axisymmetric) {
      const Scalar r = here(at_vertex(y));
      volume = volume * r;
      inverse_r = 1 / r;
      hoop = 2 * viscous * wy * inverse_r;
      continuity += uy * inverse_r;
      div_x += txy * inverse_r;
      div_y += (tyy - hoop) * inverse_r;
    }

    // The momentum residual R.
    const Real inertia = rho * phi;
    const Scalar past_x = inertia * (in.rate * wx + here(component(in.history, 0)) + ax * dvx_dx + ay * dvx_dy) -
                          here(component(in.source, 0));
    const Scalar past_y = inertia * (in.rate * wy + here(component(in.history, 1)) + ax * dvy_dx + ay * dvy_dy) -
                          here(component(in.source, 1));
    const Scalar slip_x = ux - here(component(in.carried, 0)), slip_y = uy - here(component(in.carried, 1));
    const Scalar Rx = stable.tau * (past_x + beta * slip_x + phi * dp_dx - div_x),
                 Ry = stable.tau * (past_y + beta * slip_y + phi * dp_dy - div_y);

    // The grains' answer, integrated by parts: none of them crosses the boundary.
    const Real kappa = here(at_vertex(in.mobility)), chi = here(at_vertex(in.response));
    const Scalar answer_x = chi * slip_x - kappa * dp_dx, answer_y = chi * slip_y - kappa * dp_dy;

    // phi grad p.w is integrated by parts, as the stress is: -p div(phi w).
    const Scalar body_x = past_x - p * dphi_dx, body_y = past_y - p * dphi_dy;
    const Scalar dilation = stable.lsic * continuity - phi * p, sxx = txx + dilation, syy = tyy + dilation;
    const std::remove_cvref_t<decltype(ax)> along_x = inertia * ax, along_y = inertia * ay;
    for (int i = 0; i < 3; ++i) {
      const Scalar along = along_x * bx[i] + along_y * by[i];
      residual[3 * i] += volume * (N[i] * body_x + sxx * bx[i] + txy * by[i] + along * Rx);
      Scalar radial = N[i] * body_y + txy * bx[i] + syy * by[i] + along * Ry;
      if constexpr (axisymmetric) radial += N[i] * inverse_r * (hoop + dilation);
      residual[3 * i + 1] += volume * radial;
      residual[3 * i + 2] += volume * (N[i] * continuity + phi * (bx[i] * Rx + by[i] * Ry) -
                                       (bx[i] * answer_x + by[i] * answer_y));
    }
  }

  // Drag, lumped: N_i integrated over the triangle.
  for (int i = 0; i < 3; ++i) {
    Scalar weight = (1.0 / 6) * doubled;
    if constexpr (axisymmetric) weight = weight * (0.25 * (y[0] + y[1] + y[2] + y[i]));
    const Scalar lumped = in.drag[i] * weight;
    for (int c = 0; c < 2; ++c) residual[3 * i + c] += lumped * (u[3 * i + c] - in.carried[i][c]);
  }
  return residual;
}

/// Of the fluid's own geometry, with convection or without.
template <class Real, class Scalar>
std::array<Scalar, kUnknowns> element_residual(const Properties& fluid, const ElementInput<Real>& in,
                                               const std::array<Scalar, 3>& x, const std::array<Scalar, 3>& y,
                                               const std::array<Scalar, kUnknowns>& u) {
  const auto in_geometry = [&]<Geometry kGeometry>() {
    return fluid.convection == Convection::included
               ? element_residual_in<kGeometry, Convection::included, Real, Scalar>(fluid, in, x, y, u)
               : element_residual_in<kGeometry, Convection::omitted, Real, Scalar>(fluid, in, x, y, u);
  };
  return fluid.geometry == Geometry::planar ? in_geometry.template operator()<Geometry::planar>()
                                            : in_geometry.template operator()<Geometry::axisymmetric>();
}

}  // namespace seapile::fluid
