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

Box box_of(std::span<const base::Vec2, 3> corner);

/// Which triangles may be near a place: those whose boxes touch its cell of a grid.
class Buckets {
 public:
  explicit Buckets(const TriangleMesh& mesh);

  /// Those that may hold p, by rising number. None when p is in a cell without triangles.
  std::span<const std::int32_t> at(base::Vec2 p) const;
  /// Those that may overlap the box, by rising number.
  void near(const Box& box, std::vector<std::int32_t>& found) const;

  double cell_size() const { return cell_; }  ///< [m]

 private:
  struct Cells {
    std::int32_t left, right, bottom, top;
  };
  /// The cells of a box that is a little larger, so that a place at its edge is in it whatever the rounding.
  Cells cells(const Box& box) const;
  std::int32_t column(double x) const;
  std::int32_t row(double y) const;
  std::size_t cell(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row) * columns_ + column;
  }
  std::span<const std::int32_t> in(std::size_t cell) const {
    return {in_cell_.data() + first_[cell], static_cast<std::size_t>(first_[cell + 1] - first_[cell])};
  }

  base::Vec2 low_;
  double cell_ = 0, per_length_ = 0;
  std::int32_t columns_ = 0, rows_ = 0;
  std::vector<std::int32_t> first_;    ///< (cells + 1) where a cell's triangles begin
  std::vector<std::int32_t> in_cell_;  ///< by rising number within a cell
};

}  // namespace seapile::mesh
