// First order in the sub-step, and what single precision costs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/support/contact_scene.h"

namespace seapile::grains {
namespace {

using support::ContactScene;

/// Prints step, error and rate, and returns the rates between one step and the half of it.
std::vector<double> rates(const char* what, const std::vector<double>& steps, const std::vector<double>& errors) {
  std::printf("%s\n%12s %12s %6s\n", what, "step [s]", "error", "rate");
  std::vector<double> rate;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (k > 0) rate.push_back(std::log2(errors[k - 1] / errors[k]));
    std::printf("%12.3g %12.3e %6s\n", steps[k], errors[k],
                k > 0 ? std::to_string(rate.back()).substr(0, 4).c_str() : "");
  }
  return rate;
}

// A disc slides, then rolls: its place is known exactly. Detection every 4 ms throughout, only the sub-step is halved.
TEST(Convergence, ASlidingDiscIsOfFirstOrder) {
  constexpr double kSpeed = 1, kMu = 0.3, kTime = 0.64, kGravity = 9.81;
  const double slide = kSpeed / (3 * kMu * kGravity);
  const double exact = kSpeed * slide - 0.5 * kMu * kGravity * slide * slide + 2.0 / 3 * kSpeed * (kTime - slide);
  std::vector<double> steps, errors;
  for (int substeps = 5; substeps <= 80; substeps *= 2) {
    ContactScene<double> scene({{0, 0.02, 0.02, 0}});
    scene.law.friction_wall = kMu;
    scene.law.step = 4e-3;
    scene.law.substeps = substeps;
    scene.set_velocity(0, {kSpeed, 0});
    scene.run(kTime);
    steps.push_back(4e-3 / substeps);
    errors.push_back(std::abs(scene.disc(0).x - exact));
  }
  rates("sliding disc, place after 0.64 s", steps, errors);
  // Whether the change from sliding to rolling falls early or late into a sub-step scatters single rates; the mean does
  // not.
  EXPECT_GT(std::log2(errors.front() / errors.back()) / 4, 0.8);
  EXPECT_LT(errors.back(), 1e-4);
}

// Three frictionless discs: the upper one pushes the lower two apart. A smooth motion with three contacts, against the
// same with a 32nd of the step.
TEST(Convergence, ACollapseOfThreeDiscsIsOfFirstOrder) {
  const auto height = [](double step) {
    const double r = 0.1;
    ContactScene<double> scene({{-r, r, r, 0}, {r, r, r, 0}, {0, r * (1 + std::sqrt(3.0)), r, 0}});
    scene.law.friction_grain = 0;
    scene.law.step = step;
    scene.run(0.128);
    return scene.disc(2).y;
  };
  const double exact = height(4e-3 / 128);
  std::vector<double> steps, errors;
  for (double step = 4e-3; step > 4e-4; step /= 2) {
    steps.push_back(step);
    errors.push_back(std::abs(height(step) - exact));
  }
  for (const double rate : rates("collapse of three discs, height of the upper after 0.128 s", steps, errors)) {
    EXPECT_GT(rate, 0.8);
    EXPECT_LT(rate, 1.3);
  }
}

// Before collisions multiply the difference: places agree within 1e-5 of a radius after 0.03 s, in which the lowest
// grains have met the base and each other.
TEST(Precision, SingleAndDoubleAgreeForAShortTime) {
  auto single = support::heap<float>(60, 10, 0.012, 0.02, 1);
  auto twice = support::heap<double>(60, 10, 0.012, 0.02, 1);
  single.run(0.03);
  twice.run(0.03);
  double worst = 0;
  for (int i = 0; i < 60; ++i)
    worst = std::max(worst, std::hypot(single.disc(i).x - twice.disc(i).x, single.disc(i).y - twice.disc(i).y));
  EXPECT_GT(worst, 0);
  EXPECT_GT(twice.totals.dissipation, 0);
  EXPECT_LT(worst, 1e-5 * 0.012);
}

}  // namespace
}  // namespace seapile::grains
