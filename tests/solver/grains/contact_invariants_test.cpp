// What holds for every grain, contact and step, whatever the scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "tests/support/contact_scene.h"

namespace seapile::grains {
namespace {

using support::ContactScene;

template <class Real>
struct ContactInvariants : testing::Test {
  static constexpr double kRounding = std::numeric_limits<Real>::epsilon();
};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(ContactInvariants, Reals);

/// A blunt pile of half-width 0.05 m whose tip stands at the origin.
RigidBody pile() {
  RigidBody body;
  body.outline = {{{-0.05, 1}, {-0.05, 0.04}, 1},
                  {{-0.05, 0.04}, {0, 0}, 0},
                  {{0, 0}, {0.05, 0.04}, 0},
                  {{0.05, 0.04}, {0.05, 1}, 1}};
  body.friction = 0.5;
  return body;
}

/// A heap that has fallen for half a second, with a pile above its highest grain.
template <class Real>
ContactScene<Real> heap_with_pile(int count, std::uint64_t seed) {
  auto scene = support::heap<Real>(count, 14, 0.012, 0.02, seed);
  scene.law.friction_wall = 0.2;
  scene.run(0.5);
  double top = 0;
  for (int i = 0; i < count; ++i) top = std::max(top, scene.disc(i).y + scene.disc(i).radius);
  scene.body = pile();
  scene.body->position = {0.5 * scene.box.right, top + 1e-4};
  return scene;
}

// Whatever the grains' momentum gains came from gravity, the walls or the body: contacts between grains cancel. Each
// sub-step rounds the momentum of each grain once.
TYPED_TEST(ContactInvariants, MomentumComesFromGravityWallsAndBodyAlone) {
  auto scene = heap_with_pile<TypeParam>(150, 1);
  scene.body_speed = 0.4;
  scene.totals.left = scene.totals.right = scene.totals.base = {};
  const base::Vec2 before = scene.momentum();
  constexpr double kTime = 0.3;
  scene.run(kTime);
  const auto& t = scene.totals;
  const base::Vec2 gained = scene.momentum() - before;
  const double weight = scene.weight() * kTime;
  const double x = -(t.left.x + t.right.x + t.base.x + t.feature[0].x + t.feature[1].x);
  const double y = -weight - (t.left.y + t.right.y + t.base.y + t.feature[0].y + t.feature[1].y);
  EXPECT_GT(t.feature[0].y, 0.1 * weight);
  const double tolerance = std::max(1e-10, 100 * TestFixture::kRounding) * (weight - t.base.y);
  EXPECT_NEAR(gained.x, x, tolerance);
  EXPECT_NEAR(gained.y, y, tolerance);
}

/// The cone holds in every lane and every body contact, in the solver's own number format, without a tolerance.
template <class Real>
void expect_admissible_impulses(const ContactScene<Real>& scene) {
  const auto& blocks = scene.system.blocks;
  for (const Colour& colour : blocks.colour)
    for (std::int32_t b = colour.first; b < colour.last; ++b) {
      const auto mu = static_cast<Real>(b < colour.first_wall ? scene.law.friction_grain : scene.law.friction_wall);
      for (int lane = 0; lane < kLanes; ++lane) {
        ASSERT_GE(blocks.block[b].pn[lane], 0);
        ASSERT_LE(std::abs(blocks.block[b].pt[lane]), mu * blocks.block[b].pn[lane]);
      }
    }
  if (!scene.body) return;
  for (const BodyContact& c : scene.body->contact) {
    ASSERT_GE(c.pn, 0);
    ASSERT_LE(std::abs(c.pt), scene.body->friction * c.pn);
  }
}

TYPED_TEST(ContactInvariants, ImpulsesPushAndStayWithinTheFrictionCone) {
  auto falling = support::heap<TypeParam>(150, 14, 0.012, 0.02, 2);
  falling.law.friction_wall = 0.2;
  auto driven = heap_with_pile<TypeParam>(150, 3);
  driven.body_speed = 0.4;
  for (int k = 0; k < 600; ++k) {
    falling.step();
    driven.step();
    expect_admissible_impulses(falling);
    expect_admissible_impulses(driven);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(driven.totals.feature[0].y, 0);
}

/// Overlaps at the start of a step: pairs (i, j), and (i, -1 - wall).
template <class Real>
std::set<std::pair<std::int32_t, std::int32_t>> overlaps_by_brute_force(const ContactScene<Real>& scene, double least) {
  std::set<std::pair<std::int32_t, std::int32_t>> found;
  const auto count = static_cast<std::int32_t>(scene.grains.count());
  for (std::int32_t i = 0; i < count; ++i) {
    const Disc& a = scene.disc(i);
    const double room[] = {a.x - a.radius - scene.box.left, scene.box.right - a.x - a.radius,
                           a.y - a.radius - scene.box.base};
    for (int wall = 0; wall < 3; ++wall)
      if (room[wall] < -least) found.insert({i, -1 - wall});
    for (std::int32_t j = i + 1; j < count; ++j) {
      const Disc& b = scene.disc(j);
      if (std::hypot(b.x - a.x, b.y - a.y) - a.radius - b.radius < -least) found.insert({i, j});
    }
  }
  return found;
}

/// What of it the solver does not work on: not listed, or in a block that rests.
template <class Real>
std::size_t asleep(const ContactScene<Real>& scene, std::set<std::pair<std::int32_t, std::int32_t>> touching) {
  const auto& blocks = scene.system.blocks;
  for (std::size_t p = 0; p < scene.system.pair.size(); ++p)
    if (blocks.active[scene.system.pair_slot[p] / kLanes])
      touching.erase({scene.system.pair[p].i, scene.system.pair[p].j});
  for (std::size_t w = 0; w < blocks.wall.size(); ++w)
    if (blocks.active[blocks.wall_slot[w] / kLanes])
      touching.erase({blocks.wall_grain[w], -1 - static_cast<std::int32_t>(blocks.wall[w])});
  return touching.size();
}

// Neighbour lists live for many steps and blocks of far contacts rest: neither may let a contact pass. Overlaps below
// 1e-9 m may be missed by rounding.
TYPED_TEST(ContactInvariants, NoContactIsMissed) {
  auto falling = support::heap<TypeParam>(600, 30, 0.012, 0.02, 11);
  auto driven = heap_with_pile<TypeParam>(150, 12);
  driven.body_speed = 2;
  driven.law.restitution = 0.5;
  std::size_t touched = 0, slept = 0;
  for (int k = 0; k < 400; ++k) {
    for (auto* scene : {&falling, &driven}) {
      const auto touching = overlaps_by_brute_force(*scene, 1e-9);
      scene->step();
      ASSERT_EQ(asleep(*scene, touching), 0u) << "step " << k;
      touched += touching.size();
      for (const std::uint8_t active : scene->system.blocks.active) slept += !active;
    }
  }
  EXPECT_GT(touched, 20'000u);
  EXPECT_GT(slept, 1000u);
  EXPECT_LT(falling.system.rebuilds, 100);
}

TYPED_TEST(ContactInvariants, WithoutFrictionNothingSpinsAndNothingPullsSideways) {
  auto scene = support::heap<TypeParam>(150, 14, 0.012, 0.02, 4);
  scene.law.friction_grain = 0;
  scene.run(0.7);
  for (int i = 0; i < 150; ++i) EXPECT_EQ(scene.spin(i), 0);
  for (const TouchingContact& c : scene.touching()) EXPECT_EQ(c.pt, 0);
  EXPECT_EQ(scene.totals.left.y, 0);
  EXPECT_EQ(scene.totals.base.x, 0);
}

TYPED_TEST(ContactInvariants, ASettledHeapIsCarriedByTheBase) {
  auto scene = support::heap<TypeParam>(150, 14, 0.012, 0.02, 5);
  scene.run(2);
  scene.totals.left = scene.totals.right = scene.totals.base = {};
  scene.run(0.2);
  // Frictionless walls: a settled bed (design README) is carried within 0.1 %; the walls' pressures balance likewise.
  EXPECT_NEAR(-scene.totals.base.y / 0.2, scene.weight(), 1e-3 * scene.weight());
  EXPECT_NEAR(scene.totals.left.x + scene.totals.right.x, 0, 1e-3 * scene.weight() * 0.2);
  EXPECT_LT(scene.totals.left.x, 0);
  EXPECT_LT(scene.report.residual, 1e-4);
}

// A pile that is not driven but heavy: the same solver, no rebuild. At rest its contacts carry its weight and its
// force.
TYPED_TEST(ContactInvariants, AFreeBodyFallsOnAHeapAndIsCarriedByItsContacts) {
  auto scene = heap_with_pile<TypeParam>(150, 6);
  constexpr double kMass = 20, kForce = -100;
  scene.body->inverse_mass = 1 / kMass;
  scene.body->force = {0, kForce};
  const double start = scene.body->position.y;
  scene.run(3);
  EXPECT_LT(scene.body->position.y, start - 0.01);
  scene.totals.feature = {{}, {}};
  scene.run(0.2);
  const double carried = (scene.totals.feature[0].y + scene.totals.feature[1].y) / 0.2;
  const double load = kMass * scene.law.gravity - kForce;
  EXPECT_NEAR(norm(scene.body->velocity), 0, 1e-3);
  EXPECT_NEAR(carried, load, 5e-3 * load);
}

// Newton's second law for the free body, exactly: its momentum comes from gravity, force and contacts.
TYPED_TEST(ContactInvariants, MomentumOfAFreeBodyComesFromGravityForceAndContacts) {
  auto scene = heap_with_pile<TypeParam>(150, 7);
  constexpr double kMass = 20, kTime = 0.2;
  scene.body->inverse_mass = 1 / kMass;
  scene.body->force = {10, -50};
  scene.totals.feature = {{}, {}};
  scene.run(kTime);
  const auto& f = scene.totals.feature;
  const base::Vec2 expected{10 * kTime + f[0].x + f[1].x, (-50 - kMass * scene.law.gravity) * kTime + f[0].y + f[1].y};
  EXPECT_GT(f[0].y, 1);
  EXPECT_NEAR(kMass * scene.body->velocity.x, expected.x, 1e-9 * kMass);
  EXPECT_NEAR(kMass * scene.body->velocity.y, expected.y, 1e-9 * kMass);
}

// Lengths times 4 and times times 2 leave gravity as it is and scale every number by a power of two, which rounds
// nothing: a solver that has no length or time of its own gives the same bits.
TYPED_TEST(ContactInvariants, NoLengthOrTimeIsHidden) {
  auto small = heap_with_pile<TypeParam>(100, 8);
  std::vector<Disc> discs;
  for (int i = 0; i < 100; ++i) discs.push_back(small.disc(i));
  ContactScene<TypeParam> a(discs);
  a.box = small.box;
  a.body = small.body;
  for (Disc& d : discs) d = {4 * d.x, 4 * d.y, 4 * d.radius, 0};
  ContactScene<TypeParam> b(discs);
  b.box = {4 * small.box.left, 4 * small.box.right, 4 * small.box.base};
  b.body = small.body;
  b.body->position = 4.0 * b.body->position;
  for (base::Segment& edge : b.body->outline) edge = {4.0 * edge.from, 4.0 * edge.to, edge.feature};
  a.law.restitution = b.law.restitution = 0.3;
  b.law.step = 2 * a.law.step;
  a.body_speed = 0.4;
  b.body_speed = 0.8;
  a.steps(500);
  b.steps(500);
  EXPECT_EQ(a.system.rebuilds, b.system.rebuilds);
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(4 * a.disc(i).x, b.disc(i).x) << i;
    ASSERT_EQ(4 * a.disc(i).y, b.disc(i).y) << i;
    ASSERT_EQ(2 * a.spin(i) / 4, b.spin(i)) << i;
  }
  EXPECT_EQ(a.totals.dissipation * 16 * 4, b.totals.dissipation);
  EXPECT_EQ(a.totals.feature[0].y * 16 * 2, b.totals.feature[0].y);
}

// What integrate() is asked to keep for frames changes nothing.
TYPED_TEST(ContactInvariants, KeepingImpulsesChangesNoBit) {
  auto kept = support::heap<TypeParam>(100, 14, 0.012, 0.02, 9), not_kept = kept;
  for (int k = 0; k < 400; ++k) {
    kept.step();
    integrate(not_kept.system, not_kept.grains, not_kept.box, not_kept.law, nullptr, {}, false, not_kept.totals,
              not_kept.team, not_kept.profile);
  }
  for (int i = 0; i < 100; ++i) ASSERT_EQ(kept.disc(i).y, not_kept.disc(i).y);
  EXPECT_EQ(kept.totals.base.y, not_kept.totals.base.y);
  EXPECT_EQ(kept.totals.dissipation, not_kept.totals.dissipation);
}

TYPED_TEST(ContactInvariants, ThreadsAndInstructionSetsChangeNoBit) {
  const auto run_with = [](int threads, InstructionSet set) {
    auto scene = support::heap<TypeParam>(2000, 50, 0.012, 0.02, 10);
    scene.law.restitution = 0.2;
    scene.team = {std::make_shared<base::Crew>(threads), set};
    scene.steps(300);
    return scene;
  };
  ASSERT_GE(Regions(2000)[Regions(2000).count() - 1].first_half, 0) << "one region has nothing to share";
  const auto expected = run_with(1, InstructionSet::generic);
  for (const auto& [threads, set] : {std::pair{1, InstructionSet::avx2},
                                     {1, InstructionSet::avx512},
                                     {2, InstructionSet::avx512},
                                     {3, InstructionSet::generic},
                                     {4, InstructionSet::avx2}}) {
    if (!available(set)) continue;
    const auto found = run_with(threads, set);
    for (int i = 0; i < 2000; ++i) {
      ASSERT_EQ(found.disc(i).x, expected.disc(i).x) << threads << " threads, grain " << i;
      ASSERT_EQ(found.disc(i).y, expected.disc(i).y) << threads << " threads, grain " << i;
      ASSERT_EQ(found.spin(i), expected.spin(i)) << threads << " threads, grain " << i;
    }
    EXPECT_EQ(found.totals.dissipation, expected.totals.dissipation);
    EXPECT_EQ(found.totals.base.y, expected.totals.base.y);
    EXPECT_EQ(found.report.residual, expected.report.residual);
    EXPECT_EQ(found.report.longest_path, expected.report.longest_path);
  }
}

}  // namespace
}  // namespace seapile::grains
