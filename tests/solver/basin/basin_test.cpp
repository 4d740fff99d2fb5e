// Laws of a basin of water: rest, symmetry, forces, what is not built, and what happens when the mesh cannot follow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/mesh/generate.h"
#include "solver/mesh/inversion.h"
#include "tests/solver/basin/scenes.h"

namespace seapile::basin {
namespace {

base::Vec2 force_on_pile(const Basin& basin) { return basin.tip_force + basin.sleeve_force; }

using support::filled;
using support::run;

double largest_speed(const Basin& basin) {
  double largest = 0;
  for (std::size_t i = 0; i < basin.flow.unknown.size(); ++i)
    if (i % 3 != fluid::kPressure) largest = std::max(largest, std::abs(basin.flow.unknown[i]));
  return largest;
}

TEST(Basin, WaterAtRestStaysAtRestAroundAPile) {
  BasinSpec spec = support::pile_in_water();
  spec.pile->driving = pile::ConstantDriving{0};
  spec.surface->tension = 0.07;
  Basin basin = filled(spec);
  ASSERT_EQ(run(basin, 5), "");
  EXPECT_EQ(largest_speed(basin), 0);
  EXPECT_NEAR(force_on_pile(basin).y, 0, 1e-12);
}

TEST(Basin, WaterThatStandsHigherPressesThePileUp) {
  BasinSpec spec = support::pile_in_water();
  spec.pile->driving = pile::ConstantDriving{0};
  Basin basin = filled(spec);
  constexpr double kHigher = 0.1;
  for (double& h : basin.top.height) h += kHigher;
  place(basin, basin.past_tip.front());
  basin.past = {};
  fluid::remember(basin.past, basin.flow, spec.time.step);
  ASSERT_EQ(run(basin, 1), "");
  const double weight = spec.density * spec.gravity * kHigher * 2 * spec.pile->radius;
  EXPECT_NEAR(force_on_pile(basin).y, weight, 1e-9 * weight);
  EXPECT_NEAR(force_on_pile(basin).x, 0, 1e-9 * weight);
  EXPECT_LT(largest_speed(basin), 1e-9);
}

TEST(Basin, WaterHoldsThePileBackThatEntersIt) {
  Basin basin = filled(support::pile_in_water());
  ASSERT_EQ(run(basin, 20), "");
  EXPECT_GT(force_on_pile(basin).y, 0);
  EXPECT_LT(std::abs(force_on_pile(basin).x), 1e-9 * force_on_pile(basin).y);
}

TEST(Basin, ASymmetricOneStaysItsOwnMirrorImage) {
  BasinSpec waves = support::hump();
  BasinSpec driven = support::pile_in_water();
  driven.mesh.remesh = RemeshSpec{};
  driven.mesh.remesh->share = 0.02;
  for (const BasinSpec& spec : {waves, driven}) {
    Basin basin = filled(spec);
    ASSERT_EQ(run(basin, 200), "");
    const std::size_t count = basin.top.height.size();
    for (std::size_t s = 0; s < count; ++s) EXPECT_NEAR(basin.top.height[s], basin.top.height[count - 1 - s], 1e-10);
  }
}

TEST(Basin, AFixedTopHasNoSurface) {
  BasinSpec spec = support::pile_in_water();
  spec.surface.reset();
  Basin basin = filled(spec);
  ASSERT_EQ(run(basin, 20), "");
  EXPECT_TRUE(basin.flow.open.empty());
  EXPECT_TRUE(basin.flow.film.empty());
  for (const double h : basin.top.height) EXPECT_EQ(h, spec.depth);
  EXPECT_GT(largest_speed(basin), 0.01);  // the water leaves through the top
}

/// A hump as high as the water is deep: what runs up the walls is too sharp for triangles in no order.
BasinSpec sharp(const MotionMethod& motion) {
  BasinSpec spec;
  spec.surface->initial = HumpSurface{0.25, 0.06};
  spec.surface->tension = 0.07;
  spec.mesh.pattern = UnstructuredMesh{0.02, 0.02, 0.15};
  spec.mesh.motion = motion;
  spec.time.step = 5e-4;
  return spec;
}

TEST(Basin, AMeshThatWouldTurnOverIsSeenAndTheLastGoodStateStays) {
  Basin basin = filled(sharp(VerticalMotion{}));
  base::Profile profile;
  std::string why;
  std::vector<double> heights, unknown;
  std::vector<base::Vec2> places;
  while (why.empty() && basin.clock.step < 2000) {
    heights = basin.top.height;
    unknown = basin.flow.unknown;
    places = basin.flow.mesh.position;
    why = step(basin, profile).why;
  }
  EXPECT_NE(why.find("would turn over at x ="), std::string::npos) << why;
  EXPECT_EQ(basin.top.height, heights);
  EXPECT_EQ(basin.flow.unknown, unknown);
  for (std::size_t v = 0; v < places.size(); ++v) EXPECT_EQ(basin.flow.mesh.position[v].y, places[v].y);
  EXPECT_NO_THROW(mesh::check(basin.flow.mesh));
}

TEST(Basin, ASurfaceThatIsTooSharpAtTheStartIsRefused) {
  BasinSpec spec = sharp(EllipticMotion{});
  spec.surface->initial = HumpSurface{-0.2, 0.02};
  EXPECT_THROW(filled(spec), mesh::NoMesh);
}

TEST(Basin, ARisingSurfaceIsBorneLongerByEllipticThanByVerticalMotion) {
  Basin vertical = filled(sharp(VerticalMotion{})), elliptic = filled(sharp(EllipticMotion{}));
  run(vertical, 2000);
  run(elliptic, 2000);
  EXPECT_GT(elliptic.clock.step, vertical.clock.step);
}

TEST(Basin, ARemeshGivesGoodTriangles) {
  BasinSpec spec = support::pile_in_water();
  spec.mesh.remesh = RemeshSpec{};
  spec.mesh.remesh->share = 0.02;
  Basin basin = filled(spec);
  ASSERT_EQ(run(basin, 500), "");  // down and up
  ASSERT_GE(basin.remeshes.size(), 2u);
  for (const RemeshReport& report : basin.remeshes) {
    EXPECT_GE(report.after.lowest_shape, 0.7);
    EXPECT_GT(report.before.small_angles, 0.02);
  }
}

}  // namespace
}  // namespace seapile::basin
