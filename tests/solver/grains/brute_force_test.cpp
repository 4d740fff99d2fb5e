// The solvers in blocks against the brute-force one, which has no list, no colour and no block to go wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/contact_scene.h"

namespace seapile::grains {
namespace {

using support::ContactScene;

/// The same scene, solved by comparing all with all.
ContactScene<AllPairs> twin(const ContactScene<double>& scene) {
  ContactScene<AllPairs> reference({scene.grains.disc.begin(), scene.grains.disc.begin() + static_cast<std::ptrdiff_t>(scene.grains.count())});
  reference.box = scene.box;
  reference.law = scene.law;
  for (std::size_t i = 0; i < scene.grains.count(); ++i)
    reference.system.body[i] = scene.system.motion(static_cast<std::int32_t>(i));
  reference.body = scene.body;
  reference.body_speed = scene.body_speed;
  return reference;
}

double largest_difference(const ContactScene<double>& scene, const ContactScene<AllPairs>& reference) {
  double worst = 0;
  for (int i = 0; i < static_cast<int>(scene.grains.count()); ++i) {
    const Motion<double>&a = scene.system.motion(i), &b = reference.system.motion(i);
    worst = std::max({worst, std::abs(scene.disc(i).x - reference.disc(i).x), std::abs(scene.disc(i).y - reference.disc(i).y),
                      std::abs(a.vx - b.vx), std::abs(a.vy - b.vy), std::abs(a.u - b.u)});
  }
  return worst;
}

/// Laws by both methods, the non-smooth one to rounding.
std::vector<ContactLaw> both_methods(ContactLaw law) {
  ContactLaw rigid = law;
  rigid.step = 1e-4;
  rigid.nonsmooth = {20'000, 1e-15, 1e-3};
  return {law, rigid};
}

// Where no body has two contacts, no order can be chosen, and both solvers differ by rounding alone, of numbers
// below 1. All contacts begin closed: one that closes ends its sub-step with a gap of zero but for rounding, and
// whether that counts as open or closed is then decided by a bit, here and there.

/// Steps the scene by both methods beside its twin; leaves it as the non-smooth method does.
void expect_alike(ContactScene<double>& scene, int steps) {
  const ContactScene<double> start = scene;
  for (const ContactLaw& law : both_methods(start.law)) {
    scene = start;
    scene.law = law;
    auto reference = twin(scene);
    for (int k = 0; k < steps; ++k) {
      scene.step();
      reference.step();
      ASSERT_LT(largest_difference(scene, reference), 1e-12) << (law.nonsmooth ? "non-smooth" : "soft") << ", step " << k;
    }
  }
}

TEST(BruteForce, TwoGrainsThatAreBeingPressedTogetherMoveAlike) {
  ContactScene<double> scene({{-0.03, 0.5, 0.02, 0}, {0.014, 0.51, 0.0252, 0}});
  scene.law.gravity = 0.5;
  scene.set_velocity(0, {0.8, 0.1});
  scene.set_velocity(1, {-0.3, 0});
  expect_alike(scene, 400);
  EXPECT_GT(std::abs(scene.spin(0)), 1) << "they did touch";
}

TEST(BruteForce, AGrainThatSlidesAndRollsOnTheBaseMovesAlike) {
  ContactScene<double> scene({{0, 0.01999, 0.02, 0}});
  scene.law.friction_wall = 0.4;
  scene.set_velocity(0, {1, 0});
  expect_alike(scene, 1000);
  EXPECT_NEAR(scene.velocity(0).x, 2.0 / 3, 1e-3);
}

TEST(BruteForce, AGrainPushedAlongByAWedgeMovesAlike) {
  RigidBody wedge;
  wedge.outline = {
      {{-0.1, 1}, {-0.1, 0.15}, 1}, {{-0.1, 0.15}, {0, 0}, 0}, {{0, 0}, {0.1, 0.15}, 0}, {{0.1, 0.15}, {0.1, 1}, 1}};
  wedge.friction = 0.3;
  // Touching the right flank from below, 1e-6 m deep.
  const base::Vec2 out = (1 / std::hypot(0.15, 0.1)) * base::Vec2{0.15, -0.1};
  const base::Vec2 place = 0.4 * base::Vec2{0.1, 0.15} + (0.02 - 1e-6) * out;
  ContactScene<double> scene({{place.x, place.y, 0.02, 0}});
  scene.box.base = -support::kFar;
  scene.body = wedge;
  scene.body_speed = 6;
  for (const ContactLaw& law : both_methods(scene.law)) {
    ContactScene<double> fast = scene;
    fast.law = law;
    auto reference = twin(fast);
    for (int k = 0; k < 100; ++k) {
      fast.step();
      reference.step();
      ASSERT_LT(largest_difference(fast, reference), 1e-12) << "step " << k;
    }
    EXPECT_LT(fast.velocity(0).y, -1) << "it was pushed";
    EXPECT_NE(fast.spin(0), 0);
    EXPECT_NEAR(fast.totals.body_work, reference.totals.body_work, 1e-9 * std::abs(fast.totals.body_work));
    EXPECT_NEAR(fast.totals.dissipation, reference.totals.dissipation, 1e-9 * fast.totals.body_work);
    EXPECT_NEAR(fast.totals.feature[0].y, reference.totals.feature[0].y, 1e-9 * std::abs(fast.totals.feature[0].y));
  }
}

// Thirty pairs and as many grains on the base, each by itself: a lane for each, in every block.
TEST(BruteForce, ManyContactsOfTheirOwnMoveAlike) {
  std::vector<Disc> discs;
  const auto draw = [](double min, double max, std::uint32_t stream, int k) {
    return base::uniform(min, max, 1, stream, static_cast<std::uint64_t>(k));
  };
  for (int k = 0; k < 30; ++k) {
    const double r = draw(0.01, 0.02, 0, k), s = draw(0.01, 0.02, 1, k), angle = draw(0, 6.28, 2, k);
    const double distance = (r + s) * (1 - draw(0, 0.01, 3, k)), x = 0.2 * k;
    discs.push_back({x, 5, r, 0});
    discs.push_back({x + distance * std::cos(angle), 5 + distance * std::sin(angle), s, 0});
    discs.push_back({x, r * (1 - draw(0, 0.01, 4, k)), r, 0});
  }
  ContactScene<double> scene(discs);
  scene.law.friction_wall = 0.3;
  scene.law.gravity = 0;  // What has parted stays apart.
  for (int i = 0; i < 90; ++i) scene.set_velocity(i, {draw(-0.1, 0.1, 5, i), i % 3 == 2 ? 0 : draw(-0.1, 0.1, 6, i)});
  for (const ContactLaw& law : both_methods(scene.law)) {
    ContactScene<double> fast = scene;
    fast.law = law;
    auto reference = twin(fast);
    fast.step();
    EXPECT_EQ(fast.system.pair.size(), 30u);
    EXPECT_GT(fast.touching().size(), law.nonsmooth ? 30u : 50u);
    reference.step();
    for (int k = 0; k < 30; ++k) {
      ASSERT_LT(largest_difference(fast, reference), 1e-12) << "step " << k;
      fast.step();
      reference.step();
    }
  }
}

// Impacts, oblique and with friction, by both methods; the soft one closes gaps to zero but for a bit.
TEST(BruteForce, GrainsReboundAlike) {
  for (const double e : {0.5, 1.0}) {
    ContactScene<double> scene({{0, 0.05, 0.02, 0}, {0.5, 0.3, 0.02, 0}, {0.56, 0.31, 0.025, 0}});
    scene.law.friction_wall = 0.2;
    scene.law.restitution = e;
    scene.set_velocity(0, {0.4, -1});
    scene.set_velocity(1, {1.5, 0});
    for (const ContactLaw& law : both_methods(scene.law)) {
      ContactScene<double> fast = scene;
      fast.law = law;
      auto reference = twin(fast);
      for (int k = 0; k < 0.05 / law.step; ++k) {
        fast.step();
        reference.step();
        ASSERT_LT(largest_difference(fast, reference), law.nonsmooth ? 1e-12 : 1e-7) << "e " << e << ", step " << k;
      }
      EXPECT_GT(fast.velocity(0).y, 0.3);
      EXPECT_GT(fast.velocity(2).x, 0.5);
    }
  }
}

/// Where thirty grains of a packing have come to rest.
struct Resting {
  double mean_height = 0, base_force = 0, kinetic_energy = 0;
};

// Thirty grains in a box: the order of the contacts decides the packing, not the physics. Over eight packings the mean
// heights agree within three standard errors of their differences, or half a percent; forces and rest agree in each.
TEST(BruteForce, ThirtyGrainsComeToTheSameRest) {
  constexpr int kPackings = 8, kSteps = 1500;
  double sum = 0, square = 0, height = 0;
  for (std::uint64_t seed = 1; seed <= kPackings; ++seed) {
    auto scene = support::heap<double>(30, 6, 0.012, 0.02, seed);
    scene.law.step = 1e-3;
    scene.law.substeps = 5;
    const double released = scene.potential_energy();
    auto reference = twin(scene);
    for (int k = 0; k < kSteps; ++k) {
      scene.step();
      reference.step();
    }
    Resting fast, slow;
    for (int i = 0; i < 30; ++i) {
      fast.mean_height += scene.disc(i).y / 30;
      slow.mean_height += reference.disc(i).y / 30;
    }
    fast.kinetic_energy = scene.kinetic_energy();
    slow.kinetic_energy = reference.kinetic_energy();
    for (const TouchingContact& c : reference.touching())
      if (c.second == -3) slow.base_force += c.pn / scene.law.step;
    for (const TouchingContact& c : scene.touching())
      if (c.second == -3) fast.base_force += c.pn / scene.law.step;
    EXPECT_NEAR(fast.base_force, scene.weight(), 1e-3 * scene.weight()) << "seed " << seed;
    EXPECT_NEAR(slow.base_force, scene.weight(), 1e-3 * scene.weight()) << "seed " << seed;
    EXPECT_LT(fast.kinetic_energy, 1e-3 * released) << "seed " << seed;
    EXPECT_LT(slow.kinetic_energy, 1e-3 * released) << "seed " << seed;
    const double difference = fast.mean_height / slow.mean_height - 1;
    sum += difference;
    square += difference * difference;
    height += slow.mean_height;
    EXPECT_LT(std::abs(difference), 0.1) << "seed " << seed;
  }
  const double mean = sum / kPackings;
  const double error = std::sqrt((square / kPackings - mean * mean) / (kPackings - 1));
  EXPECT_LT(std::abs(mean), std::max(3 * error, 0.005));
}

}  // namespace
}  // namespace seapile::grains
