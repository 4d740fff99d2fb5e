// Whether triangles turn over on their way from one place to another.
//
//   2 A(s) = (b - a) x (c - a),   a(s) = a_0 + s (a_1 - a_0), b and c likewise
//
// is quadratic in s, linear when all vertices move upright; the triangle is valid when it is positive on all of [0, 1].
// A triangle whose end is valid may have been turned over on its way and back.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "solver/mesh/triangle_mesh.h"

namespace seapile::mesh {

struct Inversion {
  std::int32_t triangle = 0;
  double at = 0;  ///< share of the way at which its area is zero for the first time [-]
};

/// The first triangle that turns over when the vertices go in straight lines from `from` to `to`; of those at the same
/// share of the way the one with the lowest number. Absent: all stay valid. A place that is not finite is an inversion
/// at 0.
std::optional<Inversion> first_inversion(const TriangleMesh& mesh, std::span<const base::Vec2> from,
                                         std::span<const base::Vec2> to);

}  // namespace seapile::mesh
