// Unstructured meshes of polygons by Gmsh, graded by a size that is given as a function of place.
#pragma once

#include <functional>
#include <span>
#include <stdexcept>
#include <string>

#include "solver/mesh/triangle_mesh.h"

namespace seapile::mesh {

/// A corner of the polygon and the tag of the side that leaves it.
struct Corner {
  base::Vec2 position;    ///< [m]
  std::int32_t side = 0;  ///< tag of the edges from here to the next corner
  bool whole = false;     ///< the side is one edge, whatever its length
};

/// How Gmsh goes about it.
struct Method {
  int algorithm = 6;  ///< 6: Frontal-Delaunay, repeatable, and better shaped than 5: Delaunay
  int smoothing = 5;  ///< passes
  int seed = 1;       ///< of its random numbers; the second try has the next
  double patience = 120;  ///< for one try, far more than any mesh takes [s]
};

/// Gmsh could not mesh a domain.
struct NoMesh : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Not within its time: whoever tries several ways need not wait for the others.
struct NoAnswer : NoMesh {
  using NoMesh::NoMesh;
};

/// Triangulates the polygon (counterclockwise, without holes) with edges of about size(x) [m]. The same polygon and
/// sizes give the same mesh, bit for bit, on one installation of Gmsh. Gmsh runs in a child process (in_child.h), in
/// which `size` is called too: what that leaves in memory is lost. Where Gmsh crashes, gives no mesh or one that
/// check() refuses, it is tried once more with another seed. Throws NoMesh that says what went wrong, NoAnswer when
/// there was none in time, and std::system_error when there is no child to be had.
TriangleMesh generate(std::span<const Corner> polygon, const std::function<double(base::Vec2)>& size,
                      const Method& method = {});

}  // namespace seapile::mesh
