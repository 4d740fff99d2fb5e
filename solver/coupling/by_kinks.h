// A disc's share at each vertex where it crosses few edges: the usual case, as triangles are wider than grains.
//
// Of a disc that holds at most one vertex. V_ij is the integral of the linear functions of its centre's
// triangle, as if they had no end, and of what they bend by at each edge that the disc crosses: kink_j times the
// integral of the distance beyond the edge. Where the edge ends outside of the disc, that is over a cap; caps do not
// overlap. Where it ends at a vertex in the disc it is over the wedge from the edge to the ray from the vertex away
// from the centre: all that is reached by crossing it, when one goes around the vertex either way as far as this ray.
// What reaches over the boundary by less than a hundredth of the radius, as discs do that lie against a wall, is taken
// away: over the cap beyond it, at the distance d, of area A and first moment M across the edge,
//   int N_j = N_j(x_i) A + (dN_j/dn) M,   M = 2/3 (r^2 - d^2)^1.5,   A = (M - int (s - d))/d.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "solver/coupling/disc_in_triangle.h"
#include "solver/coupling/edges.h"
#include "solver/coupling/wedge_kernels.h"
#include "solver/grains/grains.h"

namespace seapile::coupling {

/// A triangle as a disc's centre sees it.
struct View {
  std::array<base::Vec2, 3> corner;  ///< relative to the centre [m]
  std::array<double, 3> turned;      ///< twice the area of the centre and the edge from corner k [m2]

  /// Whether it holds the centre off its edges: then no other does.
  bool holds() const { return (turned[0] > 0) & (turned[1] > 0) & (turned[2] > 0); }
};

inline View view(const Edges& edges, std::int32_t triangle, base::Vec2 centre) {
  const Edge* const e = &edges[3 * triangle];
  View v{{e[0].from - centre, e[1].from - centre, e[2].from - centre}, {}};
  for (int k = 0; k < 3; ++k) v.turned[k] = cross(v.corner[k], v.corner[(k + 1) % 3]);
  return v;
}

/// N of t's corner k at the centre.
inline double value_at_corner(const Edges& edges, std::int32_t t, const View& v, int k) {
  const int l = (k + 1) % 3;
  const Edge& opposite = edges[3 * t + l];
  return v.turned[l] * opposite.per_length * opposite.kink_opposite;
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

/// Any disc that holds at most one vertex and is in the mesh, but for flat caps.
class ByKinks {
 public:
  ByKinks(const Edges& edges, WedgeKernel wedges) : edges_(edges), wedges_(wedges) {}

  /// False when the disc is none of these. `v`: how its centre sees t, which holds it.
  bool make(const grains::Disc& disc, std::int32_t t, const View& v);

  FewEntries sum;  ///< the share of each vertex [m2], of the last disc

 private:
  /// An edge that the disc crosses, seen from the triangle on the centre's side.
  struct Crossed {
    std::int32_t edge;
    std::array<int, 3> place;  ///< in `sum`: of the edge's ends and of the corner opposite to it
    double distance;           ///< of the centre to its line [m]
  };
  static constexpr int kMostCrossed = 8;

  bool outside(base::Vec2 p) const { return dot(p, p) > r_ * r_; }
  base::Vec2 from(std::int32_t edge) const { return edges_[edge].from - centre_; }

  /// Takes an edge up if the disc crosses it; false when it is one too many. The disc holds neither end.
  bool look(std::int32_t edge, std::array<int, 3> place, base::Vec2 a, base::Vec2 b);

  /// The kinks at the edges from the vertex at corner k of t, which the disc holds; and takes up the edges opposite.
  bool around(std::int32_t t, int k);

  /// The kinks at an edge; and takes up those of the triangle beyond.
  bool cross_over(const Crossed& c);

  /// Takes away what is beyond an edge of the boundary; false where that is more.
  bool cut_off(const Crossed& c);

  /// What an edge adds; the places are those of its ends, of the corner opposite to it and of the neighbour's.
  void add(const Edge& edge, std::array<int, 4> place, double integral) {
    const double a = integral * edge.kink_from, opposite = integral * edge.kink_opposite,
                 far = integral * edge.kink_far;
    sum.entry[place[0]].volume += a;
    sum.entry[place[1]].volume -= a + opposite + far;
    sum.entry[place[2]].volume += opposite;
    sum.entry[place[3]].volume += far;
  }

  const Edges& edges_;
  WedgeKernel wedges_;
  Rays rays_;
  base::Vec2 centre_;
  double r_ = 0;
  std::array<Crossed, kMostCrossed> crossed_;
  int crosses_ = 0;
};

}  // namespace seapile::coupling
