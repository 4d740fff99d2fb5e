// Unstructured meshes of a basin, mirror images of themselves in x = 0, whose surface has given vertices.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "solver/mesh/generate.h"
#include "solver/mesh/triangle_mesh.h"

namespace seapile::mesh {

/// Tags of a basin's boundary.
enum BasinSide : std::int32_t {
  kBasinBottom = 0,
  kBasinRight = 1,
  kBasinTop = 2,
  kBasinLeft = 3,
  kPileTip = 4,     ///< the faces that look down
  kPileSleeve = 5,  ///< both vertical sides
};

/// The outline's right half.
struct BasinOutline {
  double width = 1;  ///< [m]
  std::vector<base::Vec2>
      top;  ///< the surface's vertices, by rising x, from x = 0 or from the pile's side to width/2 [m]
  std::vector<base::Vec2> pile;  ///< the tip from x = 0 to the shoulder, by rising x; empty: no pile [m]
};

/// The mesh of the whole basin, with bottom y = 0. Edges of the top are exactly those between the given vertices; tip
/// and walls are divided as `size` says (asked for x >= 0), which is made to fit narrow gaps and the top's edges. Every
/// shape quality is at least `least_shape`: sizes and algorithm are varied, in a fixed order, until it is so. Throws
/// NoMesh when no attempt does it, as where a sleeve is shorter than about 0.4 of the top's edge beside it, NoAnswer at
/// the first that Gmsh does not answer within `patience` [s], and std::logic_error when the outline is none.
TriangleMesh basin_mesh(const BasinOutline& outline, const std::function<double(base::Vec2)>& size,
                        double least_shape = 0.7, double patience = Method{}.patience);

}  // namespace seapile::mesh
