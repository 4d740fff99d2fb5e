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

// Head on, without gravity: the relative speed after is e times that before. 2 % cover the remaining softness.
TYPED_TEST(Restitution, TwoDiscsPartWithETimesTheirSpeedOfApproach) {
  for (const double e : {0.5, 1.0})
    for (const double speed : {0.05, 1.5, 8.0}) {
      ContactScene<TypeParam> scene({{-0.03, 1, 0.02, 0}, {0.03, 1.005, 0.03, 0}});
      scene.law.gravity = 0;
      scene.law.friction_grain = 0;
      scene.law.restitution = e;
      scene.set_velocity(0, {speed, 0});
      const base::Vec2 before = scene.momentum();
      scene.run(0.04 / speed);
      // The line of centres at contact: heights differ by 0.005 over a distance of 0.05.
      const base::Vec2 n{std::sqrt(1 - 0.01), 0.1}, w = scene.velocity(1) - scene.velocity(0);
      EXPECT_NEAR(dot(n, w), e * speed * n.x, 0.02 * e * speed) << "e " << e << ", speed " << speed;
      EXPECT_NEAR(norm(scene.momentum() - before), 0, 1e-5 * norm(before));
    }
}

TYPED_TEST(Restitution, AtOneTheEnergyOfAnImpactStays) {
  ContactScene<TypeParam> scene({{-0.03, 1, 0.02, 0}, {0.03, 1, 0.02, 0}});
  scene.law.gravity = 0;
  scene.law.restitution = 1;
  scene.set_velocity(0, {1, 0});
  const double energy = scene.kinetic_energy();
  scene.run(0.1);
  EXPECT_NEAR(scene.kinetic_energy(), energy, 0.02 * energy);
  // Equal discs exchange their velocities.
  EXPECT_NEAR(scene.velocity(1).x, 1, 0.02);
}

// Dropped from H, a disc rises to e^2 H; the height of rebound has twice the relative error of the speed.
TYPED_TEST(Restitution, ADroppedDiscRisesToESquaredOfItsHeight) {
  for (const double e : {0.5, 0.9}) {
    constexpr double kRadius = 0.02, kDrop = 0.2;
    ContactScene<TypeParam> scene({{0, kRadius + kDrop, kRadius, 0}});
    scene.law.restitution = e;
    const double fall = std::sqrt(2 * kDrop / scene.law.gravity);
    scene.run(fall + 0.005);
    double top = 0;
    for (int k = 0; k < static_cast<int>(e * fall / scene.law.step); ++k) {
      scene.step();
      top = std::max(top, scene.disc(0).y - kRadius);
    }
    EXPECT_NEAR(top, e * e * kDrop, 0.04 * e * e * kDrop) << "e " << e;
  }
}

TYPED_TEST(Restitution, ABouncingDiscComesToRest) {
  ContactScene<TypeParam> scene({{0, 0.07, 0.02, 0}});
  scene.law.restitution = 0.5;
  scene.run(1.5);
  scene.totals.base = {};
  scene.run(0.5);
  EXPECT_NEAR(-scene.totals.base.y / 0.5, scene.weight(), 1e-3 * scene.weight());
  EXPECT_NEAR(scene.velocity(0).y, 0, 1e-4);
}

// Oblique impact on the base (Chung and Ooi 2011, test 4, for discs): sliding throughout where tan >= 3 mu (1 + e),
// then the tangential velocity falls by mu (1 + e) v_n; otherwise the disc leaves rolling with 2/3 of it.
TYPED_TEST(Restitution, AnObliqueImpactSlidesOrRolls) {
  constexpr double kMu = 0.1, kE = 0.8, kNormal = 2;
  for (const double tangential : {0.3, 0.5, 0.6, 1.5}) {
    ContactScene<TypeParam> scene({{0, 0.05, 0.02, 0}});
    scene.law.gravity = 0;
    scene.law.friction_wall = kMu;
    scene.law.restitution = kE;
    scene.set_velocity(0, {tangential, -kNormal});
    scene.run(0.03);
    const bool slides = tangential >= 3 * kMu * (1 + kE) * kNormal;
    const double expected = slides ? tangential - kMu * (1 + kE) * kNormal : 2.0 / 3 * tangential;
    EXPECT_NEAR(scene.velocity(0).y, kE * kNormal, 0.02 * kE * kNormal);
    EXPECT_NEAR(scene.velocity(0).x, expected, 0.02 * tangential) << tangential;
    EXPECT_NEAR(-scene.spin(0) * 0.02, slides ? 2 * kMu * (1 + kE) * kNormal : expected, 0.03 * tangential)
        << tangential;
  }
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
