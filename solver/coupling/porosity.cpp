#include "solver/coupling/porosity.h"

#include <algorithm>

namespace seapile::coupling {

std::vector<double> vertex_volume(const mesh::TriangleMesh& mesh) {
  return vertex_volume(mesh.triangle, mesh.position);
}

std::vector<double> vertex_volume(std::span<const std::array<std::int32_t, 3>> triangle,
                                  std::span<const base::Vec2> position) {
  std::vector<double> volume(position.size());
  for (const auto& [a, b, c] : triangle) {
    const double third = mesh::doubled_area(position[a], position[b], position[c]) / 6;
    for (const auto vertex : {a, b, c}) volume[vertex] += third;
  }
  return volume;
}

Porosity porosity(std::span<const double> solid, std::span<const double> volume, double least) {
  Porosity result;
  result.phi.reserve(solid.size());
  for (std::size_t j = 0; j < solid.size(); ++j) {
    const double phi = 1 - solid[j] / volume[j], room = (1 - least) * volume[j];
    const bool cut = phi < least;
    if (cut) result.clipped += solid[j] - room;
    result.phi.push_back(cut ? least : phi);
    result.kept.push_back(cut ? room / solid[j] : 1);
    result.lowest = std::min(result.lowest, phi);
  }
  return result;
}

}  // namespace seapile::coupling
