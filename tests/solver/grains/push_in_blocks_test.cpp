// A push in the coloured blocks: no choice of threads or registers is seen in it, nothing stays of it, and the
// brute-force solver says the same.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "tests/support/contact_scene.h"

namespace seapile::grains {
namespace {

using support::ContactScene;
using support::random_push;

template <class Real>
struct PushInBlocks : testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(PushInBlocks, Reals);

TYPED_TEST(PushInBlocks, ThreadsAndInstructionSetsChangeNoBit) {
  for (const bool rigid : {false, true}) {
    const auto run_with = [&](int threads, InstructionSet set) {
      auto scene = support::heap<TypeParam>(2000, 50, 0.012, 0.02, 10);
      if (rigid) scene.law.nonsmooth = {20, 0, 1e-3};
      scene.law.restitution = 0.2;
      scene.team = {std::make_shared<base::Crew>(threads), set};
      for (std::uint64_t change = 0; change < 3; ++change) {
        scene.grains.push = random_push(2000, 5, change);
        scene.steps(50);
      }
      return scene;
    };
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
      EXPECT_EQ(found.totals.push_work, expected.totals.push_work);
      EXPECT_EQ(found.totals.base.y, expected.totals.base.y);
    }
  }
}

// What a push has left behind in the solver is gone with it.
TYPED_TEST(PushInBlocks, AfterwardsTheBedIsAsDryAsBefore) {
  auto scene = support::heap<TypeParam>(60, 10, 0.012, 0.02, 6);
  scene.grains.push = random_push(60, 5, 6);
  scene.run(0.1);
  scene.grains.push.clear();
  auto zero = scene;
  zero.grains.push.assign(60, {});
  scene.run(0.1);
  zero.run(0.1);
  for (int i = 0; i < 60; ++i) ASSERT_EQ(scene.disc(i).y, zero.disc(i).y);
  EXPECT_EQ(scene.totals.push_work, zero.totals.push_work);
}

// Pairs, and grains on the base, each by itself and held closed by its push, as deep as the push presses it: nothing is
// left to the order of contacts, and both solvers differ by rounding alone (brute_force_test.cpp).
TEST(PushBesideTheReference, GrainsMoveAsThoseOfTheReference) {
  std::vector<Disc> discs;
  std::vector<base::Vec2> push;
  const auto draw = [](double min, double max, std::uint32_t stream, int k) {
    return base::uniform(min, max, 7, stream, static_cast<std::uint64_t>(k));
  };
  for (int k = 0; k < 30; ++k) {
    const double r = draw(0.01, 0.02, 0, k), s = draw(0.01, 0.02, 1, k), angle = draw(0, 6.28, 2, k);
    const double distance = r + s - draw(3e-7, 5e-7, 3, k), x = 0.2 * k;
    const base::Vec2 n{std::cos(angle), std::sin(angle)};
    discs.push_back({x, 5, r, 0});
    discs.push_back({x + distance * n.x, 5 + distance * n.y, s, 0});
    discs.push_back({x, r - draw(3e-7, 5e-7, 4, k), r, 0});
    push.push_back(draw(5, 20, 5, k) * n + draw(-5, 5, 6, k) * perpendicular(n));
    push.push_back(draw(-20, -5, 7, k) * n + draw(-5, 5, 8, k) * perpendicular(n));
    push.push_back({draw(-10, 10, 9, k), draw(-20, 5, 10, k)});
  }
  ContactLaw soft;
  soft.friction_wall = 0.3;
  ContactLaw rigid = soft;
  rigid.step = 1e-4;
  rigid.nonsmooth = {20'000, 1e-15, 1e-3};
  for (const ContactLaw& law : {soft, rigid}) {
    ContactScene<double> scene(discs);
    ContactScene<AllPairs> reference(discs);
    scene.law = reference.law = law;
    scene.grains.push = reference.grains.push = push;
    for (int k = 0; k < 20; ++k) {
      scene.step();
      reference.step();
      for (int i = 0; i < 90; ++i) {
        ASSERT_NEAR(scene.disc(i).x, reference.disc(i).x, 1e-12) << "step " << k;
        ASSERT_NEAR(scene.disc(i).y, reference.disc(i).y, 1e-12) << "step " << k;
        ASSERT_NEAR(scene.spin(i), reference.spin(i), 1e-9) << "step " << k;
      }
    }
    EXPECT_GT(scene.touching().size(), 50u);
    const double size = std::abs(reference.totals.push_work);
    EXPECT_GT(size, 1e-4);
    EXPECT_NEAR(scene.totals.push_work, reference.totals.push_work, 1e-10 * size);
    EXPECT_NEAR(scene.totals.dissipation, reference.totals.dissipation, 1e-10 * size);
  }
}

}  // namespace
}  // namespace seapile::grains
