// Kinetic + potential energy + dissipation - work of the body = constant, with every term summed on its own.
//
// A sub-step moves the velocities first and the places with the new ones, so both belong to times half a sub-step
// apart: the balance is exact with the potential energy of the places y - h v_y / 2.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/contact_scene.h"

namespace seapile::grains {
namespace {

using support::ContactScene;

template <class Real>
struct Energy : testing::Test {
  /// In double the balance is exact but for rounding; in single, 10^4 sub-steps of 200 grains round at 6e-8 each.
  static constexpr double kTolerance = std::numeric_limits<Real>::epsilon() < 1e-10 ? 1e-6 : 1e-4;
};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(Energy, Reals);

template <class Real>
double balance(const ContactScene<Real>& scene) {
  const double half = 0.5 * scene.law.step / scene.law.substeps;
  const double potential = scene.potential_energy() - half * scene.law.gravity * scene.momentum().y;
  return scene.kinetic_energy() + potential + scene.totals.dissipation - scene.totals.body_work;
}

/// A plate as wide as the box that is pushed down on a heap.
RigidBody plate(double height, double width) {
  RigidBody body;
  body.outline = {{{0, 1}, {0, 0}, 1}, {{0, 0}, {width, 0}, 0}, {{width, 0}, {width, 1}, 1}};
  body.position = {0, height};
  body.friction = 0.5;
  return body;
}

/// A wedge in the middle of the box.
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

TYPED_TEST(Energy, IsAccountedForWhileAHeapSettles) {
  auto scene = support::heap<TypeParam>(200, 14, 0.012, 0.02, 1);
  scene.law.friction_wall = 0.3;
  const double start = balance(scene), released = scene.potential_energy();
  double worst = 0;
  for (int k = 0; k < 2000; ++k) {
    scene.step();
    worst = std::max(worst, std::abs(balance(scene) - start));
  }
  EXPECT_LT(worst, TestFixture::kTolerance * released);
  // It did settle, and lost what it had to lose.
  EXPECT_GT(scene.totals.dissipation, 0.05 * released);
  EXPECT_LT(scene.kinetic_energy(), 1e-4 * released);
}

TYPED_TEST(Energy, IsAccountedForWhenGrainsRebound) {
  auto scene = support::heap<TypeParam>(200, 14, 0.012, 0.02, 2);
  scene.law.restitution = 0.6;
  const double start = balance(scene), released = scene.potential_energy();
  scene.run(0.5);
  EXPECT_NEAR(balance(scene), start, TestFixture::kTolerance * released);
}

TYPED_TEST(Energy, IsAccountedForWhenABodyIsDrivenIn) {
  auto scene = support::heap<TypeParam>(200, 14, 0.012, 0.02, 3);
  scene.run(0.5);
  double top = 0;
  for (std::size_t i = 0; i < scene.grains.count(); ++i) top = std::max(top, scene.disc(static_cast<int>(i)).y + 0.02);
  scene.body = wedge(top, 0.5 * scene.box.right);
  scene.body_speed = 0.4;
  const double start = balance(scene), dissipated = scene.totals.dissipation;
  scene.run(0.5);
  EXPECT_GT(scene.totals.body_work, 0.01);
  EXPECT_GT(scene.totals.dissipation - dissipated, 0.5 * scene.totals.body_work);
  EXPECT_NEAR(balance(scene), start, TestFixture::kTolerance * (scene.totals.body_work + scene.potential_energy()));
}

// A free body gives what it loses: its own kinetic and potential energy fall by the work that it does on the grains.
TYPED_TEST(Energy, AFreeBodyLosesWhatItGives) {
  auto scene = support::heap<TypeParam>(60, 10, 0.012, 0.02, 4);
  scene.run(0.5);
  scene.body = plate(0.5, scene.box.right);
  constexpr double kMass = 5;
  scene.body->inverse_mass = 1 / kMass;
  const auto own = [&] {
    const RigidBody& b = *scene.body;
    return 0.5 * kMass * dot(b.velocity, b.velocity) + kMass * scene.law.gravity * b.position.y;
  };
  const double start = balance(scene), own_start = own();
  scene.run(0.5);
  EXPECT_GT(own_start - own(), 5);
  EXPECT_NEAR(scene.totals.body_work, own_start - own(), 1e-3 * (own_start - own()));
  EXPECT_NEAR(balance(scene), start, 1e-3 * scene.totals.body_work);
}

// With e = 0 contacts take energy out. What they give back is the soft correction of overlaps that closed between two
// detections, which a record of 10 ms contains only as a small part.
TYPED_TEST(Energy, DissipationGrowsFromRecordToRecord) {
  auto scene = support::heap<TypeParam>(200, 14, 0.012, 0.02, 5);
  const double released = scene.potential_energy();
  double last = 0;
  for (int record = 0; record < 100; ++record) {
    scene.run(0.01);
    EXPECT_GT(scene.totals.dissipation, last - 1e-6 * released) << "record " << record;
    last = scene.totals.dissipation;
  }
  EXPECT_GT(last, 0.05 * released);
}

TYPED_TEST(Energy, ASettledHeapStaysSettled) {
  auto scene = support::heap<TypeParam>(100, 10, 0.012, 0.02, 6);
  scene.run(2);
  const double potential = scene.potential_energy(), dissipation = scene.totals.dissipation;
  scene.run(1);
  EXPECT_NEAR(scene.potential_energy(), potential, 1e-6 * potential);
  EXPECT_NEAR(scene.totals.dissipation, dissipation, 1e-6 * potential);
}

}  // namespace
}  // namespace seapile::grains
