// Triangles that turn over on their way.
#include "solver/mesh/inversion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "solver/base/random.h"
#include "solver/mesh/rectangle.h"

namespace seapile::mesh {
namespace {

using Places = std::vector<base::Vec2>;
const Places kUnit = {{0, 0}, {1, 0}, {0, 1}};

std::optional<Inversion> of(const Places& from, const Places& to) {
  return first_inversion({from, {{0, 1, 2}}, {}}, from, to);
}

double area_at(const TriangleMesh& mesh, std::size_t t, const Places& from, const Places& to, double s) {
  Places p;
  for (const std::int32_t v : mesh.triangle[t]) p.push_back((1 - s) * from[v] + s * to[v]);
  return doubled_area(p[0], p[1], p[2]);
}

TEST(Inversion, IsAbsentWhereNothingMovesOrAllMovesAlike) {
  EXPECT_FALSE(of(kUnit, kUnit));
  EXPECT_FALSE(of(kUnit, {{7, -3}, {8, -3}, {7, -2}}));
  EXPECT_FALSE(of(kUnit, {{0, 0}, {1e-3, 0}, {0, 1e-3}}));  // Shrinks.
}

TEST(Inversion, OfAnUprightMoveIsWhereTheHeightIsZero) {
  for (const double down : {1.25, 2.0, 1000.0})
    EXPECT_DOUBLE_EQ(of(kUnit, {{0, 0}, {1, 0}, {0, 1 - down}})->at, 1 / down);
  EXPECT_FALSE(of(kUnit, {{0, 0}, {1, 0}, {0, 1e-12}}));
  EXPECT_EQ(of(kUnit, {{0, 0}, {1, 0}, {0, 0}})->at, 1);  // Flat at the end.
}

// Two vertices change places through each other and one goes to the other side: the end turns counterclockwise again.
TEST(Inversion, IsFoundWhenTheEndIsValidAgain) {
  const Places turned = {{0, 0}, {-1, 0}, {0, -1}};  // By half a turn: all edges shrink to nothing at s = 1/2.
  EXPECT_EQ(of(kUnit, turned)->at, 0.5);
  // b goes from (1, 0) to (-1, 0.5), c from (0, 1) to (-0.5, -1): 2 A = (1 - 2s)(1 - 2s) + s^2/4 > 0.
  EXPECT_FALSE(of(kUnit, {{0, 0}, {-1, 0.5}, {-0.5, -1}}));
  // With b to (-1, -0.5) the last sign turns: 2 A = (1 - 2s)^2 - s^2/4, zero at s = 2/5.
  const Places through = {{0, 0}, {-1, -0.5}, {-0.5, -1}};
  EXPECT_GT(doubled_area(through[0], through[1], through[2]), 0);
  EXPECT_DOUBLE_EQ(of(kUnit, through)->at, 0.4);
}

// The area is zero at its lowest: 2 A = (1 - 2s)^2, exactly.
TEST(Inversion, IsFoundWhereTheAreaTouchesZero) { EXPECT_EQ(of(kUnit, {{0, 0}, {-1, 0}, {3, -1}})->at, 0.5); }

// c2 is 1e-18 of the others: the textbook's formula divides zero by zero.
TEST(Inversion, KeepsItsDigitsWhenTheWayIsAlmostLinear) {
  EXPECT_NEAR(of(kUnit, {{0, 0}, {1 + 1e-15, 0}, {0, -1}})->at, 0.5, 1e-15);
  EXPECT_NEAR(of(kUnit, {{0, 0}, {1 - 1e-15, 0}, {0, -1}})->at, 0.5, 1e-15);
  EXPECT_NEAR(of(kUnit, {{0, 0}, {1e9, 0}, {0, -1}})->at, 0.5, 1e-15);
}

TEST(Inversion, OfARandomWayIsTheFirstZeroOfTheArea) {
  int found = 0, valid_at_the_end = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Places to;
    for (std::uint32_t v = 0; v < 3; ++v) to.push_back({base::uniform(-2, 2, v, 0, i), base::uniform(-2, 2, v, 1, i)});
    const TriangleMesh mesh{kUnit, {{0, 1, 2}}, {}};
    const auto inversion = of(kUnit, to);
    const double until = inversion ? inversion->at : 1;
    for (int k = 0; k <= 1000; ++k) {
      const double s = 0.001 * k;
      if (s >= until - 1e-12) break;
      ASSERT_GT(area_at(mesh, 0, kUnit, to, s), 0) << i;
    }
    if (!inversion) continue;
    ++found;
    valid_at_the_end += doubled_area(to[0], to[1], to[2]) > 0;
    EXPECT_NEAR(area_at(mesh, 0, kUnit, to, until), 0, 1e-14);
  }
  std::printf("of 2000 ways %d turn over, of these %d are valid at their end\n", found, valid_at_the_end);
  EXPECT_GT(found, 1000);
  EXPECT_GT(valid_at_the_end, 100);
}

TEST(Inversion, OfAMeshIsItsFirstAndOfEqualsTheLowest) {
  const TriangleMesh mesh = rectangle(even(0, 4, 4), even(0, 1, 1));
  Places to = mesh.position;
  for (const int i : {1, 2}) to[i].y = 2;  // Through the top at half the way.
  to[3].y = 1.6;                           // A little later.
  const auto inversion = first_inversion(mesh, mesh.position, to);
  ASSERT_TRUE(inversion);
  EXPECT_EQ(inversion->at, 0.5);
  EXPECT_TRUE(std::ranges::count(mesh.triangle[inversion->triangle], 1) == 1);
  for (std::int32_t t = 0; t < inversion->triangle; ++t) EXPECT_GT(area_at(mesh, t, mesh.position, to, 0.5), 1e-3);
}

TEST(Inversion, IsAtZeroWhereNothingIsValidFromTheStart) {
  EXPECT_EQ(of({{0, 0}, {0, 1}, {1, 0}}, kUnit)->at, 0);  // Clockwise.
  for (const double nowhere : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(of(kUnit, {{0, 0}, {1, 0}, {nowhere, 1}})->at, 0);
    EXPECT_EQ(of(kUnit, {{0, 0}, {1, 0}, {0, nowhere}})->at, 0);
    EXPECT_EQ(of({{0, nowhere}, {1, 0}, {0, 1}}, kUnit)->at, 0);
  }
}

TEST(Inversion, RefusesPlacesThatAreNotTheMeshs) {
  const TriangleMesh mesh{kUnit, {{0, 1, 2}}, {}};
  EXPECT_THROW(first_inversion(mesh, kUnit, Places(2)), std::logic_error);
  EXPECT_THROW(first_inversion(mesh, Places(4), kUnit), std::logic_error);
}

}  // namespace
}  // namespace seapile::mesh
