// Unstructured meshes of polygons.
#include "solver/mesh/generate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>

namespace seapile::mesh {
namespace {

/// A basin 5 wide and 2 deep with a pile's notch in its middle; side k leaves corner k.
const std::vector<Corner> kBasin = {{{-2.5, 0}, 0},     {{2.5, 0}, 1},     {{2.5, 2}, 2},
                                    {{0.125, 2}, 3},    {{0.125, 1.2}, 4}, {{0, 1.2 - 0.2165}, 5},
                                    {{-0.125, 1.2}, 6}, {{-0.125, 2}, 7},  {{-2.5, 2}, 8}};
constexpr base::Vec2 kTip = {0, 1.2 - 0.2165};

/// Small at the pile's tip, ten times as large far away.
double graded(base::Vec2 p) { return std::min(0.3, 0.03 + 0.2 * norm(p - kTip)); }

double least_angle(const TriangleMesh& mesh) {
  double least = std::numbers::pi;
  for (const auto& t : mesh.triangle)
    for (int k = 0; k < 3; ++k) {
      const base::Vec2 at = mesh.position[t[k]];
      const base::Vec2 a = mesh.position[t[(k + 1) % 3]] - at, b = mesh.position[t[(k + 2) % 3]] - at;
      least = std::min(least, std::acos(dot(a, b) / (norm(a) * norm(b))));
    }
  return least * 180 / std::numbers::pi;
}

TEST(Generate, FillsThePolygon) {
  const TriangleMesh mesh = generate(kBasin, graded);
  double doubled = 0, polygon = 0;
  for (const auto& t : mesh.triangle)
    doubled += doubled_area(mesh.position[t[0]], mesh.position[t[1]], mesh.position[t[2]]);
  for (std::size_t k = 0; k < kBasin.size(); ++k) {
    const base::Vec2 a = kBasin[k].position, b = kBasin[(k + 1) % kBasin.size()].position;
    polygon += a.x * b.y - b.x * a.y;
  }
  EXPECT_NEAR(doubled, polygon, 1e-12);  // Two thousand summands below 0.1, each rounded.
}

TEST(Generate, GivesTheSameBitsAgain) {
  const TriangleMesh first = generate(kBasin, graded);
  generate(std::vector<Corner>{{{0, 0}, 0}, {{1, 0}, 1}, {{0, 1}, 2}}, [](base::Vec2) { return 0.2; });
  const TriangleMesh second = generate(kBasin, graded);
  ASSERT_EQ(first.vertices(), second.vertices());
  EXPECT_EQ(std::memcmp(first.position.data(), second.position.data(), first.vertices() * sizeof(base::Vec2)), 0);
  EXPECT_EQ(first.triangle, second.triangle);
  ASSERT_EQ(first.boundary.size(), second.boundary.size());
  for (std::size_t e = 0; e < first.boundary.size(); ++e) {
    const BoundaryEdge &a = first.boundary[e], &b = second.boundary[e];
    EXPECT_TRUE(a.from == b.from && a.to == b.to && a.triangle == b.triangle && a.tag == b.tag);
  }
}

TEST(Generate, EveryCornerIsAVertexAndEverySideAChainOnItsLine) {
  const TriangleMesh mesh = generate(kBasin, graded);
  for (std::size_t k = 0; k < kBasin.size(); ++k) {
    const base::Vec2 from = kBasin[k].position, to = kBasin[(k + 1) % kBasin.size()].position;
    const std::vector<std::int32_t> side = chain(mesh, kBasin[k].side);
    ASSERT_GE(side.size(), 2u);
    EXPECT_EQ(mesh.position[side.front()], from);
    EXPECT_EQ(mesh.position[side.back()], to);
    for (const std::int32_t vertex : side) {
      EXPECT_NEAR(doubled_area(from, to, mesh.position[vertex]), 0, 1e-15);  // Up to the rounding of a place.
    }
  }
}

// A free surface, a wall or the axis of a round jet stands on equal coordinates.
TEST(Generate, AnUprightOrLevelSideIsExactlyWhereItsCornersAre) {
  for (const double shift : {0.1, 0.3, 0.7, 1.1}) {
    const double left = shift / 3, right = 2.3 + shift, low = 0.7 * shift, high = 1.9 + shift / 7;
    const TriangleMesh mesh =
        generate(std::vector<Corner>{{{left, low}, 0}, {{right, low}, 1}, {{right, high}, 2}, {{left, high}, 3}},
                 [](base::Vec2) { return 0.13; });
    for (const std::int32_t vertex : chain(mesh, 0)) EXPECT_EQ(mesh.position[vertex].y, low);
    for (const std::int32_t vertex : chain(mesh, 1)) EXPECT_EQ(mesh.position[vertex].x, right);
    for (const std::int32_t vertex : chain(mesh, 2)) EXPECT_EQ(mesh.position[vertex].y, high);
    for (const std::int32_t vertex : chain(mesh, 3)) EXPECT_EQ(mesh.position[vertex].x, left);
  }
}

TEST(Generate, AWholeSideIsOneEdge) {
  std::vector<Corner> corners = kBasin;
  corners[4].whole = corners[5].whole = corners[7].whole = true;
  const TriangleMesh mesh = generate(corners, [](base::Vec2) { return 0.05; });
  for (const std::int32_t whole : {4, 5, 7}) EXPECT_EQ(chain(mesh, whole).size(), 2u);
  EXPECT_GT(chain(mesh, 6).size(), 4u);
}

TEST(Generate, SizesFollowTheFunctionOfPlace) {
  const TriangleMesh mesh = generate(kBasin, graded);
  double at_tip = 0, shortest = 1, longest = 0, ratio = 0;
  int edges = 0, tip_edges = 0;
  for (const auto& t : mesh.triangle)
    for (int k = 0; k < 3; ++k) {
      const base::Vec2 a = mesh.position[t[k]], b = mesh.position[t[(k + 1) % 3]];
      const double length = norm(b - a), relative = length / graded(0.5 * (a + b));
      shortest = std::min(shortest, relative);
      longest = std::max(longest, relative);
      ratio += relative;
      ++edges;
      if (a == kTip || b == kTip) at_tip += length, ++tip_edges;
    }
  std::printf("edges by the size asked for: %.2f to %.2f, mean %.3f; at the tip %.4f\n", shortest, longest,
              ratio / edges, at_tip / tip_edges);
  // Gmsh aims at the size, and divides sides into whole edges; within a quarter in the mean, a factor 2 anywhere.
  EXPECT_NEAR(ratio / edges, 1, 0.25);
  EXPECT_GT(shortest, 0.4);
  EXPECT_LT(longest, 2);
  EXPECT_NEAR(at_tip / tip_edges, 0.03, 0.25 * 0.03);
}

// The frontal method with smoothing leaves angles far above the 20 degrees that finite elements want at least.
TEST(Generate, NoAngleIsSmall) {
  const double graded_angle = least_angle(generate(kBasin, graded));
  const double even_angle = least_angle(generate(kBasin, [](base::Vec2) { return 0.11; }));
  std::printf("least angle: graded %.1f degrees, even %.1f degrees\n", graded_angle, even_angle);
  EXPECT_GT(graded_angle, 25);
  EXPECT_GT(even_angle, 25);
}

// With Gmsh's own words, and the next polygon is meshed as if nothing had been.
TEST(Generate, RefusesAPolygonThatCrossesItself) {
  const std::vector<Corner> crossed = {{{0, 0}, 0}, {{1, 1}, 1}, {{1, 0}, 2}, {{0, 1}, 3}};
  try {
    generate(crossed, [](base::Vec2) { return 0.3; });
    ADD_FAILURE() << "was meshed";
  } catch (const NoMesh& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("Gmsh could not mesh the domain: "));
    std::printf("%s\n", error.what());
  }
  EXPECT_NO_THROW(generate(kBasin, graded));
}

}  // namespace
}  // namespace seapile::mesh
