// Area and first moment of what a disc and a triangle have in common.
//
// Green's theorem about the disc's centre: each directed edge a -> b of the triangle adds the signed share of the
// triangle (centre, a, b) that lies in the disc. Of that, the edge's part in the disc spans a triangle, and each part
// outside of it a circular sector. Only differences of neighbouring angles appear, all smaller than pi, so nothing is
// to be decided where a vertex lies on the circle or the centre on an edge. Exact up to some roundings of r^2.
#pragma once

#include "solver/base/vec2.h"

namespace seapile::coupling {

/// Twice the area of the triangle 0, a, b. Turned the other way it is the same number with the other sign, bit for bit:
/// of two triangles at an edge one holds a place, or both do, when it is on the edge.
inline double cross(base::Vec2 a, base::Vec2 b) { return a.x * b.y - a.y * b.x; }

struct Moments {
  double area = 0;     ///< [m2]
  base::Vec2 first{};  ///< integral of the place relative to the disc's centre [m3]
};

/// Of the disc of radius r about 0 and the counterclockwise triangle a, b, c.
Moments disc_in_triangle(double r, base::Vec2 a, base::Vec2 b, base::Vec2 c);

/// Integral over a disc of radius r of max(0, s), s the distance beyond a line that passes the centre at x r, with
/// 0 <= x <= 1 [m3].
double beyond_line(double r, double x);

}  // namespace seapile::coupling
