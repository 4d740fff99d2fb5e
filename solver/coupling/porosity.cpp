#include "solver/coupling/porosity.h"

namespace seapile::coupling {

std::vector<double> vertex_volume(const mesh::TriangleMesh& mesh) {
  std::vector<double> volume(mesh.vertices());
  for (const auto& [a, b, c] : mesh.triangle) {
    const double third = mesh::doubled_area(mesh.position[a], mesh.position[b], mesh.position[c]) / 6;
    for (const auto vertex : {a, b, c}) volume[vertex] += third;
  }
  return volume;
}

Porosity porosity(std::span<const double> solid, std::span<const double> volume, double least) {
  Porosity result;
  result.phi.reserve(solid.size());
  for (std::size_t j = 0; j < solid.size(); ++j) {
    const double phi = 1 - solid[j] / volume[j];
    if (phi < least) result.clipped += solid[j] - (1 - least) * volume[j];
    result.phi.push_back(phi < least ? least : phi);
  }
  return result;
}

}  // namespace seapile::coupling
