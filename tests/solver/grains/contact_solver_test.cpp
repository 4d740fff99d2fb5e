// Few discs: what they dissipate, overlap and report (docs/formulation.md 2). Their motion in closed form is in
// tests/verification.
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

TYPED_TEST(ContactSolver, AFallDissipatesNothing) {
  ContactScene<TypeParam> scene({{0, 10, 0.02, 0}});
  scene.run(0.5);
  // What single precision makes of nothing, against the energy of the fall.
  const double fall = 0.5 * kGravity * 0.5 * 0.5;
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

// Rolling without resistance: nothing but rounding, over 10^4 sub-steps.
TYPED_TEST(ContactSolver, RollingDissipatesNothing) {
  ContactScene<TypeParam> scene({{0, 0.02, 0.02, 0}});
  scene.law.friction_wall = 0.5;
  scene.set_velocity(0, {1, 0});
  scene.run(0.2);
  const double speed = scene.velocity(0).x, dissipation = scene.totals.dissipation;
  EXPECT_GT(dissipation, 0) << "it slid before it rolled";
  scene.run(0.5);
  EXPECT_NEAR(scene.velocity(0).x, speed, 1e4 * TestFixture::kRounding);
  EXPECT_NEAR(scene.totals.dissipation, dissipation, 1e4 * TestFixture::kRounding);
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

// A stack, where no overlap is large beside their mean: the smallest is that of the upper two, which are looked at first.
TYPED_TEST(ContactSolver, TheLargestOverlapIsFoundWhereAllAreAlike) {
  ContactScene<TypeParam> scene({{0, 0.10, 0.02, 0}, {0, 0.06, 0.02, 0}, {0, 0.02, 0.02, 0}});
  scene.run(0.5);
  const std::vector<double> sorted = sorted_overlaps(scene);
  ASSERT_EQ(sorted.size(), 3u);
  ASSERT_LT(sorted.front(), 2 * sorted.back() + sorted[1]) << "none stands out";
  const OverlapStatistics o = overlaps(scene.system, scene.grains, nullptr);
  EXPECT_EQ(o.max, sorted.front());
  EXPECT_EQ(o.p999, sorted.front());
}

}  // namespace
}  // namespace seapile::grains
