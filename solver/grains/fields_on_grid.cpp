#include "solver/grains/fields_on_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/grains/packing.h"

namespace seapile::grains {
namespace {

/// Cells whose index along one axis lies between two places.
struct Reach {
  int first, last;
};
Reach cells_between(double from, double to, double origin, double spacing, int count) {
  return {std::clamp(static_cast<int>(std::floor((from - origin) / spacing)), 0, count),
          std::clamp(static_cast<int>(std::floor((to - origin) / spacing)) + 1, 0, count)};
}

}  // namespace

PrincipalStress principal(const Stress& s) {
  const double mean = 0.5 * (s.xx + s.yy), half = 0.5 * (s.xx - s.yy), radius = std::sqrt(half * half + s.xy * s.xy);
  const double angle = radius > 0 ? 0.5 * std::atan2(s.xy, half) : 0.0;
  return {mean + radius, mean - radius, angle <= -std::numbers::pi / 2 ? std::numbers::pi / 2 : angle};
}

std::vector<Stress> stress_on_grid(std::span<const ContactForce> contacts, std::span<const Disc> discs, const Box& box,
                                   const Grid& grid) {
  std::vector<Stress> sum(static_cast<std::size_t>(grid.nx) * grid.ny);
  for (const ContactForce& c : contacts) {
    const Disc& a = discs[c.first];
    const double lx = (c.second >= 0 ? discs[c.second].x : c.x) - a.x, ly = (c.second >= 0 ? discs[c.second].y : c.y) - a.y;
    const double fx = c.normal * c.nx - c.tangential * c.ny, fy = c.normal * c.ny + c.tangential * c.nx;
    const Reach across = cells_between(c.x - kStressRadius - grid.spacing / 2, c.x + kStressRadius, grid.x0, grid.spacing, grid.nx);
    const Reach up = cells_between(c.y - kStressRadius - grid.spacing / 2, c.y + kStressRadius, grid.y0, grid.spacing, grid.ny);
    for (int iy = up.first; iy < up.last; ++iy)
      for (int ix = across.first; ix < across.last; ++ix) {
        const double dx = grid.x0 + (ix + 0.5) * grid.spacing - c.x, dy = grid.y0 + (iy + 0.5) * grid.spacing - c.y;
        if (dx * dx + dy * dy > kStressRadius * kStressRadius) continue;
        Stress& s = sum[static_cast<std::size_t>(iy) * grid.nx + ix];
        s.xx += fx * lx;
        s.yy += fy * ly;
        s.xy += 0.5 * (fx * ly + fy * lx);
      }
  }
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double x = grid.x0 + (ix + 0.5) * grid.spacing, y = grid.y0 + (iy + 0.5) * grid.spacing;
      const double area = disc_area_in_rectangle(kStressRadius, box.left - x, box.right - x, box.base - y, 2 * kStressRadius);
      Stress& s = sum[static_cast<std::size_t>(iy) * grid.nx + ix];
      if (area > 0) s = {s.xx / area, s.yy / area, s.xy / area};
    }
  return sum;
}

std::vector<double> porosity_on_grid(std::span<const Disc> discs, const Grid& grid) {
  std::vector<double> porosity(static_cast<std::size_t>(grid.nx) * grid.ny, 1.0);
  const double cell = grid.spacing * grid.spacing;
  for (const Disc& d : discs) {
    const Reach across = cells_between(d.x - d.radius, d.x + d.radius, grid.x0, grid.spacing, grid.nx);
    const Reach up = cells_between(d.y - d.radius, d.y + d.radius, grid.y0, grid.spacing, grid.ny);
    for (int iy = up.first; iy < up.last; ++iy)
      for (int ix = across.first; ix < across.last; ++ix) {
        const double x = grid.x0 + ix * grid.spacing - d.x, y = grid.y0 + iy * grid.spacing - d.y;
        porosity[static_cast<std::size_t>(iy) * grid.nx + ix] -=
            disc_area_in_rectangle(d.radius, x, x + grid.spacing, y, y + grid.spacing) / cell;
      }
  }
  return porosity;
}

}  // namespace seapile::grains
