#include "solver/coupling/moved_solid.h"

#include "solver/coupling/disc_in_triangle.h"

namespace seapile::coupling {

using base::Vec2;

std::vector<double> moved_solid(const mesh::TriangleMesh& mesh, std::span<const double> vertex_volume,
                                const Deposit& deposit, std::span<const double> solid,
                                std::span<const grains::Disc> from, std::span<const grains::Disc> to) {
  std::vector<Vec2> flux(mesh.vertices());
  for (std::size_t i = 0; i < to.size(); ++i) {
    const Vec2 way = {to[i].x - from[i].x, to[i].y - from[i].y};
    for (std::int32_t k = deposit.first[i]; k < deposit.first[i + 1]; ++k) {
      Vec2& sum = flux[deposit.vertex[k]];
      sum = sum + deposit.volume[k] * way;
    }
  }
  for (std::size_t v = 0; v < flux.size(); ++v) flux[v] = (1 / vertex_volume[v]) * flux[v];

  std::vector<double> moved(solid.begin(), solid.end());
  for (const auto& [i, j, k] : mesh.triangle) {
    const Vec2 a = mesh.position[i], b = mesh.position[j], c = mesh.position[k];
    // Its mean over the triangle; the area times grad N is half the edge opposite to the corner, turned.
    const Vec2 half = (1.0 / 6) * (flux[i] + flux[j] + flux[k]);
    moved[i] += cross(c - b, half);
    moved[j] += cross(a - c, half);
    moved[k] += cross(b - a, half);
  }
  return moved;
}

}  // namespace seapile::coupling
