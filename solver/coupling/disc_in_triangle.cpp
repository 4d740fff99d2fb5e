#include "solver/coupling/disc_in_triangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace seapile::coupling {
namespace {

using base::Vec2;

/// The part [from, to] of an edge a + t (b - a) that lies in the disc; none when from >= to.
struct Chord {
  double from = 1, to = 0;

  bool any() const { return from < to; }
};

Chord chord_of(double r, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double square = dot(along, along), off = cross(a, b), under = r * r * square - off * off;
  if (!(under > 0)) return {};
  const double middle = -dot(a, along) / square, half = std::sqrt(under) / square;
  return {std::max(middle - half, 0.0), std::min(middle + half, 1.0)};
}

void add_sector(Moments& sum, double r, Vec2 a, Vec2 b) {
  const double angle = std::atan2(cross(a, b), dot(a, b));
  const Vec2 turn = (1 / norm(b)) * b - (1 / norm(a)) * a;
  sum.area += 0.5 * r * r * angle;
  sum.first = sum.first - (r * r * r / 3) * perpendicular(turn);
}

void add_edge(Moments& sum, double r, Vec2 a, Vec2 b, Chord chord) {
  if (!chord.any()) return add_sector(sum, r, a, b);
  const Vec2 along = b - a;
  const Vec2 p = chord.from > 0 ? a + chord.from * along : a, q = chord.to < 1 ? a + chord.to * along : b;
  if (chord.from > 0) add_sector(sum, r, a, p);
  const double area = 0.5 * cross(p, q);
  sum.area += area;
  sum.first = sum.first + (area / 3) * (p + q);
  if (chord.to < 1) add_sector(sum, r, q, b);
}

}  // namespace

Moments disc_in_triangle(double r, Vec2 a, Vec2 b, Vec2 c) {
  const std::array<Chord, 3> chord = {chord_of(r, a, b), chord_of(r, b, c), chord_of(r, c, a)};
  if (!chord[0].any() && !chord[1].any() && !chord[2].any()) {
    const bool around = cross(a, b) > 0 && cross(b, c) > 0 && cross(c, a) > 0;
    return {around ? std::numbers::pi * r * r : 0, {}};
  }
  Moments sum;
  add_edge(sum, r, a, b, chord[0]);
  add_edge(sum, r, b, c, chord[1]);
  add_edge(sum, r, c, a, chord[2]);
  return sum;
}

}  // namespace seapile::coupling
