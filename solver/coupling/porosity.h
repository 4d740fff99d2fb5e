// The share of the water at a vertex, from the grains' deposit there.
//
//   phi_j = max(least, 1 - S_j/m_j),   m_j = int N_j
//
// The porosity of the plane. A vertex whose hat is smaller than a grain may be filled to the brim, and the fluid's
// equations divide by phi: below `least` it is cut, and what is cut is told.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/mesh/triangle_mesh.h"

namespace seapile::coupling {

/// m_j = int N_j [m2], (vertices); of the mesh, or of its triangles with the vertices at other places.
std::vector<double> vertex_volume(const mesh::TriangleMesh& mesh);
std::vector<double> vertex_volume(std::span<const std::array<std::int32_t, 3>> triangle,
                                  std::span<const base::Vec2> position);

struct Porosity {
  std::vector<double> phi;   ///< [-], (vertices)
  std::vector<double> kept;  ///< share of the solid that phi stands for; 1 where nothing is cut, (vertices)
  double lowest = 1;         ///< before it is cut [-]
  double clipped = 0;        ///< solid that `least` leaves no room for [m2]
};

Porosity porosity(std::span<const double> solid, std::span<const double> volume, double least);

}  // namespace seapile::coupling
