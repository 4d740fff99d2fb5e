// Vertices keep their share of the height under a surface that moves.
#include "solver/mesh/columns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/base/random.h"
#include "solver/mesh/rectangle.h"

namespace seapile::mesh {
namespace {

constexpr double kFirst = -0.3, kBottom_y = -0.2, kTop_y = 0.8, kLast = 1.7;

/// A rectangle whose inner vertices have been moved at random by up to a fifth of a cell.
TriangleMesh scattered() {
  constexpr int kColumns = 9, kRows = 5;
  TriangleMesh mesh = rectangle(even(kFirst, kLast, kColumns), even(kBottom_y, kTop_y, kRows));
  const double dx = (kLast - kFirst) / kColumns, dy = (kTop_y - kBottom_y) / kRows;
  for (std::size_t v = 0; v < mesh.vertices(); ++v) {
    base::Vec2& p = mesh.position[v];
    if (p.x > kFirst && p.x < kLast && p.y > kBottom_y && p.y < kTop_y)
      p = p + base::Vec2{dx * base::uniform(-0.2, 0.2, 1, 0, v), dy * base::uniform(-0.2, 0.2, 1, 1, v)};
  }
  return mesh;
}

/// The vertices of the top, by rising x, and their heights.
std::vector<std::int32_t> surface_of(const TriangleMesh& mesh) {
  std::vector<std::int32_t> surface = chain(mesh, kTop);
  std::ranges::reverse(surface);
  return surface;
}
std::vector<double> heights(const TriangleMesh& mesh, const std::vector<std::int32_t>& surface) {
  std::vector<double> height;
  for (const std::int32_t vertex : surface) height.push_back(mesh.position[vertex].y);
  return height;
}

// Shares of the height are quotients, so places come back to a few roundings of numbers below 1.
TEST(Columns, TheSameHeightLeavesTheMeshWhereItIs) {
  TriangleMesh mesh = scattered();
  const TriangleMesh before = mesh;
  const auto surface = surface_of(mesh);
  const Columns columns = columns_under(mesh, surface, kBottom_y);
  regularise(mesh, columns, heights(mesh, surface));
  for (std::size_t v = 0; v < mesh.vertices(); ++v) {
    EXPECT_EQ(mesh.position[v].x, before.position[v].x);
    EXPECT_NEAR(mesh.position[v].y, before.position[v].y, 4e-16);
  }
}

TEST(Columns, TheSurfaceLiesExactlyOnItsHeightAndTheBottomStays) {
  TriangleMesh mesh = scattered();
  const auto surface = surface_of(mesh);
  const Columns columns = columns_under(mesh, surface, kBottom_y);
  std::vector<double> height;
  for (std::size_t s = 0; s < surface.size(); ++s) height.push_back(base::uniform(0.5, 1.3, 2, 0, s));
  regularise(mesh, columns, height);
  for (std::size_t s = 0; s < surface.size(); ++s) EXPECT_EQ(mesh.position[surface[s]].y, height[s]);
  for (const std::int32_t vertex : chain(mesh, kBottom)) EXPECT_EQ(mesh.position[vertex].y, kBottom_y);
  check(mesh);
}

TEST(Columns, AVertexKeepsItsShareOfTheHeightAboveTheBottom) {
  TriangleMesh mesh = scattered();
  const TriangleMesh before = mesh;
  const auto surface = surface_of(mesh);
  const Columns columns = columns_under(mesh, surface, kBottom_y);
  const auto tilted = [](double x) { return 0.9 + 0.25 * x; };  // Linear, so also between the surface's vertices.
  std::vector<double> height;
  for (const std::int32_t vertex : surface) height.push_back(tilted(mesh.position[vertex].x));
  regularise(mesh, columns, height);
  for (std::size_t v = 0; v < mesh.vertices(); ++v) {
    const double share = (before.position[v].y - kBottom_y) / (kTop_y - kBottom_y);
    EXPECT_EQ(mesh.position[v].x, before.position[v].x);
    EXPECT_NEAR(mesh.position[v].y, kBottom_y + share * (tilted(mesh.position[v].x) - kBottom_y), 1e-15);
  }
}

TEST(Columns, ComeBackAfterManyMoves) {
  TriangleMesh mesh = scattered();
  const TriangleMesh before = mesh;
  const auto surface = surface_of(mesh);
  const Columns columns = columns_under(mesh, surface, kBottom_y);
  const std::vector<double> start = heights(mesh, surface);
  for (std::uint64_t move = 0; move < 100; ++move) {
    std::vector<double> height;
    for (std::size_t s = 0; s < surface.size(); ++s)
      height.push_back(base::uniform(0.5, 1.3, 3, static_cast<std::uint32_t>(s), move));
    regularise(mesh, columns, height);
  }
  regularise(mesh, columns, start);  // From shares that are never computed again: no error grows.
  for (std::size_t v = 0; v < mesh.vertices(); ++v) EXPECT_NEAR(mesh.position[v].y, before.position[v].y, 4e-16);
}

TEST(Columns, VerticesBesideTheSurfaceAreLeftAlone) {
  TriangleMesh mesh = scattered();
  const TriangleMesh before = mesh;
  const auto all = surface_of(mesh);
  const std::vector<std::int32_t> surface(all.begin() + 3, all.end());
  const Columns columns = columns_under(mesh, surface, kBottom_y);
  regularise(mesh, columns, std::vector<double>(surface.size(), 1.1));
  const double from = before.position[surface.front()].x;
  int beside = 0, below = 0;
  for (std::size_t v = 0; v < mesh.vertices(); ++v) {
    const base::Vec2 p = before.position[v];
    if (p.x < from) {
      EXPECT_EQ(mesh.position[v], p);
      ++beside;
    } else if (p.y > kBottom_y) {
      EXPECT_GT(mesh.position[v].y, p.y);
      ++below;
    }
  }
  EXPECT_GT(beside, 10);
  EXPECT_GT(below, 25);
}

TEST(Columns, HangByRisingVertex) {
  const TriangleMesh mesh = scattered();
  const Columns columns = columns_under(mesh, surface_of(mesh), kBottom_y);
  EXPECT_EQ(columns.hanging.size(), mesh.vertices());
  EXPECT_TRUE(std::ranges::is_sorted(columns.hanging, {}, &Hanging::vertex));
}

TEST(Columns, ASurfaceThatIsNoGraphIsRefused) {
  const TriangleMesh mesh = scattered();
  EXPECT_THROW(columns_under(mesh, chain(mesh, kTop), kBottom_y), std::logic_error);    // From right to left.
  EXPECT_THROW(columns_under(mesh, chain(mesh, kRight), kBottom_y), std::logic_error);  // Upright.
}

}  // namespace
}  // namespace seapile::mesh
