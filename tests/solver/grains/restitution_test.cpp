// Impacts in closed form are in tests/verification.
#include "solver/grains/restitution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/contact_scene.h"

namespace seapile::grains {
namespace {

using support::ContactScene;

template <class Real>
struct Restitution : testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(Restitution, Reals);

TYPED_TEST(Restitution, ABouncingDiscComesToRest) {
  ContactScene<TypeParam> scene({{0, 0.07, 0.02, 0}});
  scene.law.restitution = 0.5;
  scene.run(1.5);
  scene.totals.base = {};
  scene.run(0.5);
  EXPECT_NEAR(-scene.totals.base.y / 0.5, scene.weight(), 1e-3 * scene.weight());
  EXPECT_NEAR(scene.velocity(0).y, 0, 1e-4);
}

// A grain that a body hits flies off with (1 + e) times the body's speed; both directions of the sum of impulses agree.
TYPED_TEST(Restitution, AGrainHitByADrivenBodyLeavesWithETimesTheSpeedOfApproach) {
  ContactScene<TypeParam> scene({{0, 0, 0.02, 0}});
  scene.box.base = -support::kFar;
  scene.law.gravity = 0;
  scene.law.restitution = 0.5;
  RigidBody plate;
  plate.outline = {{{-1, 1}, {-1, 0}, 1}, {{-1, 0}, {1, 0}, 0}, {{1, 0}, {1, 1}, 1}};
  plate.position = {0, 0.03};
  scene.body = plate;
  scene.body_speed = 0.4;
  scene.run(0.05);
  EXPECT_NEAR(scene.velocity(0).y, -1.5 * 0.4, 0.02 * 0.4);
  const double momentum = scene.grains.mass[0] * scene.velocity(0).y;
  EXPECT_NEAR(scene.totals.feature[0].y, -momentum, 1e-6 * std::abs(momentum));
  // The body's work is its speed times the impulse; what is not kinetic energy was dissipated.
  EXPECT_NEAR(scene.totals.body_work, -0.4 * momentum, 1e-6 * 0.4 * std::abs(momentum));
  EXPECT_NEAR(scene.totals.dissipation, scene.totals.body_work - scene.kinetic_energy(), 1e-6 * scene.kinetic_energy());
}

}  // namespace
}  // namespace seapile::grains
