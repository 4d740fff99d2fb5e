// The share of the water at a vertex, from the grains' deposit there.
//
//   phi_j = max(least, 1 - S_j/m_j),   m_j = int N_j
//
// The porosity of the plane. A vertex whose hat is smaller than a grain may be filled to the brim, and the fluid's
// equations divide by phi: below `least` it is cut, and what is cut is told.
#pragma once

#include <span>
#include <vector>

#include "solver/mesh/triangle_mesh.h"

namespace seapile::coupling {

/// m_j = int N_j [m2], (vertices).
std::vector<double> vertex_volume(const mesh::TriangleMesh& mesh);

struct Porosity {
  std::vector<double> phi;  ///< [-], (vertices)
  double clipped = 0;       ///< solid that `least` leaves no room for [m2]
};

Porosity porosity(std::span<const double> solid, std::span<const double> volume, double least);

}  // namespace seapile::coupling
