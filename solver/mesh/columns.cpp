#include "solver/mesh/columns.h"

#include <algorithm>
#include <stdexcept>

namespace seapile::mesh {

Columns columns_under(const TriangleMesh& mesh, std::span<const std::int32_t> surface, double bottom) {
  std::vector<double> x, height;
  for (const std::int32_t vertex : surface) {
    if (!x.empty() && !(mesh.position[vertex].x > x.back()))
      throw std::logic_error("mesh: a surface whose x does not rise is no graph");
    x.push_back(mesh.position[vertex].x);
    height.push_back(mesh.position[vertex].y);
  }
  Columns columns{bottom, {}};
  for (std::size_t v = 0; v < mesh.vertices(); ++v) {
    const base::Vec2 p = mesh.position[v];
    if (p.x < x.front() || p.x > x.back()) continue;
    const auto above = std::ranges::upper_bound(x, p.x);
    const auto from = std::clamp<std::ptrdiff_t>(above - x.begin() - 1, 0, static_cast<std::ptrdiff_t>(x.size()) - 2);
    const double weight = (p.x - x[from]) / (x[from + 1] - x[from]);
    const double top = (1 - weight) * height[from] + weight * height[from + 1];
    columns.hanging.push_back({static_cast<std::int32_t>(v), static_cast<std::int32_t>(from), weight,
                               p.y == top ? 1.0 : (p.y - bottom) / (top - bottom)});
  }
  return columns;
}

double height_of(const Hanging& hanging, double bottom, std::span<const double> height) {
  const double top = (1 - hanging.weight) * height[hanging.from] + hanging.weight * height[hanging.from + 1];
  return hanging.share == 1 ? top : bottom + hanging.share * (top - bottom);
}

void regularise(TriangleMesh& mesh, const Columns& columns, std::span<const double> height) {
  for (const Hanging& hanging : columns.hanging)
    mesh.position[hanging.vertex].y = height_of(hanging, columns.bottom, height);
}

}  // namespace seapile::mesh
