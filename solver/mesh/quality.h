// How good triangles are: their shape and their smallest angle, and when a mesh is worth replacing.
//
//   q = 4 sqrt(3) A/(l_1^2 + l_2^2 + l_3^2)      1 for equal edges, 0 for a flat triangle; Bhatia, Lawrence 1990,
//   thesis 4.3
#pragma once

#include <numbers>
#include <vector>

#include "solver/mesh/triangle_mesh.h"

namespace seapile::mesh {

/// Of each triangle. One that turns clockwise has both below 0, one that is flat or has a vertex at no finite place 0.
struct Quality {
  std::vector<double> shape;           ///< q [-], (triangles)
  std::vector<double> smallest_angle;  ///< [rad], (triangles)
};

Quality quality_of(const TriangleMesh& mesh);

struct QualitySummary {
  double lowest_shape = 1;                       ///< [-]
  double smallest_angle = std::numbers::pi / 3;  ///< [rad]
  double below_half = 0;                         ///< share of the triangles with q < 0.5 [-]
  double small_angles = 0;                       ///< share of the triangles with an angle below 30 degrees [-]
};

QualitySummary summary_of(const Quality& quality);

/// When a new mesh is asked for: too many small angles (thesis 4.3: 5 % below 30 degrees), or one shape too bad.
struct RemeshRule {
  double angle = std::numbers::pi / 6;  ///< an angle below this is small [rad]
  double share = 0.05;                  ///< of triangles with a small angle from which a new mesh is asked for [-]
  double shape = 0.3;                   ///< q below which one triangle is enough [-]
};

bool asks_for_new_mesh(const RemeshRule& rule, const Quality& quality);

/// The same of a mesh, in each step of the fluid, for rules with an angle below a right one: the sine of the difference
/// says which of two angles is smaller, and no arc tangent is taken.
bool asks_for_new_mesh(const RemeshRule& rule, const TriangleMesh& mesh);

}  // namespace seapile::mesh
