// The water's volume: kept by the conservative update whatever else is asked of the solver, and what the others lose.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/solver/basin/scenes.h"

namespace seapile::basin {
namespace {

using support::filled;
using support::run;
using support::volume;

/// Change of the volume over so many steps, relative.
double drift(const BasinSpec& spec, int steps) {
  Basin basin = filled(spec);
  EXPECT_EQ(run(basin, steps), "");
  return std::abs(volume(basin) / basin.volume_at_start - 1);
}

// Rounding of a few hundred heights, a few hundred times.
constexpr double kKept = 1e-12;

TEST(Volume, IsKeptWhateverTheTolerance) {
  for (const double tolerance : {1e-3, 1e-6, 1e-10}) {
    BasinSpec spec = support::hump();
    spec.time.tolerance = tolerance;
    EXPECT_LT(drift(spec, 200), kKept) << tolerance;
  }
}

TEST(Volume, IsKeptInBothOrdersIteratedOrNot) {
  for (const int order : {1, 2})
    for (const bool iterated : {true, false}) {
      BasinSpec spec = support::hump();
      spec.time.order = order;
      spec.time.iterated = iterated;
      EXPECT_LT(drift(spec, 100), kKept) << order << iterated;
    }
}

TEST(Volume, IsKeptWithAMovingPileThroughRemeshes) {
  BasinSpec spec = support::pile_in_water();
  spec.mesh.remesh = RemeshSpec{};
  spec.mesh.remesh->share = 0.02;
  Basin basin = filled(spec);
  ASSERT_EQ(run(basin, 250), "");  // to the deepest point
  EXPECT_GE(basin.remeshes.size(), 1u);
  EXPECT_LT(std::abs(volume(basin) / basin.volume_at_start - 1), kKept);
}

TEST(Volume, ThePileLiftsTheSurfaceByWhatItDisplaces) {
  Basin basin = filled(support::pile_in_water());
  ASSERT_EQ(run(basin, 250), "");
  // Stroke 0.2/(0.1 pi) [m], over 5 m less the pile's width.
  const double stroke = 0.4 / (2 * M_PI * 0.1), expected = 0.25 * stroke / 4.75;
  double area = 0;
  for (std::size_t s = 0; s + 1 < basin.top.x.size(); ++s)
    if (basin.top.gap != s)
      area += 0.5 * (basin.top.x[s + 1] - basin.top.x[s]) *
              (basin.top.height[s] + basin.top.height[s + 1] - 2 * basin.spec.depth);
  EXPECT_NEAR(area / 4.75, expected, 1e-12);
  EXPECT_NEAR(expected, 0.0335, 1e-4);  // physics section 3.4
}

TEST(Volume, TheCorrectionKeepsWhatTheKinematicConditionLoses) {
  for (const SurfaceScheme scheme : {SurfaceScheme::upwinded, SurfaceScheme::galerkin})
    for (const bool iterated : {true, false}) {
      BasinSpec spec = support::hump();
      spec.surface->scheme = scheme;
      spec.time.iterated = iterated;
      spec.time.tolerance = 1e-4;
      EXPECT_GT(drift(spec, 100), 1e-7);
      spec.surface->volume_correction = true;
      EXPECT_LT(drift(spec, 100), kKept);
    }
}

TEST(Volume, TheCorrectionAimsAtWhatThePileDisplaces) {
  for (const SurfaceScheme scheme : {SurfaceScheme::upwinded, SurfaceScheme::galerkin})
    for (const int order : {1, 2}) {
      BasinSpec spec = support::pile_in_water();
      spec.surface->scheme = scheme;
      spec.surface->volume_correction = true;
      spec.time.order = order;
      EXPECT_LT(drift(spec, 100), kKept) << order;
    }
}

TEST(SurfaceFlux, WhatVerticesHandUpIsAllOfIt) {
  const Basin basin = filled(support::pile_in_water());
  std::vector<double> defect(basin.flow.mesh.vertices());
  double sum = 0;
  for (std::size_t v = 0; v < defect.size(); ++v) sum += defect[v] = std::sin(static_cast<double>(v));
  double handed = 0;
  for (const double value : handed_up(basin.domain.under, defect, basin.top.x.size())) handed += value;
  EXPECT_NEAR(handed, sum, 1e-12);
}

TEST(SurfaceFlux, ItsSumIsTheFluxThroughTheSurface) {
  const Basin basin = filled(support::hump());
  std::vector<base::Vec2> velocity(basin.flow.mesh.vertices());
  for (std::size_t v = 0; v < velocity.size(); ++v)
    velocity[v] = {std::sin(static_cast<double>(v)), std::cos(static_cast<double>(v))};
  double sum = 0;
  for (const double flux : kinematic_flux(basin.top, velocity)) sum += flux;
  EXPECT_NEAR(sum, fluid::flux_through(basin.top, fluid::Geometry::planar, velocity), 1e-13);
}

}  // namespace
}  // namespace seapile::basin
