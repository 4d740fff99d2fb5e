// The production solver against the brute-force one, which has no list, no colour and no block to go wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/contact_scene.h"
#include "tests/support/reference_solver.h"

namespace seapile::grains {
namespace {

using support::ContactScene;
using support::ReferenceSolver;

ReferenceSolver twin(const ContactScene<double>& scene) {
  ReferenceSolver reference;
  reference.box = scene.box;
  reference.law = scene.law;
  for (std::size_t i = 0; i < scene.grains.count(); ++i) {
    const base::Vec2 v = scene.velocity(static_cast<int>(i));
    reference.grain.push_back(
        {scene.grains.disc[i], scene.grains.mass[i], v.x, v.y, scene.system.motion(static_cast<std::int32_t>(i)).u});
  }
  reference.body = scene.body;
  reference.body_speed = scene.body_speed;
  return reference;
}

double largest_difference(const ContactScene<double>& scene, const ReferenceSolver& reference) {
  double worst = 0;
  for (std::size_t i = 0; i < reference.grain.size(); ++i) {
    const auto& g = reference.grain[i];
    const base::Vec2 v = scene.velocity(static_cast<int>(i));
    const Disc& d = scene.grains.disc[i];
    worst = std::max({worst, std::abs(d.x - g.disc.x), std::abs(d.y - g.disc.y), std::abs(v.x - g.vx),
                      std::abs(v.y - g.vy), std::abs(scene.system.motion(static_cast<std::int32_t>(i)).u - g.u)});
  }
  return worst;
}

// Where no body has two contacts, no order can be chosen, and both solvers differ by rounding alone, of numbers
// below 1. All contacts begin closed: one that closes ends its sub-step with a gap of zero but for rounding, and
// whether that counts as open or closed is then decided by a bit, here and there.

TEST(ReferenceSolver, TwoGrainsThatAreBeingPressedTogetherMoveAlike) {
  ContactScene<double> scene({{-0.03, 0.5, 0.02, 0}, {0.014, 0.51, 0.0252, 0}});
  scene.law.gravity = 0.5;
  scene.set_velocity(0, {0.8, 0.1});
  scene.set_velocity(1, {-0.3, 0});
  ReferenceSolver reference = twin(scene);
  for (int k = 0; k < 400; ++k) {
    scene.step();
    reference.step();
    ASSERT_LT(largest_difference(scene, reference), 1e-12) << "step " << k;
  }
  EXPECT_GT(std::abs(scene.spin(0)), 1) << "they did touch";
  EXPECT_GT(scene.velocity(1).x - scene.velocity(0).x, 0) << "and part";
}

TEST(ReferenceSolver, AGrainThatSlidesAndRollsOnTheBaseMovesAlike) {
  ContactScene<double> scene({{0, 0.01999, 0.02, 0}});
  scene.law.friction_wall = 0.4;
  scene.set_velocity(0, {1, 0});
  ReferenceSolver reference = twin(scene);
  for (int k = 0; k < 1000; ++k) {
    scene.step();
    reference.step();
    ASSERT_LT(largest_difference(scene, reference), 1e-12) << "step " << k;
  }
  EXPECT_NEAR(scene.velocity(0).x, 2.0 / 3, 1e-3);
}

TEST(ReferenceSolver, AGrainPushedAlongByAWedgeMovesAlike) {
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
  ReferenceSolver reference = twin(scene);
  for (int k = 0; k < 100; ++k) {
    scene.step();
    reference.step();
    ASSERT_LT(largest_difference(scene, reference), 1e-12) << "step " << k;
  }
  EXPECT_LT(scene.velocity(0).y, -1) << "it was pushed";
  EXPECT_NE(scene.spin(0), 0);
}

// Thirty pairs and as many grains on the base, each by itself: a lane for each, in every block.
TEST(ReferenceSolver, ManyContactsOfTheirOwnMoveAlike) {
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
  ReferenceSolver reference = twin(scene);
  scene.step();
  EXPECT_EQ(scene.system.pair.size(), 30u);
  EXPECT_GT(scene.touching().size(), 50u);
  reference.step();
  for (int k = 0; k < 30; ++k) {
    ASSERT_LT(largest_difference(scene, reference), 1e-12) << "step " << k;
    scene.step();
    reference.step();
  }
}

/// Where thirty grains of a packing have come to rest.
struct Resting {
  double mean_height = 0, base_force = 0, kinetic_energy = 0;
};

// Thirty grains in a box: the order of the contacts decides the packing, not the physics. Over eight packings the mean
// heights agree within three standard errors of their differences, or half a percent; forces and rest agree in each.
TEST(ReferenceSolver, ThirtyGrainsComeToTheSameRest) {
  constexpr int kPackings = 8, kSteps = 1500;
  double sum = 0, square = 0, height = 0;
  for (std::uint64_t seed = 1; seed <= kPackings; ++seed) {
    auto scene = support::heap<double>(30, 6, 0.012, 0.02, seed);
    scene.law.step = 1e-3;
    scene.law.substeps = 5;
    const double released = scene.potential_energy();
    ReferenceSolver reference = twin(scene);
    for (int k = 0; k < kSteps; ++k) {
      scene.step();
      reference.step();
    }
    Resting fast, slow;
    for (std::size_t i = 0; i < 30; ++i) {
      fast.mean_height += scene.grains.disc[i].y / 30;
      slow.mean_height += reference.grain[i].disc.y / 30;
      const auto& g = reference.grain[i];
      slow.kinetic_energy += 0.5 * g.mass * (g.vx * g.vx + g.vy * g.vy + 0.5 * g.u * g.u);
    }
    fast.kinetic_energy = scene.kinetic_energy();
    for (const auto& [bodies, p] : reference.impulse)
      if (bodies.second == ReferenceSolver::kBase) slow.base_force += p.first * scene.law.substeps / scene.law.step;
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
