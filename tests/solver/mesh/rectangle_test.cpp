// Structured meshes: vertices where they are asked for, tags of the sides, mirror images.
#include "solver/mesh/rectangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

namespace seapile::mesh {
namespace {

TEST(Even, EndsExactlyWhereItIsAskedTo) {
  const std::vector<double> values = even(0.1, 0.7, 7);
  ASSERT_EQ(values.size(), 8u);
  EXPECT_EQ(values.front(), 0.1);
  EXPECT_EQ(values.back(), 0.7);
  for (std::size_t k = 1; k < values.size(); ++k)
    EXPECT_NEAR(values[k] - values[k - 1], 0.6 / 7, 1e-15);  // A few roundings of numbers below 1.
}

TEST(Rectangle, IsTheProductOfItsAxes) {
  const std::vector<double> x = {-1, 0.5, 2}, y = {3, 3.25, 4, 7};
  const TriangleMesh mesh = rectangle(x, y);
  ASSERT_EQ(mesh.vertices(), 12u);
  ASSERT_EQ(mesh.triangles(), 12u);
  for (std::size_t j = 0; j < y.size(); ++j)
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(mesh.position[i + j * x.size()], (base::Vec2{x[i], y[j]}));
  double doubled = 0;
  for (const auto& t : mesh.triangle)
    doubled += doubled_area(mesh.position[t[0]], mesh.position[t[1]], mesh.position[t[2]]);
  EXPECT_EQ(doubled, 2 * 3 * 4);  // Binary fractions: exactly.
  check(mesh);
}

TEST(Rectangle, TagsItsSides) {
  const TriangleMesh mesh = rectangle(even(0, 1, 3), even(0, 1, 3), Diagonals::alike);
  std::array<int, 4> count{};
  for (const BoundaryEdge& e : mesh.boundary) {
    const base::Vec2 a = mesh.position[e.from], b = mesh.position[e.to];
    ++count[e.tag];
    const std::array<bool, 4> lies_on = {a.y == 0 && b.y == 0, a.x == 1 && b.x == 1, a.y == 1 && b.y == 1,
                                         a.x == 0 && b.x == 0};
    EXPECT_TRUE(lies_on[e.tag]);
  }
  EXPECT_EQ(count, (std::array<int, 4>{3, 3, 3, 3}));
}

/// The triangles of a mesh as sets of vertices, after `vertex` has been applied to each.
template <class Map>
std::set<std::set<std::int32_t>> triangles(const TriangleMesh& mesh, Map&& vertex) {
  std::set<std::set<std::int32_t>> all;
  for (const auto& t : mesh.triangle) all.insert({vertex(t[0]), vertex(t[1]), vertex(t[2])});
  return all;
}

TEST(Rectangle, WithMirroredDiagonalsIsItsOwnMirrorImage) {
  for (const int columns : {2, 6}) {
    const TriangleMesh mesh = rectangle(even(-1, 1, columns), even(0, 1, 3), Diagonals::mirrored);
    check(mesh);
    const auto self = [](std::int32_t v) { return v; };
    const auto image = [columns](std::int32_t v) {
      const std::int32_t i = v % (columns + 1);
      return v - i + columns - i;
    };
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.vertices()); ++v) {
      EXPECT_EQ(mesh.position[image(v)].y, mesh.position[v].y);
      EXPECT_NEAR(mesh.position[image(v)].x, -mesh.position[v].x, 1e-15);  // even() rounds.
    }
    EXPECT_EQ(triangles(mesh, self), triangles(mesh, image));
    // The check can fail: diagonals that are all alike are no mirror image.
    const TriangleMesh alike = rectangle(even(-1, 1, columns), even(0, 1, 3), Diagonals::alike);
    EXPECT_NE(triangles(alike, self), triangles(alike, image));
  }
}

TEST(Rectangle, RefusesWhatHasNoMiddleOrNoCells) {
  EXPECT_THROW(rectangle(even(0, 1, 3), even(0, 1, 2), Diagonals::mirrored), std::logic_error);
  EXPECT_THROW(rectangle(std::vector<double>{0}, even(0, 1, 2)), std::logic_error);
  EXPECT_THROW(rectangle(even(0, 1, 2), std::vector<double>{0}), std::logic_error);
}

}  // namespace
}  // namespace seapile::mesh
