// Shapes and angles of triangles, and when a mesh is worth replacing.
#include "solver/mesh/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/base/random.h"

namespace seapile::mesh {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// q and smallest angle [rad] of one triangle.
std::pair<double, double> of(base::Vec2 a, base::Vec2 b, base::Vec2 c) {
  const Quality quality = quality_of({{a, b, c}, {{0, 1, 2}}, {}});
  return {quality.shape.at(0), quality.smallest_angle.at(0)};
}

/// A hundred triangles of which `bad` have shape q and smallest angle `angle`; the others are equilateral.
Quality hundred(int bad, double q, double angle) {
  Quality quality{std::vector<double>(100, 1.0), std::vector<double>(100, 60 * kDegree)};
  std::fill_n(quality.shape.begin(), bad, q);
  std::fill_n(quality.smallest_angle.begin(), bad, angle);
  return quality;
}

TEST(Quality, OfEqualEdgesIsOne) {
  const auto [q, angle] = of({0.1, 0.2}, {2.1, 0.2}, {1.1, 0.2 + std::sqrt(3)});
  EXPECT_NEAR(q, 1, 1e-15);
  EXPECT_NEAR(angle, 60 * kDegree, 1e-15);
}

TEST(Quality, OfHalfASquareIsRootThreeOverTwo) {
  for (const double size : {1e-150, 1e-9, 1.0, 1e150}) {
    const auto [q, angle] = of({0, 0}, {size, 0}, {0, size});
    EXPECT_NEAR(q, std::sqrt(3) / 2, 1e-15);
    EXPECT_NEAR(angle, 45 * kDegree, 1e-15);
  }
}

TEST(Quality, DoesNotDependOnTheFirstVertexOrTheTurn) {
  const base::Vec2 a{0, 0}, b{3, 0}, c{0, 4};  // Edges 3, 4, 5.
  for (const auto& [q, angle] : {of(a, b, c), of(b, c, a), of(c, a, b), of({0, 0}, {0, 3}, {-4, 0})}) {
    EXPECT_NEAR(q, 4 * std::sqrt(3) * 6 / 50, 1e-15);
    EXPECT_NEAR(angle, std::asin(0.6), 1e-15);
  }
}

TEST(Quality, OfAFlatTriangleIsZero) {
  EXPECT_EQ(of({0, 0}, {1, 0}, {3, 0}), std::pair(0.0, 0.0));
  EXPECT_EQ(of({0, 0}, {1, 0}, {1, 0}), std::pair(0.0, 0.0));
  EXPECT_EQ(of({1, 1}, {1, 1}, {1, 1}), std::pair(0.0, 0.0));
}

TEST(Quality, OfAVertexAtNoFinitePlaceIsZero) {
  for (const double nowhere : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(of({0, 0}, {1, nowhere}, {3, 0}), std::pair(0.0, 0.0));
}

// An arc cosine would lose half the digits here.
TEST(Quality, KeepsTheDigitsOfAVerySmallAngle) {
  EXPECT_NEAR(of({0, 0}, {1, 0}, {1, 1e-9}).second / 1e-9, 1, 1e-15);
  EXPECT_NEAR(of({0, 0}, {1, 0}, {0.5, 1e-9}).second / 2e-9, 1, 1e-15);
}

TEST(Quality, OfATriangleThatTurnsClockwiseIsNegative) {
  const auto [q, angle] = of({0, 0}, {1, std::sqrt(3)}, {2, 0});
  EXPECT_NEAR(q, -1, 1e-15);
  EXPECT_NEAR(angle, -60 * kDegree, 1e-15);
}

TEST(Quality, IsSummedUpByTheLowestAndByShares) {
  const QualitySummary summary = summary_of({{1, 0.4, 0.6, 0.49, 0.9}, {1, 0.5, 0.9, 0.2, 0.6}});
  EXPECT_EQ(summary.lowest_shape, 0.4);
  EXPECT_EQ(summary.smallest_angle, 0.2);
  EXPECT_EQ(summary.below_half, 0.4);
  EXPECT_EQ(summary.small_angles, 0.4);  // 0.5 and 0.2 lie below 30 degrees = 0.524.
}

// Thesis 4.3.
TEST(RemeshRule, AsksFromFivePercentOfTrianglesWithAnAngleBelowThirtyDegrees) {
  EXPECT_FALSE(asks_for_new_mesh({}, hundred(0, 0, 0)));
  EXPECT_FALSE(asks_for_new_mesh({}, hundred(4, 0.6, 29 * kDegree)));
  EXPECT_TRUE(asks_for_new_mesh({}, hundred(5, 0.6, 29 * kDegree)));
  EXPECT_FALSE(asks_for_new_mesh({}, hundred(100, 0.6, 31 * kDegree)));
}

TEST(RemeshRule, AsksForOneShapeThatIsTooBad) {
  EXPECT_FALSE(asks_for_new_mesh({}, hundred(1, 0.31, 15 * kDegree)));
  EXPECT_TRUE(asks_for_new_mesh({}, hundred(1, 0.29, 15 * kDegree)));
  EXPECT_TRUE(asks_for_new_mesh({}, hundred(1, -1, -60 * kDegree)));
}

TEST(RemeshRule, FollowsItsOwnLimits) {
  EXPECT_TRUE(asks_for_new_mesh({.angle = 40 * kDegree}, hundred(5, 0.8, 39 * kDegree)));
  EXPECT_TRUE(asks_for_new_mesh({.share = 0.01}, hundred(1, 0.6, 29 * kDegree)));
  EXPECT_TRUE(asks_for_new_mesh({.shape = 0.7}, hundred(1, 0.6, 31 * kDegree)));
}

TEST(RemeshRule, OfAMeshIsThatOfItsQuality) {
  // Meshes of loose triangles, from good ones to such that are flat, turn over or are nowhere.
  int asked = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    TriangleMesh mesh;
    const double spread = base::uniform(0, 1.2, seed, 0, 0);
    for (int t = 0; t < 60; ++t) {
      const double turned = base::uniform(0, 7, seed, 1, t), size = base::uniform(0.01, 1, seed, 2, t);
      for (int k = 0; k < 3; ++k) {
        const double angle = turned + 2 * std::numbers::pi / 3 * k,
                     x = base::uniform(-spread, spread, seed, 3, 3 * t + k),
                     y = base::uniform(-spread, spread, seed, 4, 3 * t + k);
        mesh.position.push_back(size * base::Vec2{std::cos(angle) + x, std::sin(angle) + y});
      }
      mesh.triangle.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    if (seed % 50 == 7) mesh.position[5].x = std::numeric_limits<double>::quiet_NaN();
    if (seed % 50 == 8) mesh.position[4] = mesh.position[3];
    for (const double angle : {15 * kDegree, 30 * kDegree, 50 * kDegree})
      for (const double share : {0.0, 0.05, 0.3, 1.0})
        for (const double shape : {-2.0, 0.0, 0.3}) {
          const bool asks = asks_for_new_mesh({angle, share, shape}, mesh);
          EXPECT_EQ(asks, asks_for_new_mesh({angle, share, shape}, quality_of(mesh))) << seed << " " << angle;
          asked += asks;
        }
  }
  EXPECT_GT(asked, 400 * 36 / 10);
  EXPECT_LT(asked, 400 * 36 * 9 / 10);
}

}  // namespace
}  // namespace seapile::mesh
