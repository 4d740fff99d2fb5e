#include "solver/basin/section_flux.h"

#include <algorithm>
#include <stdexcept>

namespace seapile::basin {
namespace {

/// Twice the integrals of the three barycentric coordinates over the part of a triangle with first <= x <= last, by
/// twice its area. `x`: of its corners.
std::array<double, 3> share_between(const std::array<double, 3>& x, double first, double last) {
  // The part as a polygon in barycentric coordinates, cut by two verticals.
  using Point = std::array<double, 3>;
  std::vector<Point> polygon{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto at = [&](const Point& p) { return p[0] * x[0] + p[1] * x[1] + p[2] * x[2]; };
  const auto cut = [&](double bound, double sense) {
    std::vector<Point> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double da = sense * (at(a) - bound), db = sense * (at(b) - bound);
      if (da >= 0) kept.push_back(a);
      if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
        const double t = da / (da - db);
        kept.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
      }
    }
    polygon = kept;
  };
  cut(first, 1);
  cut(last, -1);
  std::array<double, 3> integral{};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Point &a = polygon[0], &b = polygon[i], &c = polygon[i + 1];
    // Area of abc by that of the triangle, in the coordinates (1, 2).
    const double area = (b[1] - a[1]) * (c[2] - a[2]) - (c[1] - a[1]) * (b[2] - a[2]);
    for (int k = 0; k < 3; ++k) integral[k] += area * (a[k] + b[k] + c[k]) / 6;
  }
  return integral;
}

}  // namespace

SectionFlux section_flux(const mesh::TriangleMesh& mesh, std::span<const double> x) {
  SectionFlux flux{{}, {x.begin(), x.end()}};
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    std::array<double, 3> corner{};
    for (int k = 0; k < 3; ++k) corner[k] = mesh.position[mesh.triangle[t][k]].x;
    const auto [low, high] = std::ranges::minmax(corner);
    if (low < x.front() || high > x.back()) throw std::logic_error("basin: a triangle reaches beyond the surface");
    const auto first = std::max<std::ptrdiff_t>(std::ranges::upper_bound(x, low) - x.begin() - 1, 0);
    for (std::size_t s = static_cast<std::size_t>(first); s + 1 < x.size() && x[s] < high; ++s) {
      const std::array<double, 3> weight = share_between(corner, x[s], x[s + 1]);
      if (weight[0] + weight[1] + weight[2] > 0)
        flux.part.push_back({static_cast<std::int32_t>(t), static_cast<std::int32_t>(s), weight});
    }
  }
  return flux;
}

std::vector<double> fluxes(const SectionFlux& flux, const mesh::TriangleMesh& mesh, std::span<const double> unknown) {
  std::vector<double> strip(flux.x.size() - 1, 0);
  for (const StripPart& part : flux.part) {
    const auto& t = mesh.triangle[part.triangle];
    const double doubled = mesh::doubled_area(mesh.position[t[0]], mesh.position[t[1]], mesh.position[t[2]]);
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += part.weight[k] * unknown[3 * t[k] + fluid::kVelocityX];
    strip[part.strip] += doubled * sum;
  }
  std::vector<double> result(flux.x.size(), 0);
  for (std::size_t s = 0; s < strip.size(); ++s) {
    const double through = strip[s] / (flux.x[s + 1] - flux.x[s]);
    result[s] -= through;
    result[s + 1] += through;
  }
  return result;
}

std::vector<double> risen(const fluid::FreeSurface& surface, std::span<const double> flux, double rate,
                          std::span<const double> before) {
  // A tridiagonal system with the mass matrix of linear functions, by Thomas' algorithm.
  const std::size_t count = surface.x.size();
  std::vector<double> lower(count, 0), middle(count, 0), upper(count, 0), h(flux.begin(), flux.end());
  for (std::size_t s = 0; s + 1 < count; ++s) {
    if (surface.gap == s) continue;
    const double dx = surface.x[s + 1] - surface.x[s];
    middle[s] += dx / 3;
    middle[s + 1] += dx / 3;
    upper[s] = lower[s + 1] = dx / 6;
  }
  for (std::size_t s = 1; s < count; ++s) {
    const double factor = lower[s] / middle[s - 1];
    middle[s] -= factor * upper[s - 1];
    h[s] -= factor * h[s - 1];
  }
  for (std::size_t s = count; s-- > 0;) {
    const double above = s + 1 < count ? upper[s] * h[s + 1] : 0;
    h[s] = (h[s] - above) / middle[s];
  }
  for (std::size_t s = 0; s < count; ++s) h[s] = before[s] + h[s] / rate;
  return h;
}

}  // namespace seapile::basin
