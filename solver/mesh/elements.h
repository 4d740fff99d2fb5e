// Triangles as linear functions on them see them, and a grid that knows which of them are where.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/mesh/triangle_mesh.h"

namespace seapile::mesh {

/// A triangle as functions on it see it.
struct Element {
  std::array<std::int32_t, 3> vertex;
  std::array<base::Vec2, 3> corner, gradient;  ///< of the vertices' linear functions [1/m]
  double area;

  std::array<double, 3> at(base::Vec2 p) const {
    return {1 + dot(gradient[0], p - corner[0]), 1 + dot(gradient[1], p - corner[1]),
            1 + dot(gradient[2], p - corner[2])};
  }
  double value(std::span<const double> f, base::Vec2 p) const { return f[vertex[0]] + dot(slope(f), p - corner[0]); }
  base::Vec2 slope(std::span<const double> f) const {
    return (f[vertex[1]] - f[vertex[0]]) * gradient[1] + (f[vertex[2]] - f[vertex[0]]) * gradient[2];
  }
};

/// Throws std::logic_error when a triangle does not turn counterclockwise, at finite places.
std::vector<Element> elements_of(const TriangleMesh& mesh);

struct Box {
  base::Vec2 low, high;
};

Box box_of(const Element& element);

/// Which triangles may be near a place: those whose boxes touch its cell of a grid.
class Buckets {
 public:
  explicit Buckets(std::span<const Element> elements);

  /// Those that may hold p. None when p is in a cell without triangles.
  const std::vector<std::int32_t>& at(base::Vec2 p) const;
  /// Those that may overlap the box, by rising number.
  std::vector<std::int32_t> near(const Box& box) const;

 private:
  /// The cells of a box that is a little larger, so that a place at its edge is in it whatever the rounding.
  std::vector<std::size_t> cells(const Box& box) const;
  std::int32_t column(double x) const;
  std::int32_t row(double y) const;

  base::Vec2 low_;
  double cell_ = 0;
  std::int32_t columns_ = 0, rows_ = 0;
  std::vector<std::vector<std::int32_t>> in_cell_;
};

}  // namespace seapile::mesh
