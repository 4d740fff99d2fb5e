// Area and first moment of what a disc and a triangle have in common.
//
// Green's theorem about the disc's centre: each directed edge a -> b of the triangle adds the signed share of the
// triangle (centre, a, b) that lies in the disc. Of that, the edge's part in the disc spans a triangle, and each part
// outside of it a circular sector. Only differences of neighbouring angles appear, all smaller than pi, so nothing is
// to be decided where a vertex lies on the circle or the centre on an edge. Exact up to some roundings of r^2.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

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
[[gnu::always_inline]] inline double beyond_line(double r, double x) {
  // 2/3 s^3 - x (acos x - x s), s = sqrt(1 - x^2), is u^2.5 g(u) with u = 1 - x. The polynomial meets g at the 16
  // Chebyshev points of [0, 1], 4e-17 of g from it in between. A third of the time of acos, and exact also for u -> 0.
  static constexpr std::array<double, 16> kG = {
      0.75424723326565069,     -0.080812203564185156,   -0.0056119585801430727,  -0.00089281161583159717,
      -0.00019315594556791173, -4.9581087705731605e-05, -1.4187455761598029e-05, -4.5479142576979819e-06,
      -9.8794205306332998e-07, -1.6102284950387301e-06, 1.7577787093733476e-06,  -2.4948292302380935e-06,
      2.1237352203283726e-06,  -1.2886183834117481e-06, 4.6183146852181177e-07,  -8.2162767715824521e-08};
  const double u = 0.5 * ((1 - x) + std::abs(1 - x)),  // max(1 - x, 0), and no branch
      u2 = u * u, u4 = u2 * u2, u8 = u4 * u4;
  const auto part = [u, u2](int k) { return (kG[k] + u * kG[k + 1]) + u2 * (kG[k + 2] + u * kG[k + 3]); };
  const double g = (part(0) + u4 * part(4)) + u8 * (part(8) + u4 * part(12));
  return r * r * r * u2 * std::sqrt(u) * g;
}

/// The same in the part of the disc between a ray from a vertex and the ray from there away from the centre, of the
/// distance beyond the former's line [m3]. The vertex is away r from the centre, 0 <= away <= 1; the ray's direction
/// has the components x along the other and y >= 0 across it.
[[gnu::always_inline]] inline double beyond_ray(double r, double away, double x, double y) {
  // The ray and its opposite have the cap beyond their line together: half of it, and what one has more.
  const double more =
      r * r * r * std::abs(x) * (1 - away) * (2 - away * (1 + away) * y * y) / 6 + 0.5 * away * beyond_line(r, y);
  return 0.5 * beyond_line(r, away * y) - std::copysign(more, x);
}

}  // namespace seapile::coupling
