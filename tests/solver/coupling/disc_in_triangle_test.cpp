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

TEST(DiscInTriangle, WhatLiesBeyondALineIsExactUpToTouching) {
  // 2/3 s^3 - x (acos x - x s), in long double where it does not cancel, and by its series (1 - x)^2.5 8 sqrt(2)/15 (1
  // - 3/28 (1 - x) + ...) where it does.
  for (int k = 0; k <= 1000; ++k) {
    const double x = k / 1000.0 * 0.99;
    const long double s = std::sqrt((1 - static_cast<long double>(x)) * (1 + static_cast<long double>(x))),
                      exact = 2 * s * s * s / 3 - x * (std::acos(static_cast<long double>(x)) - x * s);
    EXPECT_NEAR(beyond_line(1, x) / static_cast<double>(exact), 1, x < 0.9 ? 1e-15 : 2e-13) << x;
  }
  for (const double u : {1e-12, 1e-7, 1e-4})
    EXPECT_NEAR(beyond_line(1, 1 - u) / (std::pow(1 - (1 - u), 2.5) * 8 * std::sqrt(2.0) / 15 * (1 - 3.0 / 28 * u)), 1,
                1e-9);
}

TEST(DiscInTriangle, WhatLiesBeyondARayIsAWedge) {
  for (const double away : {0.0, 1e-9, 0.3, 0.8, 1.0})
    for (const double angle : {0.0, 1e-7, 0.4, 1.5, kPi / 2, 2.0, 3.1}) {
      const base::Vec2 vertex = {away, 0}, ray = {std::cos(angle), std::sin(angle)}, across = {ray.y, -ray.x};
      const Moments m = disc_in_triangle(1, vertex, {60, 0}, vertex + 60 * ray);
      EXPECT_NEAR(beyond_ray(1, away, ray.x, ray.y), dot(across, m.first) - m.area * dot(across, vertex), 1e-14)
          << away << " " << angle;
    }
  EXPECT_NEAR(beyond_ray(2, 0.5, -1, 0), 8 * beyond_line(1, 0), 1e-14);  // to the centre: half the disc
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
