#include "solver/coupling/disc_in_triangle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace seapile::coupling {
namespace {

constexpr double kPi = std::numbers::pi;

void expect_moments(const Moments& m, double area, base::Vec2 first) {
  EXPECT_NEAR(m.area, area, 1e-14);
  EXPECT_NEAR(m.first.x, first.x, 1e-14);
  EXPECT_NEAR(m.first.y, first.y, 1e-14);
}

TEST(DiscInTriangle, SmallDiscsAndSmallTrianglesAreWhole) {
  expect_moments(disc_in_triangle(1, {-9, -9}, {9, -9}, {0, 9}), kPi, {0, 0});
  expect_moments(disc_in_triangle(1, {0.1, 0.1}, {0.4, 0.1}, {0.1, 0.3}), 0.03, {0.03 * 0.2, 0.03 * 0.5 / 3});
  expect_moments(disc_in_triangle(1, {2, -9}, {9, -9}, {2, 9}), 0, {0, 0});
}

TEST(DiscInTriangle, WedgesFromTheCentreAreSectors) {
  // The first moment of a sector of angle w is 2/3 r^3 sin(w/2) along its middle.
  for (const double w : {1e-3, 0.5, 1.0, 2.0, 3.0}) {
    const double far = 5 / std::cos(w / 2);
    const base::Vec2 a = {far * std::cos(w / 2), -far * std::sin(w / 2)}, b = {a.x, -a.y};
    expect_moments(disc_in_triangle(1, {0, 0}, a, b), w / 2, {2.0 / 3 * std::sin(w / 2), 0});
  }
}

TEST(DiscInTriangle, ALineThroughTheDiscLeavesASegment) {
  for (const double h : {-0.999, -0.5, 0.0, 0.3, 1 - 1e-9}) {
    const double w = std::sqrt((1 - h) * (1 + h));
    const Moments m = disc_in_triangle(1, {-30, h}, {30, h}, {0, 40});
    expect_moments(m, std::acos(h) - h * w, {0, 2.0 / 3 * w * w * w});
    if (h >= 0) {
      EXPECT_NEAR(beyond_line(1, h), m.first.y - h * m.area, 1e-14);
    }
  }
  EXPECT_EQ(beyond_line(2, 1), 0);
  EXPECT_NEAR(beyond_line(2, 0), 16.0 / 3, 1e-14);
}

TEST(DiscInTriangle, TouchingIsNoOverlap) {
  EXPECT_NEAR(disc_in_triangle(1, {-3, 1}, {3, 1}, {0, 4}).area, 0, 1e-15);       // an edge
  EXPECT_NEAR(disc_in_triangle(1, {0, 1}, {3, 4}, {-3, 4}).area, 0, 1e-15);       // a vertex
  EXPECT_NEAR(disc_in_triangle(1, {-4, -1}, {4, -1}, {0, 99}).area, kPi, 1e-14);  // an edge from inside
  EXPECT_NEAR(disc_in_triangle(1, {-1, 0}, {1, 0}, {0, 1}).area, 1, 1e-15);       // inscribed
  EXPECT_NEAR(disc_in_triangle(1, {0, 0}, {1, 0}, {0, 1}).area, 0.5, 1e-15);      // both at once
}

}  // namespace
}  // namespace seapile::coupling
