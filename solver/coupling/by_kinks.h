// A disc's share at each vertex where it crosses few edges: the usual case, as triangles are wider than grains.
#pragma once

#include <array>
#include <cstdint>

#include "solver/coupling/deposit.h"
#include "solver/coupling/disc_in_triangle.h"
#include "solver/grains/grains.h"
#include "solver/mesh/triangle_mesh.h"

namespace seapile::coupling {

/// A triangle as a disc's centre sees it.
struct View {
  std::array<base::Vec2, 3> corner;  ///< relative to the centre [m]
  std::array<double, 3> turned;      ///< twice the area of the centre and the edge from corner k [m2]

  double doubled() const { return turned[0] + turned[1] + turned[2]; }
};

inline View view(const mesh::TriangleMesh& mesh, std::int32_t triangle, base::Vec2 centre) {
  const auto& t = mesh.triangle[triangle];
  View v{{mesh.position[t[0]] - centre, mesh.position[t[1]] - centre, mesh.position[t[2]] - centre}, {}};
  for (int k = 0; k < 3; ++k) v.turned[k] = cross(v.corner[k], v.corner[(k + 1) % 3]);
  return v;
}

struct Entry {
  std::int32_t vertex;
  double volume;
};

/// A few vertices, in the order in which they were met.
struct FewEntries {
  static constexpr int kMost = 20;
  std::array<Entry, kMost> entry;
  int count = 0;

  int place_of(std::int32_t vertex) {
    for (int k = 0; k < count; ++k)
      if (entry[k].vertex == vertex) return k;
    entry[count] = {vertex, 0};
    return count++;
  }
};

/// An edge that the disc crosses, seen from the triangle on the centre's side.
struct Crossed {
  std::int32_t edge;                 ///< as in Location::across
  std::array<int, 3> place;          ///< in FewEntries: of the edge's ends and of the corner opposite to it
  std::array<base::Vec2, 3> corner;  ///< in the same order
  double turned, doubled;            ///< of the edge and of the triangle
};

/// The edges that a disc crosses, in the order in which they were met.
struct FewCrossed {
  static constexpr int kMost = 8;
  double radius = 0;
  std::array<Crossed, kMost> edge;
  int count = 0;

  /// Takes the edge up if the disc crosses it; false when it is one too many. The disc holds neither end.
  bool look(const Crossed& c) {
    const base::Vec2 along = c.corner[1] - c.corner[0];
    if (c.turned * c.turned >= radius * radius * dot(along, along)) return true;
    if (dot(c.corner[0], along) >= 0 || dot(c.corner[1], along) <= 0) return true;  // it passes beside the ends
    if (count == kMost) return false;
    edge[count++] = c;
    return true;
  }
};

/// A disc that holds at most one vertex, of the triangle that holds its centre, and that stays in the mesh. The other
/// edges that it crosses cut it into caps, which do not overlap. N_j goes on beyond an edge as it was before it, but
/// for kink_j s, s the distance beyond the edge's line. So V_ij is the integral of the linear functions of the centre's
/// triangle, or of those around the vertex, plus kink_j times the integral of s over each cap.
class ByKinks {
 public:
  ByKinks(const mesh::TriangleMesh& mesh, const Location& location) : mesh_(mesh), location_(location) {}

  /// False when the disc is none of these. `v`: how its centre sees t, which holds it.
  bool make(const grains::Disc& disc, std::int32_t t, const View& v);

  FewEntries sum;  ///< the share of each vertex [m2], of the last disc

 private:
  bool outside(base::Vec2 p) const { return dot(p, p) > r_ * r_; }

  /// The disc, as if its centre's triangle had no end.
  bool whole(std::int32_t t, const View& v);

  /// The disc, as if the triangles around the vertex at corner k of t went on beyond their third edges.
  bool around(std::int32_t t, const View& v, int k);

  /// The kink at an edge, and the edges of the triangle beyond.
  bool cross_over(const Crossed& c);

  const mesh::TriangleMesh& mesh_;
  const Location& location_;
  base::Vec2 centre_;
  double r_ = 0;
  FewCrossed crossed_;
};

}  // namespace seapile::coupling
