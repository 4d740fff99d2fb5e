// Laws of the free surface by itself: how a height moves with given velocities, and its curvature.
#include "solver/fluid/free_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "solver/mesh/rectangle.h"

namespace seapile::fluid {
namespace {

/// A surface of `cells` edges over [0, length] with the height of `h`; no mesh hangs on it.
FreeSurface surface_of(double length, int cells, const auto& h) {
  FreeSurface surface;
  surface.x = mesh::even(0, length, cells);
  for (int s = 0; s <= cells; ++s) {
    surface.vertex.push_back(s);
    surface.height.push_back(h(surface.x[s]));
  }
  return surface;
}

/// Moves the surface with one velocity for steps * dt.
void move(FreeSurface& surface, base::Vec2 velocity, double dt, int steps) {
  const std::vector<base::Vec2> v(surface.vertex.size(), velocity);
  std::vector<double> older;
  for (int k = 0; k < steps; ++k) {
    std::vector<SurfaceLevel> past{{v, surface.height}};
    if (!older.empty()) past.push_back({v, older});
    older = surface.height;
    surface.height = advanced_height(surface, past, dt, 0);
  }
}

double bump(double x) { return 1 + 0.1 * std::exp(-20 * (x - 1) * (x - 1)); }

double error_after_moving(int cells, KinematicScheme scheme, int steps) {
  FreeSurface surface = surface_of(4, cells, bump);
  surface.scheme = scheme;
  move(surface, {1, 0}, 1.0 / steps, steps);
  double square = 0;
  for (std::size_t s = 0; s < surface.x.size(); ++s) square += std::pow(surface.height[s] - bump(surface.x[s] - 1), 2);
  return std::sqrt(square / static_cast<double>(cells));
}

TEST(FreeSurface, AnUpwindedSurfaceIsCarriedAlongToSecondOrder) {
  const double coarse = error_after_moving(100, KinematicScheme::upwinded, 100);
  const double fine = error_after_moving(200, KinematicScheme::upwinded, 200);
  // The first of BDF2's steps is Euler's, whose one error of dt^2 keeps the order.
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << " " << fine;
}

TEST(FreeSurface, DifferencesFromTheLeftAreOfFirstOrder) {
  // At half the largest stable step: at the whole one they are exact.
  const double coarse = error_after_moving(200, KinematicScheme::differences, 100);
  const double fine = error_after_moving(400, KinematicScheme::differences, 200);
  EXPECT_NEAR(std::log2(coarse / fine), 1, 0.25) << coarse << " " << fine;
}

TEST(FreeSurface, ExplicitGalerkinGrowsWhereTheUpwindedSchemeDecays) {
  // |G|^2 = 1 + CFL^2 sin^2 for forward Euler with centred terms: grid waves of the bump grow; implicit upwinding damps
  // them.
  const auto largest = [](KinematicScheme scheme) {
    FreeSurface surface = surface_of(4, 200, bump);
    surface.scheme = scheme;
    move(surface, {1, 0}, 0.01, 200);
    double top = 0;
    for (const double h : surface.height) top = std::max(top, std::abs(h - 1));
    return top;
  };
  EXPECT_LT(largest(KinematicScheme::upwinded), 0.1);
  EXPECT_GT(largest(KinematicScheme::galerkin), 0.13);
}

TEST(FreeSurface, ARisingFluidLiftsTheSurfaceByAllSchemes) {
  for (const KinematicScheme scheme :
       {KinematicScheme::upwinded, KinematicScheme::galerkin, KinematicScheme::differences}) {
    FreeSurface surface = surface_of(1, 10, [](double) { return 1; });
    surface.scheme = scheme;
    move(surface, {0, 0.5}, 0.1, 4);
    for (const double h : surface.height) EXPECT_NEAR(h, 1.2, 1e-12);
  }
}

TEST(FreeSurface, APinnedLipStays) {
  for (const KinematicScheme scheme :
       {KinematicScheme::upwinded, KinematicScheme::galerkin, KinematicScheme::differences}) {
    FreeSurface surface = surface_of(1, 10, [](double) { return 1; });
    surface.scheme = scheme;
    surface.pinned = true;
    move(surface, {0.1, 0.5}, 0.01, 10);
    EXPECT_EQ(surface.height[0], 1);
    EXPECT_GT(surface.height[10], 1);
  }
}

TEST(FreeSurface, AnArchOfACircleHasItsCurvature) {
  // A circle of radius 2 over [-1, 1]: kappa = -1/2. Linear elements: the error of the edge's angles is of second
  // order.
  const auto error = [](int cells) {
    FreeSurface surface = surface_of(2, cells, [](double x) { return std::sqrt(4 - (x - 1) * (x - 1)); });
    const std::vector<double> kappa = curvature(surface, Geometry::planar);
    double largest = 0;
    for (int s = cells / 4; s <= 3 * cells / 4; ++s) largest = std::max(largest, std::abs(kappa[s] + 0.5));
    return largest;
  };
  EXPECT_LT(error(40), 5e-4);
  EXPECT_GT(std::log2(error(40) / error(80)), 1.8);
}

TEST(FreeSurface, ARoundJetHasTheCurvatureOfItsRadius) {
  FreeSurface surface = surface_of(2, 20, [](double) { return 0.8; });
  for (const double kappa : curvature(surface, Geometry::axisymmetric)) EXPECT_NEAR(kappa, -1 / 0.8, 1e-12);
}

TEST(FreeSurface, EndsAtRightAnglesPullASlopedSurfaceFlat) {
  FreeSurface surface = surface_of(1, 20, [](double x) { return 1 + 0.2 * x; });
  for (const double kappa : curvature(surface, Geometry::planar)) EXPECT_NEAR(kappa, 0, 1e-12);
  surface.right_angles = true;
  const std::vector<double> kappa = curvature(surface, Geometry::planar);
  EXPECT_GT(kappa.front(), 1);
  EXPECT_LT(kappa.back(), -1);
}

TEST(FreeSurface, WhatIsNoGraphIsTold) {
  FreeSurface surface = surface_of(1, 10, [](double) { return 1; });
  EXPECT_EQ(objection(surface).why, "");
  surface.height[4] = 2.1;
  EXPECT_THAT(objection(surface).why, testing::HasSubstr("too steep to be a graph at x = 0.4"));
  surface.height[4] = -0.1;
  EXPECT_THAT(objection(surface).why, testing::HasSubstr("bottom at x = 0.4"));
  surface.height[4] = std::nan("");
  EXPECT_THAT(objection(surface).why, testing::HasSubstr("not finite at x = 0.4"));
}

}  // namespace
}  // namespace seapile::fluid
