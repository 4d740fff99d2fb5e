// How a mesh follows a surface that moves up and down and a pile in the middle that does the same. All displacements
// are vertical and linear in those of the boundary: dy = sum of weights times displacements, from the places that the
// mesh had when it was made.
//
//   vertical   dy is linear over the height, between the bottom and what is above a vertex, thesis (4.6): the tip
//              under the pile, the surface beside it. It jumps at the pile's sides below the shoulders.
//   zones      dy = alpha FS + (1 - alpha) Pile, alpha = max(a, b), thesis, algorithm A
//              a = 1 beyond x_2, |x - x_1|/(x_2 - x_1) nearer, 0 under the pile;
//              b = |y - y_1|/(y_2 - y_1) below the tip's lowest point, else 0;
//              x_1 the pile's side, x_2 the end of its reach, y_1 the tip, y_2 the bottom; FS is (4.6), with the
//              surface drawn straight across the pile
//   elliptic   div(k grad dy) = 0, thesis (4.2), dy given on surface, bottom and pile, free along the walls;
//              k = (mean area/area)^stiffening
//
// On the pile's sides vertices slide: they keep their share of the height between the shoulder and the surface. "Pile"
// of the zones is what its side does at the vertex's height: the pile's displacement up to the shoulder, and above it
// linear from there to the surface over the vertex; otherwise vertices near the pile would cross the surface.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "solver/mesh/triangle_mesh.h"

namespace seapile::mesh {

/// What of the mesh moves, by vertices.
struct MovingBoundary {
  std::vector<std::int32_t> surface;  ///< by rising x; the pile is a gap between two of them, (surface vertices)
  std::vector<std::int32_t> tip;  ///< move with the pile: its tip from shoulder to shoulder by rising x; empty: no pile
  double bottom = 0;              ///< height of what stays [m]
};

struct Vertical {};
struct Zones {
  double reach = 1;  ///< x_2 - x_1 [m]
};
struct Elliptic {
  double stiffening = 0;  ///< [-]
};
using MotionKind = std::variant<Vertical, Zones, Elliptic>;

/// Displacements of all vertices from those of the boundary.
class MeshMotion {
 public:
  /// `mesh`: at its reference places. Throws std::logic_error when the boundary is none: x of surface or tip does not
  /// rise, or two neighbours in the surface do not stand over the tip's ends, at equal x.
  MeshMotion(const TriangleMesh& mesh, MovingBoundary boundary, const MotionKind& kind);

  /// dy of every vertex [m] for those of the surface's vertices and of the pile. Exact on surface, tip and bottom.
  std::vector<double> displacements(std::span<const double> surface, double pile) const;

  const MovingBoundary& boundary() const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace seapile::mesh
