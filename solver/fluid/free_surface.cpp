#include "solver/fluid/free_surface.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/fluid/boundary_terms.h"
#include "solver/fluid/dual.h"

namespace seapile::fluid {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Slopes of 84 degrees: a surface that gets there is about to overturn.
constexpr double kSteepest = 10;

/// sum_j <tau_i tau_j> f_j = right, consistent mass matrix of linear functions over x.
std::vector<double> projected(const FreeSurface& surface, std::span<const double> right) {
  const std::vector<double>& x = surface.x;
  const auto count = static_cast<Eigen::Index>(x.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i + 1 < count; ++i) {
    if (surface.gap == static_cast<std::size_t>(i)) continue;
    const double dx = x[i + 1] - x[i];
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) entries.emplace_back(i + a, i + b, a == b ? dx / 3 : dx / 6);
  }
  Matrix mass(count, count);
  mass.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Matrix> factor(mass);
  const Eigen::VectorXd f = factor.solve(Eigen::Map<const Eigen::VectorXd>(right.data(), count));
  return {f.begin(), f.end()};
}

/// The upwinded weak form, implicit: a linear system for the new heights.
std::vector<double> upwinded(const FreeSurface& surface, std::span<const SurfaceLevel> past, double dt, double lift,
                             std::span<const base::Vec2> now) {
  const std::size_t count = surface.vertex.size();
  const bool second = past.size() >= 2;
  const double rate = (second ? 1.5 : 1) / dt;
  // Newest heights, as the scheme weighs them, and velocities at the new time.
  std::vector<double> before(count);
  std::vector<base::Vec2> v(count);
  for (std::size_t s = 0; s < count; ++s) {
    const std::int32_t vertex = surface.vertex[s];
    before[s] = second ? (4 * past[0].height[s] - past[1].height[s]) / 3 : past[0].height[s];
    if (!now.empty())
      v[s] = now[vertex];
    else
      v[s] = second ? 2 * past[0].interstitial[vertex] - past[1].interstitial[vertex] : past[0].interstitial[vertex];
    v[s].y += lift;
  }

  // The residual is linear in h: what it is at `before`, and its derivatives, are the system of the rise from there.
  using D = Dual<2>;
  const auto size = static_cast<Eigen::Index>(count);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  for (std::size_t s = 0; s + 1 < count; ++s) {
    if (surface.gap == s) continue;
    const auto end = [&](std::size_t at, int index) {
      return EdgeEnd<D>{constant<2>(surface.x[at]), variable<2>(before[at], index), constant<2>(v[at].x),
                        constant<2>(v[at].y)};
    };
    const auto residual =
        kinematic_residual<D>({end(s, 0), end(s + 1, 1)}, {rate, rate}, {before[s], before[s + 1]}, surface.upwinding);
    for (int i = 0; i < 2; ++i) {
      const auto row = static_cast<Eigen::Index>(s) + i;
      if (row == 0 && surface.pinned) continue;
      right[row] -= residual[i].value();
      for (int j = 0; j < 2; ++j)
        entries.emplace_back(row, static_cast<Eigen::Index>(s) + j, residual[i].derivatives()[j]);
    }
  }
  if (surface.pinned) {
    entries.emplace_back(0, 0, 1.0);
    right[0] = past[0].height[0] - before[0];
  }
  Matrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Matrix> factor(matrix);
  // With factors that are none, of velocities that are no numbers, nothing may be solved.
  if (factor.info() != Eigen::Success) return std::vector<double>(count, std::numeric_limits<double>::quiet_NaN());
  const Eigen::VectorXd rise = factor.solve(right);
  std::vector<double> height(count);
  for (std::size_t s = 0; s < count; ++s) height[s] = before[s] + rise[static_cast<Eigen::Index>(s)];
  if (surface.pinned) height[0] = past[0].height[0];
  return height;
}

/// Explicit Euler with plain Galerkin: <tau_i tau_j> (dh/dt)_j = -<tau_i (v_x h' - v_y)>.
std::vector<double> galerkin(const FreeSurface& surface, const SurfaceLevel& past, double dt, double lift) {
  const std::size_t count = surface.vertex.size();
  std::vector<double> right(count, 0);
  for (std::size_t s = 0; s + 1 < count; ++s) {
    if (surface.gap == s) continue;
    const base::Vec2 a = past.interstitial[surface.vertex[s]], b = past.interstitial[surface.vertex[s + 1]];
    const auto residual =
        kinematic_residual<double>({EdgeEnd<double>{surface.x[s], past.height[s], a.x, a.y + lift},
                                    EdgeEnd<double>{surface.x[s + 1], past.height[s + 1], b.x, b.y + lift}},
                                   {0, 0}, {0, 0}, 0);
    for (int i = 0; i < 2; ++i) right[s + i] -= residual[i];
  }
  const std::vector<double> rate = projected(surface, right);
  std::vector<double> height = past.height;
  for (std::size_t s = surface.pinned ? 1 : 0; s < count; ++s) height[s] += dt * rate[s];
  return height;
}

/// Explicit Euler with differences from the left (3.18). As printed, its first and last vertices follow v of the vertex
/// to the left; the first one has none, and stays when it is pinned or follows its own.
std::vector<double> differences(const FreeSurface& surface, const SurfaceLevel& past, double dt, double lift) {
  const std::size_t count = surface.vertex.size();
  std::vector<double> height = past.height;
  for (std::size_t s = surface.pinned ? 1 : 0; s < count; ++s) {
    const bool first = s == 0 || surface.gap == s - 1, last = s + 1 == count || surface.gap == s;
    const base::Vec2 v = past.interstitial[surface.vertex[first ? s : s - 1]];
    const bool inner = !first && !last;
    const double slope = inner ? (past.height[s] - past.height[s - 1]) / (surface.x[s] - surface.x[s - 1]) : 0;
    height[s] += dt * (v.y + lift - v.x * slope);
  }
  return height;
}

}  // namespace

FreeSurface surface_along(const mesh::TriangleMesh& mesh, std::int32_t tag, double bottom) {
  FreeSurface surface;
  surface.vertex = mesh::chain(mesh, tag);
  std::ranges::reverse(surface.vertex);  // the fluid lies below: its edges run to the left
  for (const std::int32_t v : surface.vertex) {
    surface.x.push_back(mesh.position[v].x);
    surface.height.push_back(mesh.position[v].y);
  }
  surface.columns = mesh::columns_under(mesh, surface.vertex, bottom);
  return surface;
}

double width_of(const FreeSurface& surface) {
  const double all = surface.x.back() - surface.x.front();
  return surface.gap ? all - (surface.x[*surface.gap + 1] - surface.x[*surface.gap]) : all;
}

std::vector<double> advanced_height(const FreeSurface& surface, std::span<const SurfaceLevel> past, double dt,
                                    double lift, std::span<const base::Vec2> now) {
  switch (surface.scheme) {
    case KinematicScheme::galerkin:
      return galerkin(surface, past[0], dt, lift);
    case KinematicScheme::differences:
      return differences(surface, past[0], dt, lift);
    case KinematicScheme::upwinded:
      break;
  }
  return upwinded(surface, past, dt, lift, now);
}

double flux_through(const FreeSurface& surface, Geometry geometry, std::span<const base::Vec2> interstitial) {
  double flux = 0;
  for (std::size_t s = 0; s + 1 < surface.vertex.size(); ++s) {
    if (surface.gap == s) continue;
    const base::Vec2 a = interstitial[surface.vertex[s]], b = interstitial[surface.vertex[s + 1]];
    const double dx = surface.x[s + 1] - surface.x[s], dh = surface.height[s + 1] - surface.height[s];
    for (const double at : kGauss) {
      const base::Vec2 v = (1 - at) * a + at * b;
      const double r =
          geometry == Geometry::axisymmetric ? (1 - at) * surface.height[s] + at * surface.height[s + 1] : 1;
      flux += 0.5 * r * (v.y * dx - v.x * dh);
    }
  }
  return flux;
}

std::vector<double> curvature(const FreeSurface& surface, Geometry geometry) {
  const std::size_t count = surface.x.size();
  // sin of the angle of slope, on the edges; kappa is its derivative.
  std::vector<double> right(count, 0), sine(count - 1), cosine(count - 1);
  for (std::size_t s = 0; s + 1 < count; ++s) {
    if (surface.gap == s) continue;
    const double dx = surface.x[s + 1] - surface.x[s], dh = surface.height[s + 1] - surface.height[s],
                 length = std::hypot(dx, dh);
    sine[s] = dh / length;
    cosine[s] = dx / length;
    right[s] += sine[s];
    right[s + 1] -= sine[s];
  }
  if (!surface.right_angles) {
    right[0] -= sine.front();
    right[count - 1] += sine.back();
  }
  std::vector<double> kappa = projected(surface, right);
  if (geometry == Geometry::planar) return kappa;
  for (std::size_t s = 0; s < count; ++s) {
    const double left = cosine[s == 0 ? 0 : s - 1], of_right = cosine[s + 1 == count ? s - 1 : s];
    kappa[s] -= 0.5 * (left + of_right) / surface.height[s];
  }
  return kappa;
}

double largest_leak(const FreeSurface& surface, std::span<const base::Vec2> interstitial, double from) {
  double largest = 0;
  for (std::size_t s = 0; s + 1 < surface.vertex.size(); ++s) {
    if (surface.gap == s) continue;
    if (surface.x[s] < from) continue;
    const base::Vec2 v = 0.5 * (interstitial[surface.vertex[s]] + interstitial[surface.vertex[s + 1]]);
    const double dx = surface.x[s + 1] - surface.x[s], dh = surface.height[s + 1] - surface.height[s];
    largest = std::max(largest, std::abs(v.y * dx - v.x * dh) / std::hypot(dx, dh));
  }
  return largest;
}

base::Objection objection(const FreeSurface& surface) {
  using base::Cause;
  for (std::size_t s = 0; s < surface.height.size(); ++s) {
    const std::string place = " at x = " + std::to_string(surface.x[s]);
    if (!std::isfinite(surface.height[s])) return {Cause::not_finite, "the surface's height is not finite" + place};
    if (!(surface.height[s] > surface.columns.bottom))
      return {Cause::mesh, "the surface has come down to the bottom" + place};
    if (s > 0 && surface.gap != s - 1 &&
        std::abs(surface.height[s] - surface.height[s - 1]) > kSteepest * (surface.x[s] - surface.x[s - 1]))
      return {Cause::mesh, "the surface is too steep to be a graph" + place};
  }
  return {};
}

}  // namespace seapile::fluid
