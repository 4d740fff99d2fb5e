// The edges of a mesh as a disc meets them: how far they are, and how the linear functions bend there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/base/vec2.h"
#include "solver/mesh/triangle_mesh.h"

namespace seapile::coupling {

/// An edge as one of its triangles sees it: at 3 t + k that of t from corner k. A cache line.
struct alignas(64) Edge {
  base::Vec2 from;        ///< place of the corner where it begins [m]
  double per_length = 0;  ///< inverse of its length [1/m]
  /// What the slopes across it of linear functions grow by beyond it: of that of the corner where it begins, of that of
  /// the corner opposite to it, which is also the inverse of the triangle's height, and of that of the neighbour's
  /// [1/m]; and less the sum of these of that of the other end. At the boundary only the second has a meaning.
  double kink_from = 0, kink_opposite = 0, kink_far = 0;
  std::int32_t vertex = 0;  ///< where it begins
  /// The neighbour's edges from this one's begin to the neighbour's corner opposite to it, and from there to its end;
  /// -1 at the boundary.
  std::int32_t to_far = -1, from_far = -1;
};

/// Of the same triangle: the edge that begins where this one ends, and the one that ends where it begins.
inline std::int32_t next(std::int32_t edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; }
inline std::int32_t previous(std::int32_t edge) { return edge % 3 == 0 ? edge + 2 : edge - 1; }

/// The same edge of the neighbour, or -1.
inline std::int32_t across(const Edge& edge) { return edge.from_far < 0 ? -1 : next(edge.from_far); }

/// The two sides of an edge.
struct Sides {
  std::int32_t one, other;             ///< edges; the other is -1 at the boundary
  std::array<std::int32_t, 4> vertex;  ///< where one begins, where it ends, opposite to it, and beyond it or -1
};

/// The edges of some triangles.
class Edges {
 public:
  explicit Edges(std::span<const std::array<std::int32_t, 3>> triangles);

  const Edge& operator[](std::int32_t edge) const { return edge_[edge]; }
  const Edge* data() const { return edge_.data(); }

  /// Takes places, lengths and kinks from the mesh: the share `me` of so many threads.
  void measure(const mesh::TriangleMesh& mesh, int me, int threads);

 private:
  std::vector<Edge> edge_;
  std::vector<Sides> sides_;  ///< each edge of the mesh once
};

}  // namespace seapile::coupling
