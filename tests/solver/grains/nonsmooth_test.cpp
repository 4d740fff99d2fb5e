#include "solver/grains/nonsmooth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/contact_scene.h"

namespace seapile::grains {
namespace {

using support::ContactScene;

/// Sixty grains in a box, at rest by converged non-smooth steps.
ContactScene<double> resting_heap(double friction) {
  auto scene = support::heap<double>(60, 8, 0.012, 0.02, 7);
  scene.law.step = 5e-4;
  scene.law.friction_grain = friction;
  scene.law.nonsmooth = {2000, 1e-9, 1e-3};
  scene.run(1);
  return scene;
}

ContactScene<AllPairs> twin(const ContactScene<double>& scene) {
  const auto count = static_cast<std::ptrdiff_t>(scene.grains.count());
  ContactScene<AllPairs> reference({scene.grains.disc.begin(), scene.grains.disc.begin() + count});
  reference.box = scene.box;
  reference.law = scene.law;
  for (int i = 0; i < count; ++i) reference.system.body[i] = scene.system.motion(i);
  return reference;
}

double smallest_gap(const ContactScene<double>& scene) {
  double least = std::numeric_limits<double>::infinity();
  const int count = static_cast<int>(scene.grains.count());
  for (int i = 0; i < count; ++i) {
    const Disc& a = scene.disc(i);
    least = std::min({least, a.x - a.radius - scene.box.left, scene.box.right - a.x - a.radius, a.y - a.radius});
    for (int j = i + 1; j < count; ++j) {
      const Disc& b = scene.disc(j);
      least = std::min(least, std::hypot(b.x - a.x, b.y - a.y) - a.radius - b.radius);
    }
  }
  return least;
}

// Impenetrable at the end of each step: what is left is the turning of normals within a step, (v dt)^2 / 2r = 1e-6 m at
// 0.5 m/s, and the residual times the step.
TEST(NonSmooth, GapIsNeverBelowTolerance) {
  auto scene = support::heap<double>(60, 8, 0.012, 0.02, 7);
  scene.law.step = 1e-4;
  scene.law.nonsmooth = {3000, 1e-9, 1e-3};
  for (int k = 0; k < 5000; ++k) {
    scene.step();
    if (k % 10 > 0) continue;
    ASSERT_GT(smallest_gap(scene), -1e-6) << "step " << k;
  }
  EXPECT_LT(scene.kinetic_energy(), 1e-3 * scene.potential_energy());
}

// Without friction the velocities at a step's end are the nearest admissible ones to the free ones: there is one answer,
// whatever the order of the contacts and with or without momentum.
TEST(NonSmooth, WithoutFrictionAnyOrderGivesTheSameVelocities) {
  auto scene = support::heap<double>(60, 8, 0.012, 0.02, 3);
  scene.law.friction_grain = 0;
  scene.law.step = 2e-4;
  scene.law.nonsmooth = {100'000, 1e-13, 1e-3};
  for (int k = 0; k < 40; ++k) {
    scene.run(0.01);
    auto reference = twin(scene);
    ContactScene<double> next = scene;
    next.step();
    reference.step();
    for (int i = 0; i < 60; ++i)
      ASSERT_LT(norm(next.velocity(i) - reference.velocity(i)), 1e-9) << "grain " << i << " at " << 0.01 * (k + 1) << " s";
  }
}

// The conditions themselves, contact by contact, at the end of a converged step with friction.
TEST(NonSmooth, SignoriniAndCoulombHoldAtEveryContact) {
  const auto scene = resting_heap(0.5);
  int sticking = 0, sliding = 0;
  ContactScene<double> shaken = scene;
  for (int i = 0; i < 60; i += 7) shaken.set_velocity(i, {0.05, 0.1});
  shaken.law.nonsmooth = {100'000, 1e-13, 1e-3};
  for (int k = 0; k < 20; ++k) shaken.step();
  const auto& blocks = shaken.system.blocks;
  for (std::size_t b = 0; b < blocks.block.size(); ++b) {
    if (!blocks.active[b]) continue;
    for (int lane = 0; lane < kLanes; ++lane) {
      const ContactBlock<double>& c = blocks.block[b];
      if (!(c.mass[lane] > 0)) continue;
      const auto &mi = shaken.system.motion(body_at(c.i[lane])), &mj = shaken.system.motion(body_at(c.j[lane]));
      const double wx = mj.vx - mi.vx, wy = mj.vy - mi.vy;
      const double slack = c.nx[lane] * wx + c.ny[lane] * wy + shaken.system.iterate[b].bias[lane];
      const double vt = c.nx[lane] * wy - c.ny[lane] * wx - mi.u - mj.u;
      EXPECT_GE(c.pn[lane], 0);
      EXPECT_GT(slack, -1e-9);
      EXPECT_NEAR(c.pn[lane] > 0 ? slack : 0, 0, 1e-9);
      const bool wall = body_at(c.j[lane]) >= 60;
      const double cone = (wall ? 0 : 0.5) * c.pn[lane];
      EXPECT_LE(std::abs(c.pt[lane]), cone * (1 + 1e-12));
      if (c.pn[lane] == 0 || wall) continue;
      if (std::abs(c.pt[lane]) < 0.999 * cone) {
        EXPECT_NEAR(vt, 0, 1e-9);
        ++sticking;
      } else if (std::abs(vt) > 1e-9) {
        EXPECT_LT(vt * c.pt[lane], 0) << "friction opposes sliding";
        ++sliding;
      }
    }
  }
  EXPECT_GT(sticking, 20);
  EXPECT_GT(sliding, 0);
}

// That it is the natural map's, contact_kernels_test.cpp says lane by lane.
TEST(NonSmooth, TheResidualFallsWithTheSweeps) {
  auto scene = resting_heap(0.5);
  for (int i = 0; i < 60; i += 5) scene.set_velocity(i, {0.1, -0.1});
  double last = std::numeric_limits<double>::infinity();
  for (const int sweeps : {10, 100, 1000}) {
    ContactScene<double> next = scene;
    next.law.nonsmooth = {sweeps, 0, 1e-3};
    next.step();
    EXPECT_EQ(next.report.sweeps, sweeps);
    EXPECT_GT(next.report.residual, 0);
    EXPECT_LT(next.report.residual, 0.2 * last);
    last = next.report.residual;
  }
  EXPECT_LT(last, 1e-6);
}

TEST(NonSmooth, SweepsEndAtTheTolerance) {
  auto scene = resting_heap(0.5);
  for (int i = 0; i < 60; i += 5) scene.set_velocity(i, {0.1, -0.1});
  scene.law.nonsmooth = {100'000, 1e-5, 1e-3};
  scene.step();
  EXPECT_LT(scene.report.sweeps, 2000);
  EXPECT_LT(scene.report.residual, 1e-4) << "of the order of the last sweep's change";
}

// The brute-force solver sweeps without momentum.
TEST(NonSmooth, MomentumReachesATightToleranceInFewerSweeps) {
  auto scene = resting_heap(0.5);
  auto reference = twin(scene);
  for (auto* law : {&scene.law, &reference.law}) law->nonsmooth = {1'000'000, 1e-8, 1e-3};
  for (int i = 0; i < 60; i += 5) {
    scene.set_velocity(i, {0.1, -0.1});
    reference.set_velocity(i, {0.1, -0.1});
  }
  // From nothing: the blocks' kept impulses would be an advantage.
  for (auto& block : scene.system.blocks.block)
    for (int lane = 0; lane < kLanes; ++lane) block.pn[lane] = block.pt[lane] = 0;
  scene.step();
  reference.step();
  EXPECT_LT(2 * scene.report.sweeps, reference.report.sweeps);
}

// A bed that was settled softly has an overlap in every contact. Taken back within a step they would add up, layer upon
// layer; at a bounded speed the bed rises by no more than that speed throws it, layers * speed squared over 2 g.
TEST(NonSmooth, ABedThatWasSettledSoftlyIsNotThrownUp) {
  auto scene = support::heap<double>(300, 8, 0.012, 0.02, 5);
  scene.law.step = 5e-4;
  scene.law.substeps = 4;  // so soft that overlaps are large
  scene.run(2);
  double top = 0;
  for (int i = 0; i < 300; ++i) top = std::max(top, scene.disc(i).y);
  scene.law.step = 1e-4;
  scene.law.nonsmooth = NonSmooth{};
  double highest = 0;
  for (int k = 0; k < 2000; ++k) {
    scene.step();
    for (int i = 0; i < 300; ++i) highest = std::max(highest, scene.disc(i).y);
  }
  EXPECT_LT(highest - top, 1e-3);
}

template <class Real>
struct NonSmoothOf : testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(NonSmoothOf, Reals);

template <class Real>
double balance(const ContactScene<Real>& scene) {
  const double half = 0.5 * scene.law.step;
  return scene.kinetic_energy() + scene.potential_energy() - half * scene.law.gravity * scene.momentum().y +
         scene.totals.dissipation - scene.totals.body_work;
}

// As in energy_test.cpp, and for any number of sweeps: the balance does not rest on convergence.
TYPED_TEST(NonSmoothOf, EnergyIsAccountedForWhenABodyIsDrivenIn) {
  const double tolerance = std::numeric_limits<TypeParam>::epsilon() < 1e-10 ? 1e-6 : 1e-3;
  for (const double e : {0.0, 0.6}) {
    auto scene = support::heap<TypeParam>(200, 14, 0.012, 0.02, 3);
    scene.law.step = 1e-4;
    scene.law.nonsmooth = {20, 0, 1e-3};
    scene.law.friction_wall = 0.3;
    scene.law.restitution = e;
    const double released = scene.potential_energy(), at_rest = balance(scene);
    scene.run(0.5);
    EXPECT_NEAR(balance(scene), at_rest, tolerance * released);
    double top = 0;
    for (int i = 0; i < 200; ++i) top = std::max(top, scene.disc(i).y + 0.02);
    RigidBody wedge;
    wedge.outline = {{{-0.05, 1}, {-0.05, 0.08}, 1},
                     {{-0.05, 0.08}, {0, 0}, 0},
                     {{0, 0}, {0.05, 0.08}, 0},
                     {{0.05, 0.08}, {0.05, 1}, 1}};
    wedge.position = {0.5 * scene.box.right, top};
    wedge.friction = 0.5;
    scene.body = wedge;
    scene.body_speed = 0.4;
    const double start = balance(scene), dissipated = scene.totals.dissipation;
    scene.run(0.3);
    EXPECT_GT(scene.totals.body_work, 0.01);
    EXPECT_GT(scene.totals.dissipation, dissipated);
    EXPECT_NEAR(balance(scene), start, tolerance * (scene.totals.body_work + scene.potential_energy()));
  }
}

// The work of a free body is what it loses.
TYPED_TEST(NonSmoothOf, AFreeBodyComesToRestOnTheHeapWithItsWeight) {
  auto scene = support::heap<TypeParam>(60, 10, 0.012, 0.02, 4);
  scene.law.step = 2e-4;
  scene.law.nonsmooth = {400, 1e-7, 1e-3};
  scene.run(0.5);
  RigidBody plate;
  plate.outline = {{{0, 1}, {0, 0}, 1}, {{0, 0}, {scene.box.right, 0}, 0}, {{scene.box.right, 0}, {scene.box.right, 1}, 1}};
  plate.position = {0, 0.4};
  plate.friction = 0.5;
  constexpr double kMass = 5;
  plate.inverse_mass = 1 / kMass;
  scene.body = plate;
  scene.run(1);
  scene.totals.feature[0] = {};
  scene.totals.base = {};
  scene.run(0.2);
  EXPECT_NEAR(-scene.totals.base.y / 0.2, scene.weight() + kMass * scene.law.gravity, 2e-3 * scene.weight());
  EXPECT_NEAR(scene.totals.feature[0].y / 0.2, kMass * scene.law.gravity, 2e-3 * kMass * scene.law.gravity);
}

// Oblique impact on the base, and of two grains, for e = 0, 0.5 and 1 (formulation.md 2.7).
TYPED_TEST(NonSmoothOf, AnObliqueImpactSlidesOrRolls) {
  constexpr double kMu = 0.1, kNormal = 2;
  for (const double e : {0.0, 0.5, 1.0})
    for (const double tangential : {0.2, 0.5, 0.9, 1.5}) {
      ContactScene<TypeParam> scene({{0, 0.05, 0.02, 0}});
      scene.law.step = 1e-4;
      scene.law.nonsmooth = NonSmooth{};
      scene.law.gravity = 0;
      scene.law.friction_wall = kMu;
      scene.law.restitution = e;
      scene.set_velocity(0, {tangential, -kNormal});
      scene.run(0.03);
      const bool slides = tangential >= 3 * kMu * (1 + e) * kNormal;
      const double expected = slides ? tangential - kMu * (1 + e) * kNormal : 2.0 / 3 * tangential;
      // Where an impact is spread over two steps, because the first only closes the gap, the sums are exact all the same.
      EXPECT_NEAR(scene.velocity(0).y, e * kNormal, 1e-5);
      EXPECT_NEAR(scene.velocity(0).x, expected, 1e-5) << "e " << e << ", " << tangential;
      EXPECT_NEAR(-scene.spin(0) * 0.02, slides ? 2 * kMu * (1 + e) * kNormal : expected, 1e-5);
    }
}

}  // namespace
}  // namespace seapile::grains
