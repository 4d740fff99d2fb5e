// Discs that do not spin: their moment of inertia is infinite, and along a tangent a contact feels their whole mass.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/contact_scene.h"

namespace seapile::grains {
namespace {

using support::ContactScene;

constexpr double kRadius = 0.02, kSpeed = 0.5, kFriction = 0.4;

template <class Solver>
class Rotation : public testing::Test {};
using Solvers = testing::Types<float, double, AllPairs>;
TYPED_TEST_SUITE(Rotation, Solvers);

/// A disc that lies on the base and is thrown along it.
template <class Solver>
ContactScene<Solver> thrown(double twist, bool nonsmooth) {
  ContactScene<Solver> scene({{0, kRadius, kRadius, 0}});
  scene.law.friction_wall = kFriction;
  scene.law.twist = twist;
  if (nonsmooth) scene.law.nonsmooth = NonSmooth{};
  scene.system.motion(0).vx = static_cast<typename ContactScene<Solver>::Real>(kSpeed);
  return scene;
}

// With spin it slides until it rolls, at two thirds of its speed; without, until it stands, after v/(mu g).
TYPED_TEST(Rotation, ADiscThatDoesNotSpinSlidesUntilItStands) {
  for (const bool nonsmooth : {false, true}) {
    ContactScene<TypeParam> rolls = thrown<TypeParam>(2, nonsmooth), slides = thrown<TypeParam>(0, nonsmooth);
    const double half = 0.5 * kSpeed / (kFriction * slides.law.gravity);
    slides.steps(static_cast<int>(std::lround(half / slides.law.step)));
    EXPECT_NEAR(static_cast<double>(slides.system.motion(0).vx), 0.5 * kSpeed, 0.01 * kSpeed);
    slides.steps(300);
    rolls.steps(500);
    EXPECT_NEAR(static_cast<double>(slides.system.motion(0).vx), 0, 1e-6);
    EXPECT_EQ(slides.system.motion(0).u, 0);
    EXPECT_NEAR(static_cast<double>(rolls.system.motion(0).vx), 2.0 / 3 * kSpeed, 1e-3 * kSpeed);
    EXPECT_NEAR(static_cast<double>(rolls.system.motion(0).u), -2.0 / 3 * kSpeed, 1e-3 * kSpeed);
    // All of its energy is taken by friction.
    const double mass = slides.grains.mass[0];
    EXPECT_NEAR(slides.totals.dissipation, 0.5 * mass * kSpeed * kSpeed, 0.01 * mass * kSpeed * kSpeed);
  }
}

// Between grains, at walls, at a body and in a rebound alike: nothing turns, and the energy balance closes.
TYPED_TEST(Rotation, NothingTurnsInAHeap) {
  for (const bool nonsmooth : {false, true}) {
    ContactScene<TypeParam> scene(support::jittered_lattice(40, 8, 0.01, 0.02, 3));
    scene.box = {0, 8 * 2.04 * 0.02, 0};
    scene.law.friction_wall = 0.5;
    scene.law.restitution = 0.4;
    scene.law.twist = 0;
    if (nonsmooth) scene.law.nonsmooth = NonSmooth{};
    const double before = scene.kinetic_energy() + scene.potential_energy();
    scene.steps(400);
    for (std::int32_t i = 0; i < 40; ++i) EXPECT_EQ(scene.system.motion(i).u, 0) << i;
    const double lost = before - scene.kinetic_energy() - scene.potential_energy();
    EXPECT_GT(lost, 0);
    EXPECT_NEAR(scene.totals.dissipation / lost, 1, 1e-3);
  }
}

}  // namespace
}  // namespace seapile::grains
