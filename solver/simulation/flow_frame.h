#pragma once

#include <vector>

#include "solver/simulation/array.h"

namespace seapile::simulation {

/// The water at one time: a mesh, what its vertices hold, and the free surface. Vertex arrays have one row per vertex, triangle
/// arrays one per triangle, surface arrays one per vertex of the surface, from the left to the right. There is a triangle, and
/// rows of vertices are std::int64_t.
struct FlowFrame {
  double time = 0;  ///< [s]

  /// "vertices/position" (2), "vertices/velocity" (2, superficial), "vertices/pressure", "vertices/porosity",
  /// "vertices/mesh_velocity" (2)
  std::vector<Array> vertices;
  /// "triangles/corner" (3: rows of its vertices, counterclockwise)
  std::vector<Array> triangles;
  /// "surface/vertex" (row of the vertex), "surface/x", "surface/height", "surface/curvature", "surface/normal_velocity"; empty
  /// without a free surface
  std::vector<Array> surface;
};

}  // namespace seapile::simulation
