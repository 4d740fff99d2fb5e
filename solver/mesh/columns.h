// Vertical regularisation: vertices keep their share of the height under a surface that moves up and down.
//
//   y = bottom + alpha (h(x) - bottom),   alpha = (y0 - bottom)/(h0(x) - bottom)      thesis (4.6)
//
// h is linear between the surface's vertices. Exact on the surface and at the bottom; a mesh stays valid as long as h
// stays above the bottom and the surface's slope does not shear a triangle over.
#pragma once

#include <span>

#include "solver/mesh/triangle_mesh.h"

namespace seapile::mesh {

/// Where a vertex hangs: y = bottom + share ((1 - weight) h[from] + weight h[from + 1] - bottom).
struct Hanging {
  std::int32_t vertex = 0;
  std::int32_t from = 0;  ///< index into the surface's vertices
  double weight = 0;      ///< of the next one [-]
  double share = 0;       ///< alpha [-]
};

struct Columns {
  double bottom = 0;             ///< [m]
  std::vector<Hanging> hanging;  ///< by rising vertex; vertices that are not under the surface are not in it
};

/// The vertices below the surface whose vertices are `surface`, by rising x. Throws std::logic_error when x does not
/// rise.
Columns columns_under(const TriangleMesh& mesh, std::span<const std::int32_t> surface, double bottom);

/// Height of the vertex for surface heights `height` [m].
double height_of(const Hanging& hanging, double bottom, std::span<const double> height);

/// Moves the vertices under the surface.
void regularise(TriangleMesh& mesh, const Columns& columns, std::span<const double> height);

}  // namespace seapile::mesh
