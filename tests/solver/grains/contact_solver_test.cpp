// Few discs whose motion is known in closed form (docs/formulation.md 2). A disc resists rolling on a surface with a
// third of its mass, which gives the thresholds 3 mu.
#include "solver/grains/contact_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "tests/support/contact_scene.h"

namespace seapile::grains {
namespace {

using std::numbers::pi;
using support::ContactScene;

constexpr double kGravity = 9.81;

/// Of a contact's spring: 2 pi f with f = stiffness / h [1/s].
double angular_frequency(const ContactLaw& law) { return 2 * pi * law.stiffness * law.substeps / law.step; }

template <class Real>
struct ContactSolver : testing::Test {
  /// Rounding of one operation, as a share of the result.
  static constexpr double kRounding = std::numeric_limits<Real>::epsilon();
};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(ContactSolver, Reals);

TYPED_TEST(ContactSolver, AFreeGrainFallsAsGravityWants) {
  ContactScene<TypeParam> scene({{0, 10, 0.02, 0}});
  scene.set_velocity(0, {0.5, 0});
  scene.run(0.5);
  // Velocity first, then place: after time t a fall is longer by g h t / 2, h = 5e-5 s, which is subtracted here.
  const double h = scene.law.step / scene.law.substeps, fall = 0.5 * kGravity * 0.5 * (0.5 + h);
  EXPECT_NEAR(scene.disc(0).y, 10 - fall, 1e4 * fall * TestFixture::kRounding);
  EXPECT_NEAR(scene.disc(0).x, 0.25, 1e-6);
  EXPECT_NEAR(scene.velocity(0).y, -0.5 * kGravity, 1e4 * kGravity * TestFixture::kRounding);
  // What single precision makes of nothing, against the energy of the fall.
  EXPECT_NEAR(scene.totals.dissipation, 0, 1e3 * TestFixture::kRounding * scene.weight() * fall);
}

TYPED_TEST(ContactSolver, AGrainComesToRestOnTheBaseWhichCarriesItsWeight) {
  ContactScene<TypeParam> scene({{0, 0.07, 0.02, 0}});
  scene.run(0.5);
  scene.totals.base = {};
  scene.run(0.5);
  // At rest the contact's spring and the weight balance to rounding.
  EXPECT_NEAR(-scene.totals.base.y / 0.5, scene.weight(), 100 * scene.weight() * TestFixture::kRounding);
  EXPECT_NEAR(scene.velocity(0).y, 0, 1e-7);
  // It rests in a spring of frequency f = stiffness / h, which its weight presses in by g / (2 pi f)^2: 2e-6 radii.
  const double omega = angular_frequency(scene.law);
  EXPECT_NEAR(0.02 - scene.disc(0).y, kGravity / (omega * omega), 1e-3 * kGravity / (omega * omega));
}

// v = v0 - mu g t while it slides; rolling from t = v0 / (3 mu g) on, with 2 v0 / 3 and without loss.
TYPED_TEST(ContactSolver, ASlidingDiscStartsToRollWithTwoThirdsOfItsSpeed) {
  for (const double friction : {0.1, 0.5, 2.0}) {
    ContactScene<TypeParam> scene({{0, 0.02, 0.02, 0}});
    scene.law.friction_wall = friction;
    scene.set_velocity(0, {1, 0});
    const double rolling = 1 / (3 * friction * kGravity), h = scene.law.step / scene.law.substeps;
    const int half = static_cast<int>(rolling / 2 / scene.law.step);
    scene.steps(half);
    // First order: friction may begin a sub-step late, because the contact must first be pressed.
    EXPECT_NEAR(scene.velocity(0).x, 1 - friction * kGravity * half * scene.law.step, 3 * friction * kGravity * h);
    EXPECT_NEAR(scene.spin(0) * 0.02, -2 * friction * kGravity * half * scene.law.step, 6 * friction * kGravity * h);
    scene.run(rolling);
    // Rounding of up to 7000 sub-steps of sliding, in single precision.
    const double tolerance = std::max(1e-5, 1e3 * TestFixture::kRounding);
    EXPECT_NEAR(scene.velocity(0).x, 2.0 / 3, tolerance);
    EXPECT_NEAR(scene.spin(0) * 0.02, -2.0 / 3, tolerance);
    const double speed = scene.velocity(0).x, dissipation = scene.totals.dissipation;
    scene.run(0.5);
    // Rolling without resistance: nothing but rounding, over 10^4 sub-steps.
    EXPECT_NEAR(scene.velocity(0).x, speed, 1e4 * TestFixture::kRounding);
    EXPECT_NEAR(scene.totals.dissipation, dissipation, 1e4 * TestFixture::kRounding);
  }
}

/// A half plane that falls to the right by an angle, and a disc that lies on it in the origin.
template <class Real>
ContactScene<Real> incline(double angle, double friction) {
  const base::Vec2 down{std::cos(angle), -std::sin(angle)}, up = perpendicular(down);
  RigidBody plane;
  plane.outline = {{100 * down, -100.0 * down, 0}};
  plane.friction = friction;
  ContactScene<Real> scene({{0.02 * up.x, 0.02 * up.y, 0.02, 0}});
  scene.box.base = -support::kFar;
  scene.body = plane;
  return scene;
}

TYPED_TEST(ContactSolver, ADiscOnAnInclineRollsBelowTanEqualsThreeMuAndSlidesAbove) {
  constexpr double kTime = 0.4, kFriction = 0.2;
  for (const double tangent : {0.05, 0.3, 0.58, 0.62, 1.0, 2.0}) {
    const double angle = std::atan(tangent), pull = kGravity * std::sin(angle), press = kGravity * std::cos(angle);
    auto scene = incline<TypeParam>(angle, kFriction);
    scene.run(kTime);
    const base::Vec2 v = scene.velocity(0);
    const double speed = norm(v), surface_speed = -scene.spin(0) * 0.02;
    const bool rolls = tangent < 3 * kFriction;
    const double expected = rolls ? 2.0 / 3 * pull * kTime : (pull - kFriction * press) * kTime;
    const double expected_spin = rolls ? expected : 2 * kFriction * press * kTime;
    // First order: a start that is late by up to three sub-steps of 5e-5 s in 0.4 s.
    EXPECT_NEAR(speed, expected, 4e-4 * pull * kTime) << "tan " << tangent;
    EXPECT_NEAR(surface_speed, expected_spin, 4e-4 * pull * kTime) << "tan " << tangent;
    EXPECT_NEAR(v.y / v.x, -tangent, 1e-4 * tangent) << "leaves the plane";
  }
}

// Exactly: the work of the slip. Slipping from rest for a time T, the contact point has a = g sin - 3 mu g cos.
TYPED_TEST(ContactSolver, ASlidingDiscDissipatesFrictionTimesSlip) {
  constexpr double kTime = 0.4, kFriction = 0.2;
  const double angle = std::atan(1.0), press = kGravity * std::cos(angle);
  auto scene = incline<TypeParam>(angle, kFriction);
  scene.run(kTime);
  const double slip = 0.5 * (kGravity * std::sin(angle) - 3 * kFriction * press) * kTime * kTime;
  const double expected = kFriction * scene.grains.mass[0] * press * slip;
  EXPECT_NEAR(scene.totals.dissipation, expected, 2e-3 * expected);
}

/// Ten discs of one column; friction plays no part.
template <class Real>
ContactScene<Real> stack() {
  std::vector<Disc> discs;
  for (int k = 0; k < 10; ++k) discs.push_back({0, 0.02 + 0.0401 * k, 0.02, 0});
  return ContactScene<Real>(discs);
}

TYPED_TEST(ContactSolver, EveryContactOfAStackCarriesWhatStandsAboveIt) {
  auto scene = stack<TypeParam>();
  scene.run(2);
  const double one = scene.grains.mass[0] * kGravity;
  int seen = 0;
  for (const TouchingContact& c : scene.touching()) {
    // Between k and k + 1 there are 9 - k discs above; on the base all ten.
    const double above = c.second >= 0 ? 9 - c.first : 10;
    // One sweep per sub-step leaves an error that has decayed to rounding after 40,000 of them.
    EXPECT_NEAR(c.pn / scene.law.step, above * one, 1e-5 * 10 * one);
    EXPECT_EQ(c.pt, 0);
    // A soft contact under a load F gives way by F / (m omega^2), m its effective mass: half a disc's between two.
    const double load = above * kGravity * (c.second >= 0 ? 2 : 1), omega = angular_frequency(scene.law);
    EXPECT_NEAR(c.overlap * 0.02, load / (omega * omega), 0.01 * 10 * kGravity / (omega * omega));
    ++seen;
  }
  EXPECT_EQ(seen, 10);
  for (int k = 0; k < 10; ++k) EXPECT_EQ(scene.disc(k).x, 0) << "a straight column has no reason to bend";
}

// A disc on two others that touch: it stands when mu >= tan 15 deg = 0.268 between discs and mu >= 0.0893 on the floor.
// The thresholds are those of statics; 10 % away from them the answer must be clear.
TYPED_TEST(ContactSolver, APyramidOfThreeStandsOnEnoughFrictionOnly) {
  struct Case {
    double grain, floor;
    bool stands;
  };
  for (const Case& c :
       {Case{0.295, 0.098, true}, {0.241, 10, false}, {10, 0.0804, false}, {0.5, 0.5, true}, {0, 0, false}}) {
    const double r = 0.02;
    ContactScene<TypeParam> scene({{-r, r, r, 0}, {r, r, r, 0}, {0, r * (1 + std::sqrt(3.0)), r, 0}});
    scene.law.friction_grain = c.grain;
    scene.law.friction_wall = c.floor;
    scene.run(1);
    const double sunk = (1 + std::sqrt(3.0)) - scene.disc(2).y / r;
    if (c.stands)
      EXPECT_LT(sunk, 0.02) << c.grain << ", " << c.floor;
    else
      EXPECT_GT(sunk, 0.5) << c.grain << ", " << c.floor;
  }
}

TYPED_TEST(ContactSolver, ACollisionConservesMomentumAndLeavesNoApproach) {
  ContactScene<TypeParam> scene({{-0.03, 1, 0.02, 0}, {0.03, 1, 0.03, 0}});
  scene.law.gravity = 0;
  scene.set_velocity(0, {1, 0});
  scene.set_velocity(1, {-0.5, 0});
  const base::Vec2 before = scene.momentum();
  scene.run(0.1);
  const base::Vec2 after = scene.momentum();
  const double scale = scene.grains.mass[0];
  EXPECT_NEAR(after.x, before.x, 100 * scale * TestFixture::kRounding);
  EXPECT_EQ(after.y, 0);
  // e = 0: the soft contact hands back at most what pushes the remaining overlap apart.
  EXPECT_NEAR(scene.velocity(1).x - scene.velocity(0).x, 0, 2e-3 * 1.5);
}

/// Largest overlap ever, as a share of the radius, of discs of 0.012 m that fly along y without gravity.
template <class Real>
double largest_overlap_in_flight(ContactScene<Real>& scene, double time) {
  scene.law.gravity = 0;
  double largest = 0;
  const double energy = scene.kinetic_energy();
  for (int k = 0; k < time / scene.law.step; ++k) {
    scene.step();
    largest = std::max(largest, (scene.box.base + 0.012 - scene.disc(0).y) / 0.012);
    for (int i = 1; i < static_cast<int>(scene.grains.count()); ++i)
      largest = std::max(largest, (0.024 - (scene.disc(i - 1).y - scene.disc(i).y)) / 0.012);
    EXPECT_LE(scene.kinetic_energy(), energy * (1 + 1e-6));
  }
  return largest;
}

// A contact is seen before it closes, so that it may close but not overshoot. Up to 10 m/s, the fall from 5 m.
TYPED_TEST(ContactSolver, AFastGrainStopsAtAWallAndAtAnotherGrain) {
  for (const double speed : {0.5, 3.0, 10.0})
    for (int phase = 0; phase < 20; ++phase) {
      ContactScene<TypeParam> wall({{0, 0.2 + 0.00027 * phase, 0.012, 0}});
      wall.set_velocity(0, {0, -speed});
      EXPECT_LT(largest_overlap_in_flight(wall, 0.25 / speed + 0.01), 0.004) << speed << " m/s";

      ContactScene<TypeParam> pair({{0, 0.1 + 0.00027 * phase, 0.012, 0}, {0, 0, 0.012, 0}});
      pair.box.base = -support::kFar;
      pair.set_velocity(0, {0, -speed / 2});
      pair.set_velocity(1, {0, speed / 2});
      EXPECT_LT(largest_overlap_in_flight(pair, 0.15 / speed + 0.01), 0.004) << speed << " m/s";
    }
}

// A grain at rest that is struck meets the next one in the same step, whose contact may have been resting: it overlaps
// by less than what it moves in that step, 1.7 % of this radius at the largest driving speed of 0.4 m/s, and far less
// there.
TYPED_TEST(ContactSolver, AStruckGrainIsStoppedByTheNextOne) {
  for (const double speed : {0.1, 0.4, 2.0})
    for (int phase = 0; phase < 40; ++phase) {
      ContactScene<TypeParam> row(
          {{0, 0.05 + 0.00013 * phase, 0.012, 0}, {0, 0, 0.012, 0}, {0, -0.024 - 5e-5 * phase, 0.012, 0}});
      row.box.base = -support::kFar;
      row.set_velocity(0, {0, -speed});
      const double most = speed > 1 ? speed * row.law.step / 0.012 : 1e-3;
      EXPECT_LT(largest_overlap_in_flight(row, 0.1 / speed + 0.02), most) << speed << " m/s";
    }
}

/// Every overlap of a scene without a body, sorted: the slow twin of overlaps().
template <class Real>
std::vector<double> sorted_overlaps(const ContactScene<Real>& scene) {
  std::vector<double> found;
  for (const ContactBlock<Real>& block : scene.system.blocks.block)
    for (int lane = 0; lane < kLanes; ++lane) {
      if (!(block.mass[lane] > 0) || !(block.pn[lane] > 0 || block.gap[lane] < 0)) continue;
      const double ri = scene.grains.disc[body_at(block.i[lane])].radius;
      const double rj = scene.grains.disc[body_at(block.j[lane])].radius;
      found.push_back(std::max(0.0, -static_cast<double>(block.gap[lane]) / (rj > 0 ? std::min(ri, rj) : ri)));
    }
  std::ranges::sort(found, std::greater<>());
  return found;
}

TYPED_TEST(ContactSolver, OverlapStatisticsAreThoseOfTheSortedOverlaps) {
  ContactScene<TypeParam> scene(support::jittered_lattice(900, 30, 0.01, 0.02, 5));
  scene.box = {0, 30 * 2.04 * 0.02, 0};
  for (int look = 0; look < 8; ++look) {
    scene.steps(100);
    const std::vector<double> sorted = sorted_overlaps(scene);
    const OverlapStatistics o = overlaps(scene.system, scene.grains, nullptr);
    ASSERT_EQ(o.touching, static_cast<std::int64_t>(sorted.size()));
    if (sorted.empty()) continue;
    double sum = 0;
    for (const double overlap : sorted) sum += overlap;
    EXPECT_EQ(o.max, sorted.front());
    EXPECT_EQ(o.p999, sorted[sorted.size() / 1000]);
    EXPECT_NEAR(o.mean, sum / static_cast<double>(sorted.size()), 1e-12);
  }
  EXPECT_GT(sorted_overlaps(scene).size(), 1000u) << "the bed is too small for the 99.9 % to be told from the largest";
}

}  // namespace
}  // namespace seapile::grains
