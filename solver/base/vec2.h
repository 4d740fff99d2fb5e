#pragma once

#include <cmath>

namespace seapile::base {

/// A point or vector of the plane.
struct Vec2 {
  double x = 0;
  double y = 0;

  friend bool operator==(const Vec2&, const Vec2&) = default;
};

inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }

/// The vector turned by +90 degrees: the tangent that belongs to a normal.
inline Vec2 perpendicular(Vec2 a) { return {-a.y, a.x}; }

}  // namespace seapile::base
