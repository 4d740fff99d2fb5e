// Triangles over the fluid's domain, with tagged edges along its boundary.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "solver/base/vec2.h"

namespace seapile::mesh {

/// An edge of the boundary; the domain lies to its left.
struct BoundaryEdge {
  std::int32_t from = 0, to = 0;  ///< vertices
  std::int32_t triangle = 0;      ///< the one that it belongs to
  std::int32_t tag = 0;           ///< what it is part of, as the scene numbers it
};

/// A conforming triangulation. Invariant after check(): every triangle turns counterclockwise, every vertex is used,
/// and the edges of one triangle only are exactly `boundary`, in closed loops.
struct TriangleMesh {
  std::vector<base::Vec2> position;                   ///< x [m], (vertices)
  std::vector<std::array<std::int32_t, 3>> triangle;  ///< vertices, counterclockwise, (triangles)
  std::vector<BoundaryEdge> boundary;                 ///< (boundary edges)

  std::size_t vertices() const { return position.size(); }
  std::size_t triangles() const { return triangle.size(); }
};

/// Twice the signed area of a triangle [m2]; positive when counterclockwise.
inline double doubled_area(base::Vec2 a, base::Vec2 b, base::Vec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

/// The boundary edges of the triangles, each with the tag that `tag_of` says for it from the places of its two ends.
/// Throws std::logic_error when an edge has more than two triangles, or two that turn along it in the same sense.
std::vector<BoundaryEdge> boundary_of(std::span<const std::array<std::int32_t, 3>> triangles,
                                      std::span<const base::Vec2> position,
                                      const std::function<std::int32_t(base::Vec2 from, base::Vec2 to)>& tag_of);

/// Throws std::logic_error with one sentence when the invariant does not hold.
void check(const TriangleMesh& mesh);

/// The vertices along the edges of `tag`, in the order of their edges (which run with the domain to the left).
/// Throws std::logic_error when the edges are not one open chain.
std::vector<std::int32_t> chain(const TriangleMesh& mesh, std::int32_t tag);

}  // namespace seapile::mesh
