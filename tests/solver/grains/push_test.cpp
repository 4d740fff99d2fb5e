// Forces on single grains from outside the contacts: they act in every sub-step, as gravity does, and nothing that is
// said of gravity stops being true of both together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "tests/support/contact_scene.h"

namespace seapile::grains {
namespace {

using support::ContactScene;
using support::random_push;

template <class Solver>
struct Push : testing::Test {
  static constexpr double kRounding = std::numeric_limits<typename ContactScene<Solver>::Real>::epsilon();
};
using Solvers = testing::Types<float, double, AllPairs>;
TYPED_TEST_SUITE(Push, Solvers);

/// By both methods, the non-smooth one with the steps that it needs.
std::vector<ContactLaw> both_methods(ContactLaw law) {
  ContactLaw rigid = law;
  rigid.step = 1e-4;
  rigid.nonsmooth = {500, 1e-12, 1e-3};
  return {law, rigid};
}

/// What a push, gravity and contacts leave of the energy; constant (energy_test.cpp).
template <class Solver>
double balance(const ContactScene<Solver>& scene) {
  const double half = 0.5 * scene.law.step / substeps(scene.law);
  const double potential = scene.potential_energy() - half * scene.law.gravity * scene.momentum().y;
  return scene.kinetic_energy() + potential + scene.totals.dissipation - scene.totals.body_work -
         scene.totals.push_work;
}

/// A wedge that is driven down in the middle of the box.
RigidBody wedge(double height, double middle) {
  RigidBody body;
  body.outline = {{{-0.05, 1}, {-0.05, 0.08}, 1},
                  {{-0.05, 0.08}, {0, 0}, 0},
                  {{0, 0}, {0.05, 0.08}, 0},
                  {{0.05, 0.08}, {0.05, 1}, 1}};
  body.position = {middle, height};
  body.friction = 0.5;
  return body;
}

// n sub-steps h of v <- v + h a, x <- x + h v: x = x0 + n h v0 + n (n + 1) / 2 h^2 a.
TYPED_TEST(Push, AFreeGrainFollowsItsParabola) {
  const base::Vec2 push{3, 14}, v0{-1, 2};
  for (const ContactLaw& law : both_methods({})) {
    ContactScene<TypeParam> scene({{0, 5, 0.02, 0}, {1, 5, 0.02, 0}});
    scene.law = law;
    scene.grains.push = {push, {}};
    scene.set_velocity(0, v0);
    constexpr int kSteps = 200;
    scene.steps(kSteps);
    const double n = kSteps * substeps(law), h = law.step / substeps(law);
    const base::Vec2 a = push + base::Vec2{0, -law.gravity};
    const double tolerance = n * 3 * TestFixture::kRounding;  // each sub-step rounds speeds below 3 m/s once
    EXPECT_NEAR(scene.velocity(0).x, v0.x + n * h * a.x, tolerance);
    EXPECT_NEAR(scene.velocity(0).y, v0.y + n * h * a.y, tolerance);
    EXPECT_NEAR(scene.disc(0).x, n * h * v0.x + 0.5 * n * (n + 1) * h * h * a.x, tolerance);
    EXPECT_NEAR(scene.disc(0).y, 5 + n * h * v0.y + 0.5 * n * (n + 1) * h * h * a.y, tolerance);
    EXPECT_NEAR(scene.disc(1).y, 5 - 0.5 * n * (n + 1) * h * h * law.gravity, tolerance) << "the other has none";
    EXPECT_EQ(scene.spin(0), 0);
  }
}

TYPED_TEST(Push, AgainstGravityItLeavesAGrainAtRest) {
  for (const ContactLaw& law : both_methods({})) {
    ContactScene<TypeParam> scene({{0, 5, 0.02, 0}});
    scene.law = law;
    scene.grains.push = {{0, law.gravity}};
    scene.steps(100);
    EXPECT_EQ(scene.velocity(0), (base::Vec2{0, 0}));
    EXPECT_EQ(scene.disc(0).y, 5);
  }
}

// In numbers whose products with h do not round anew, both fall alike to the last bit, and so do their impacts.
TYPED_TEST(Push, AQuarterOfGravityUpwardsIsThreeQuartersOfGravity) {
  for (const ContactLaw& law : both_methods({})) {
    auto pushed = support::heap<TypeParam>(60, 10, 0.012, 0.02, 1);
    pushed.law = law;
    pushed.law.friction_wall = 0.3;
    auto light = pushed;
    pushed.law.gravity = 8;
    light.law.gravity = 6;
    pushed.grains.push.assign(60, {0, 2});
    pushed.run(0.1);
    light.run(0.1);
    for (int i = 0; i < 60; ++i) {
      ASSERT_EQ(pushed.disc(i).x, light.disc(i).x);
      ASSERT_EQ(pushed.disc(i).y, light.disc(i).y);
      ASSERT_EQ(pushed.spin(i), light.spin(i));
    }
    EXPECT_EQ(pushed.totals.base.y, light.totals.base.y);
    EXPECT_GT(light.totals.dissipation, 0.1);
    const double tolerance = std::max(1e-11, 100 * TestFixture::kRounding) * light.totals.dissipation;
    EXPECT_NEAR(pushed.totals.dissipation, light.totals.dissipation, tolerance);
  }
}

// A bounce's share of the balance is gravity's own, whatever part of gravity is called a push.
TYPED_TEST(Push, ABounceLosesWhatItLosesUnderLessGravity) {
  ContactScene<TypeParam> pushed({{0, 0.12, 0.02, 0}});
  pushed.law.restitution = 0.6;
  auto light = pushed;
  light.law.gravity = pushed.law.gravity / 3;
  pushed.grains.push = {{0, 2 * pushed.law.gravity / 3}};
  const double start = balance(pushed), tolerance = std::max(1e-9, 100 * TestFixture::kRounding);
  pushed.run(0.6);
  light.run(0.6);
  EXPECT_GT(light.totals.dissipation, 0.3 * light.grains.mass[0] * light.law.gravity * 0.1);
  EXPECT_NEAR(pushed.disc(0).y, light.disc(0).y, tolerance);
  EXPECT_NEAR(pushed.totals.dissipation, light.totals.dissipation, tolerance);
  EXPECT_NEAR(balance(pushed), start, tolerance);
}

// Of a constant push the work is a difference of potentials, at the places that belong to the velocities' times.
TYPED_TEST(Push, ItsWorkIsThatAlongTheWay) {
  for (const double e : {0.0, 0.6}) {
    ContactScene<TypeParam> scene({{0, 0.12, 0.02, 0}, {0.004, 0.17, 0.02, 0}});
    scene.law.restitution = e;
    scene.law.friction_wall = 0.3;
    scene.grains.push = {{1, -3}, {1, 4}};
    int met = 0;
    for (int k = 0; k < 800; ++k) {
      scene.step();
      for (const TouchingContact& c : scene.touching()) met += c.second >= 0;
    }
    const double half = 0.5 * scene.law.step / scene.law.substeps;
    const base::Vec2 start[] = {{0, 0.12}, {0.004, 0.17}};
    double work = 0;
    for (int i = 0; i < 2; ++i) {
      const base::Vec2 way = base::Vec2{scene.disc(i).x, scene.disc(i).y} - half * scene.velocity(i) - start[i];
      work += scene.grains.mass[i] * dot(scene.grains.push[i], way);
    }
    EXPECT_GT(met, 0);
    EXPECT_NEAR(scene.totals.push_work, work, std::max(1e-11, 100 * TestFixture::kRounding) * std::abs(work));
  }
}

TYPED_TEST(Push, AColumnPressesTheBaseWithItsWeightLessThePush) {
  for (const ContactLaw& law : both_methods({})) {
    std::vector<Disc> discs;
    for (int k = 0; k < 6; ++k) discs.push_back({0, 0.02 + 0.04 * k, 0.02, 0});
    ContactScene<TypeParam> scene(discs);
    scene.law = law;
    double load = scene.weight();
    for (int k = 0; k < 6; ++k) {
      scene.grains.push.push_back({0, k - 1.5});
      load -= scene.grains.mass[k] * scene.grains.push[k].y;
    }
    scene.run(1);
    scene.totals.base = {};
    scene.run(0.25);
    EXPECT_NEAR(-scene.totals.base.y / 0.25, load, 1e-4 * load);
    EXPECT_NEAR(scene.totals.base.x, 0, 1e-6 * load);
    EXPECT_NEAR(scene.kinetic_energy(), 0, 1e-8);
  }
}

// Each sub-step rounds the momentum of each grain once.
TYPED_TEST(Push, MomentumComesFromGravityPushWallsAndBodyAlone) {
  auto scene = support::heap<TypeParam>(60, 10, 0.012, 0.02, 3);
  scene.law.friction_wall = 0.2;
  scene.run(0.3);
  double top = 0;
  for (int i = 0; i < 60; ++i) top = std::max(top, scene.disc(i).y + scene.disc(i).radius);
  scene.body = wedge(top, 0.5 * scene.box.right);
  scene.body_speed = 0.4;
  scene.grains.push = random_push(60, 6, 3);
  scene.totals.left = scene.totals.right = scene.totals.base = {};
  const base::Vec2 before = scene.momentum();
  constexpr double kTime = 0.4;
  scene.run(kTime);
  const auto& t = scene.totals;
  base::Vec2 expected{0, -scene.weight() * kTime};
  for (std::size_t i = 0; i < 60; ++i) expected = expected + kTime * scene.grains.mass[i] * scene.grains.push[i];
  for (const Impulse& p : {t.left, t.right, t.base, t.feature[0], t.feature[1]})
    expected = expected - base::Vec2{p.x, p.y};
  EXPECT_GT(t.feature[0].y, 0.01) << "the wedge did press";
  const base::Vec2 gained = scene.momentum() - before;
  const double tolerance = std::max(1e-12, 100 * TestFixture::kRounding) * (scene.weight() * kTime - t.base.y);
  EXPECT_NEAR(gained.x, expected.x, tolerance);
  EXPECT_NEAR(gained.y, expected.y, tolerance);
}

// As with gravity alone (energy_test.cpp), while the push changes from time to time and a body is driven in.
TYPED_TEST(Push, EnergyIsAccountedFor) {
  constexpr double kTolerance = TestFixture::kRounding < 1e-10 ? 1e-10 : 1e-4;
  ContactLaw soft, bouncing;
  bouncing.restitution = 0.6;
  for (const ContactLaw& law : {soft, bouncing, both_methods(soft)[1]}) {
    auto scene = support::heap<TypeParam>(40, 8, 0.012, 0.02, 4);
    scene.law = law;
    scene.law.friction_wall = 0.3;
    if (law.nonsmooth) scene.law.nonsmooth->sweeps = 10;
    scene.body = wedge(0.3, 0.5 * scene.box.right);
    scene.body_speed = 0.4;
    const double start = balance(scene), released = scene.potential_energy();
    double worst = 0;
    for (std::uint64_t change = 0; change < 10; ++change) {
      scene.grains.push = random_push(40, 8, change);
      scene.run(0.04);
      worst = std::max(worst, std::abs(balance(scene) - start));
    }
    EXPECT_LT(worst, kTolerance * released);
    EXPECT_GT(std::abs(scene.totals.push_work), 0.01 * released);
    EXPECT_GT(scene.totals.dissipation, 0.05 * released);
  }
}

// Half a radius apart, thrown together within one step: no list of places alone would hold them. So pressed, soft
// contacts yield by a hundredth; missed ones would by half a radius.
TYPED_TEST(Push, AStrongOneMissesNoContact) {
  for (const ContactLaw& law : both_methods({})) {
    constexpr double kRadius = 0.02, kGap = 0.5 * kRadius;
    ContactScene<TypeParam> scene(
        {{0, 5, kRadius, 0}, {2 * kRadius + kGap, 5, kRadius, 0}, {1, kRadius + kGap, kRadius, 0}});
    scene.law = law;
    scene.step();
    const double push = 0.9 * kRadius / (law.step * law.step);
    scene.grains.push = {{push, 0}, {-push, 0}, {0, -push}};
    for (int k = 0; k < 3; ++k) {
      scene.step();
      EXPECT_GT(scene.disc(1).x - scene.disc(0).x, 2 * kRadius * 0.97);
      EXPECT_GT(scene.disc(2).y, kRadius * 0.97);
    }
    EXPECT_LT(scene.disc(1).x - scene.disc(0).x, 2 * kRadius * 1.001) << "they met";
    EXPECT_LT(scene.disc(2).y, kRadius * 1.001) << "they met";
  }
}

TYPED_TEST(Push, WhatItDoesWithinAStepIsNoImpact) {
  for (ContactLaw law : both_methods({})) {
    law.restitution = 0.9;
    const double push = 100, drop = push * law.step * law.step;
    ContactScene<TypeParam> scene({{0, 0.02 + 1.1 * drop, 0.02, 0}});
    scene.law = law;
    scene.grains.push = {{0, -push}};
    scene.step();
    EXPECT_LT(scene.velocity(0).y, -4 * law.gravity * law.step);
    for (int k = 0; k < 20; ++k) {
      scene.step();
      EXPECT_LT(scene.velocity(0).y, 0.1 * push * law.step) << "it rebounded in step " << k;
    }
    EXPECT_NEAR(scene.velocity(0).y, 0, 1e-2 * push * law.step);
  }
}

TYPED_TEST(Push, OneForSomeGrainsOnlyIsRefused) {
  ContactScene<TypeParam> scene({{0, 5, 0.02, 0}, {1, 5, 0.02, 0}});
  scene.grains.push = {{0, 1}};
  EXPECT_THROW(scene.step(), std::logic_error);
}

}  // namespace
}  // namespace seapile::grains
