#include "solver/basin/decay_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/base/random.h"

namespace seapile::basin {
namespace {

using std::numbers::pi;

struct Samples {
  std::vector<double> time, amplitude;
};

/// A wave of frequency 2 pi about a level that is not 0, from time 3 on.
Samples oscillation(double periods, double decay_rate, std::size_t count, double noise = 0, std::uint64_t seed = 0) {
  Samples a;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = periods * static_cast<double>(i) / static_cast<double>(count - 1);
    a.time.push_back(3 + t);
    a.amplitude.push_back(0.01 + 0.2 * std::exp(-decay_rate * t) * std::cos(2 * pi * t + 0.7) +
                          base::uniform(-noise, noise, seed, 0, i));
  }
  return a;
}

TEST(DecayFit, FindsFrequencyAndDecayFromOneAndAHalfToTenPeriods) {
  for (const double periods : {1.6, 2.0, 3.3, 5.0, 10.0})
    for (const double folds : {0.0, 0.03, 0.3, 1.0, 2.0})  // in a period
      for (const std::size_t count : {20u, 50u, 333u, 10000u}) {
        if (static_cast<double>(count) < 3 * periods || folds * periods > 12) continue;
        const Samples a = oscillation(periods, folds, count);
        const auto mode = fitted(a.time, a.amplitude);
        ASSERT_TRUE(mode) << periods << ' ' << folds << ' ' << count;
        EXPECT_NEAR(mode->frequency, 2 * pi, 1e-6 * 2 * pi) << periods << ' ' << folds << ' ' << count;
        EXPECT_NEAR(mode->decay_rate, folds, 1e-6 * std::max(folds, 0.1)) << periods << ' ' << folds << ' ' << count;
      }
}

// Of uniform noise n, standard deviation n/sqrt(3), about sqrt(24/count) sigma/(A T) is left in d and in w over a time
// T if the wave does not decay (Rife, Boorstyn 1974).
TEST(DecayFit, NoiseIsAveragedOut) {
  for (const double periods : {2.0, 5.0, 10.0})
    for (const std::size_t count : {100u, 1000u, 10000u}) {
      double squares = 0;
      constexpr int kSeeds = 10;
      const double noise = 0.02,
                   bound = std::sqrt(24.0 / static_cast<double>(count)) * noise / std::sqrt(3) / 0.2 / periods;
      for (int seed = 0; seed < kSeeds; ++seed) {
        const Samples a = oscillation(periods, 0, count, noise, seed);
        const auto mode = fitted(a.time, a.amplitude);
        ASSERT_TRUE(mode);
        squares += (std::pow(mode->frequency - 2 * pi, 2) + std::pow(mode->decay_rate, 2)) / (2 * kSeeds);
      }
      EXPECT_LT(std::sqrt(squares), 1.5 * bound) << periods << ' ' << count;
    }
}

TEST(DecayFit, DoesNotDependOnTheUnits) {
  Samples a = oscillation(4, 0.1, 200, 1e-3);
  const Mode mode = fitted(a.time, a.amplitude).value();
  for (double& t : a.time) t *= 1e-3;
  for (double& value : a.amplitude) value *= 1e-6;
  const Mode scaled = fitted(a.time, a.amplitude).value();
  EXPECT_NEAR(scaled.frequency / mode.frequency, 1e3, 1e-8);
  EXPECT_NEAR(scaled.decay_rate / mode.decay_rate, 1e3, 1e-6);
  for (double& value : a.amplitude) value += 1e-3;  // a small wave on deep water
  const Mode lifted = fitted(a.time, a.amplitude).value();
  EXPECT_NEAR(lifted.decay_rate / mode.decay_rate, 1e3, 1e-6);
}

TEST(DecayFit, TooShortASeriesHasNone) {
  for (const double periods : {0.3, 0.7, 1.0, 1.4})
    for (const double folds : {0.0, 0.3, 1.0}) {
      const Samples a = oscillation(periods, folds, 200);
      EXPECT_FALSE(fitted(a.time, a.amplitude)) << periods << ' ' << folds;
    }
  const Samples few = oscillation(2, 0, 7);
  EXPECT_FALSE(fitted(few.time, few.amplitude));
  const Samples many = oscillation(3, 0, 100);
  EXPECT_FALSE(fitted(many.time, std::vector<double>(100, 0.25)));
}

TEST(DecayFit, AnOverdampedWaveHasNone) {
  for (const double viscosity : {1.4, 2.0, 5.0}) {
    SmallWave wave{.wavenumber = 1, .depth = 2, .gravity = 1, .tension = 0, .density = 1, .viscosity = viscosity};
    Samples a;
    for (int i = 0; i <= 500; ++i) a.time.push_back(0.1 * i);
    a.amplitude = amplitude(wave, a.time);
    EXPECT_FALSE(slowest_mode(wave));
    EXPECT_FALSE(fitted(a.time, a.amplitude)) << viscosity;
  }
}

/// Largest difference, by the mode's own, of the fit of the exact curve in its window.
struct Difference {
  double frequency = 0, decay_rate = 0;
};

Difference difference(double depth, WallKind bottom, double folds_in_ten_periods) {
  SmallWave wave{.wavenumber = 1,
                 .depth = depth,
                 .gravity = 1 / std::tanh(depth),
                 .tension = 0,
                 .density = 1,
                 .viscosity = 0,
                 .bottom = bottom};
  double low = 1e-9, high = 1.4;
  for (int i = 0; i < 50; ++i) {
    wave.viscosity = std::sqrt(low * high);
    const auto mode = slowest_mode(wave);
    (mode && mode->decay_rate * 20 * pi < folds_in_ten_periods * mode->frequency ? low : high) = wave.viscosity;
  }
  const Mode mode = slowest_mode(wave).value();
  const auto [begin, end] = window_of(mode);
  std::vector<double> time;
  for (int i = 0; i <= 300; ++i) time.push_back(begin + (end - begin) * i / 300);
  const Mode fit = fitted(time, amplitude(wave, time)).value();
  return {std::abs(fit.frequency / mode.frequency - 1), std::abs(fit.decay_rate / mode.decay_rate - 1)};
}

TEST(DecayFit, OfTheExactCurveInItsWindowIsTheMode) {
  for (const WallKind bottom : {WallKind::slip, WallKind::no_slip})
    for (const double depth : {0.2, pi / 4, pi / 2, 1.6, pi, 10.0})
      for (const double folds : {0.1, 0.3, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.5, 10.0, 12.0, 14.0, 17.0, 20.0}) {
        if (folds > 7 && depth > 1.6) continue;
        const Difference d = difference(depth, bottom, folds);
        EXPECT_LT(d.frequency, 1e-3) << depth << ' ' << folds;
        EXPECT_LT(d.decay_rate, 3e-3) << depth << ' ' << folds;
      }
}

TEST(DecayFit, TheWindowIsTenPeriodsOrTwoFoldingsButTwoPeriods) {
  const double T = 2 * pi / 3;
  using Window = std::pair<double, double>;
  const auto expect = [](Window window, double begin, double end) {
    EXPECT_DOUBLE_EQ(window.first, begin);
    EXPECT_DOUBLE_EQ(window.second, end);
  };
  expect(window_of({3, 0}), T, 11 * T);
  expect(window_of({3, 0.01}), T, 11 * T);
  expect(window_of({3, 2 / (5 * T)}), T, 6 * T);
  expect(window_of({3, 2}), T, 3 * T);
}

}  // namespace
}  // namespace seapile::basin
