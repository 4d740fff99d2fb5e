#include "solver/basin/surface_flux.h"

#include <algorithm>

#include "solver/fluid/boundary_terms.h"

namespace seapile::basin {

std::vector<Under> under(const mesh::TriangleMesh& mesh, std::span<const double> x) {
  std::vector<Under> result;
  for (const base::Vec2& p : mesh.position) {
    const auto above = std::ranges::upper_bound(x, p.x) - x.begin();
    const auto from = std::clamp<std::ptrdiff_t>(above - 1, 0, static_cast<std::ptrdiff_t>(x.size()) - 2);
    result.push_back({static_cast<std::int32_t>(from), (p.x - x[from]) / (x[from + 1] - x[from])});
  }
  return result;
}

std::vector<double> handed_up(std::span<const Under> under, std::span<const double> defect,
                              std::size_t surface_vertices) {
  std::vector<double> sum(surface_vertices, 0);
  for (std::size_t v = 0; v < under.size(); ++v) {
    const double second = under[v].weight * defect[v];
    sum[under[v].from] += defect[v] - second;
    sum[under[v].from + 1] += second;
  }
  return sum;
}

std::vector<double> kinematic_flux(const fluid::FreeSurface& surface, std::span<const base::Vec2> velocity) {
  std::vector<double> flux(surface.x.size(), 0);
  for (std::size_t s = 0; s + 1 < surface.x.size(); ++s) {
    if (surface.gap == s) continue;
    const base::Vec2 a = velocity[surface.vertex[s]], b = velocity[surface.vertex[s + 1]];
    const double dx = surface.x[s + 1] - surface.x[s], dh = surface.height[s + 1] - surface.height[s];
    for (const double at : fluid::kGauss) {
      const base::Vec2 v = (1 - at) * a + at * b;
      const double through = 0.5 * (v.y * dx - v.x * dh);
      flux[s] += (1 - at) * through;
      flux[s + 1] += at * through;
    }
  }
  return flux;
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
