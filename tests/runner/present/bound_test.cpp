// The one-sided test of a bound, by hand, against tables, and on samples whose truth is known.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "runner/present/statistics.h"
#include "solver/base/random.h"

namespace seapile::present {
namespace {

using Values = std::vector<double>;

/// Normal values, each a function of its place alone (Box and Muller 1958).
Values normal_values(std::size_t count, double mean, double sd, std::uint32_t stream, std::uint64_t sample) {
  Values values;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t at = 2 * (1000 * sample + i);
    const double radius = std::sqrt(-2 * std::log(1 - base::uniform(11, stream, at)));
    values.push_back(mean + sd * radius * std::cos(2 * std::numbers::pi * base::uniform(11, stream, at + 1)));
  }
  return values;
}

/// Share of 4000 samples of n normal values around `mean` that are decided like this about "more than 1".
double share(Decision decision, std::size_t n, double mean, double sd, double margin, std::uint32_t stream) {
  int count = 0;
  for (std::uint64_t sample = 0; sample < 4000; ++sample) {
    const Estimate estimate = mean_of(normal_values(n, mean, sd, stream, sample));
    count += test_bound(estimate, Side::above, 1, margin) == decision ? 1 : 0;
  }
  return count / 4000.0;
}

TEST(TestBound, OfAWorkedExample) {
  // 1 2 3 4 5: mean 3, standard error sqrt(2.5 / 5) = 0.70711; t_0.95(4) = 2.1318 and t_0.975(4) = 2.7764 of tables:
  // one-sided bounds 1.4926 and 4.5074, two-sided 1.0367 and 4.9633.
  const Estimate three = mean_of(Values{1, 2, 3, 4, 5});
  EXPECT_EQ(test_bound(three, Side::above, 1.49, 0.1), Decision::confirmed);
  EXPECT_EQ(test_bound(three, Side::above, 1.50, 0.1), Decision::underpowered);
  EXPECT_EQ(test_bound(three, Side::above, 4.50, 0.1), Decision::underpowered);
  EXPECT_EQ(test_bound(three, Side::above, 4.51, 0.1), Decision::refuted);
  // Around 3 the two-sided interval reaches 1.9633 to either side.
  EXPECT_EQ(test_bound(three, Side::above, 3, 0.981), Decision::underpowered);
  EXPECT_EQ(test_bound(three, Side::above, 3, 0.982), Decision::not_distinguishable);
}

TEST(TestBound, BelowIsTheMirrorImageOfAbove) {
  const Values values = {1.02, 1.05, 0.99, 1.07, 1.01};
  Values mirrored;
  for (const double value : values) mirrored.push_back(-value);
  for (double bound = 0.9; bound < 1.2; bound += 0.003) {
    for (const double margin : {0.01, 0.02, 0.05}) {
      EXPECT_EQ(test_bound(mean_of(values), Side::above, bound, margin),
                test_bound(mean_of(mirrored), Side::below, -bound, margin))
          << bound;
    }
  }
}

TEST(TestBound, WhatOneSideConfirmsTheOtherRefutes) {
  const Estimate one = {8, 1.1, 0.02, 7};
  EXPECT_EQ(test_bound(one, Side::above, 1, 0.01), Decision::confirmed);
  EXPECT_EQ(test_bound(one, Side::below, 1, 0.01), Decision::refuted);
}

TEST(TestBound, OneValueDecidesNothing) {
  EXPECT_EQ(test_bound(mean_of(Values{5}), Side::above, 1, 0.1), Decision::underpowered);
  EXPECT_EQ(test_bound(mean_of(Values{}), Side::above, 1, 0.1), Decision::underpowered);
}

TEST(TestBound, ValuesWithoutScatterAreDecidedByTheirValue) {
  EXPECT_EQ(test_bound(mean_of(Values{2, 2}), Side::above, 1, 0.1), Decision::confirmed);
  EXPECT_EQ(test_bound(mean_of(Values{1, 1}), Side::above, 1, 0.1), Decision::not_distinguishable);
}

// The ratio of a to b more than r is the ratio of b to a less than 1/r.
TEST(TestBound, ALogRatioReadsTheSameTheOtherWayRound) {
  const Values a = {40, 44, 50, 38, 41}, b = {44, 47, 51, 43, 45};
  for (double bound = 0.95; bound < 1.3; bound += 0.01) {
    for (const double margin : {0.02, 0.05, 0.1}) {
      EXPECT_EQ(test_bound(paired_log_ratio(a, b), Side::above, std::log(bound), std::log1p(margin)),
                test_bound(paired_log_ratio(b, a), Side::below, -std::log(bound), std::log1p(margin)))
          << bound;
    }
  }
}

TEST(TestBound, WhatLiesOnTheBoundIsConfirmedOnceInTwentyAndRefutedAsOften) {
  for (const std::size_t n : {3u, 5u, 8u}) {
    EXPECT_NEAR(share(Decision::confirmed, n, 1, 0.2, 0.02, 1), 0.05, 0.01) << n;
    EXPECT_NEAR(share(Decision::refuted, n, 1, 0.2, 0.02, 2), 0.05, 0.01) << n;
  }
}

TEST(TestBound, WhatIsBeyondTheBoundIsRarelyDecidedWrongly) {
  EXPECT_LT(share(Decision::refuted, 5, 1.1, 0.2, 0.02, 3), 0.03);
  EXPECT_LT(share(Decision::confirmed, 5, 0.9, 0.2, 0.02, 4), 0.03);
}

TEST(TestBound, TwiceTheMarginAwayIsNotDistinguishableOnceInFortyAtMost) {
  // So far that neither side is shown: the most dangerous place is 2 margins from the bound.
  for (const double sd : {0.1, 0.2, 0.3}) {
    EXPECT_LT(share(Decision::not_distinguishable, 6, 1.2, sd, 0.1, 5), 0.032) << sd;
  }
  EXPECT_GT(share(Decision::not_distinguishable, 6, 1, 0.05, 0.1, 6), 0.85);
}

TEST(TestBound, RefusesMarginsAndRisksThatMeanNothing) {
  const Estimate one = {8, 1.1, 0.02, 7};
  EXPECT_THROW(test_bound(one, Side::above, 1, 0), std::invalid_argument);
  EXPECT_THROW(test_bound(one, Side::above, 1, 0.1, 0.5), std::invalid_argument);
  EXPECT_THROW(bound_power(-1, 1, 5), std::invalid_argument);
  EXPECT_THROW(bound_power(1, 1, 1), std::invalid_argument);
  EXPECT_THROW(sample_to_decide(1, 1, 0), std::invalid_argument);
}

TEST(TestBound, EveryDecisionHasItsWords) {
  EXPECT_EQ(words(Decision::confirmed), "confirmed");
  EXPECT_EQ(words(Decision::refuted), "refuted");
  EXPECT_EQ(words(Decision::not_distinguishable), "not distinguishable");
  EXPECT_EQ(words(Decision::underpowered), "underpowered");
}

TEST(BoundPower, GivesThePublishedSampleSizes) {
  // One-sided one-sample t-test at 5 % with power 80 %, as of Cohen, Statistical Power Analysis, 1988, and of R,
  // power.t.test(delta = d, sd = 1, power = 0.8, type = "one.sample", alternative = "one.sided"), rounded up.
  const struct {
    double effect;
    std::size_t n;
  } table[] = {{0.5, 27}, {0.8, 12}, {1.0, 8}};
  for (const auto& [effect, n] : table) {
    EXPECT_GE(bound_power(effect, 1, n), 0.8) << effect;
    EXPECT_LT(bound_power(effect, 1, n - 1), 0.8) << effect;
  }
  EXPECT_EQ(bound_power(0, 1, 5), 0.05);
  EXPECT_EQ(bound_power(1, 0, 2), 1);
  EXPECT_NEAR(bound_power(1e-9, 1, 5), 0.05, 1e-6);
}

TEST(BoundPower, IsTheShareOfSamplesThatAreConfirmed) {
  for (const std::size_t n : {3u, 6u, 12u}) {
    for (const double distance : {0.1, 0.2}) {
      // The standard error of such a share is at most 0.8 %.
      EXPECT_NEAR(bound_power(distance, 0.2, n), share(Decision::confirmed, n, 1 + distance, 0.2, 0.01, 7), 0.025)
          << n << " " << distance;
    }
  }
}

TEST(SampleToDecide, IsEnoughAndFarFromTheBoundNoneLessIs) {
  const std::size_t needed = sample_to_decide(0.2, 0.15, 0.05).value();
  EXPECT_GT(share(Decision::confirmed, needed, 1.15, 0.2, 0.05, 8), 0.8 - 0.02);
  EXPECT_LT(share(Decision::confirmed, needed - 1, 1.15, 0.2, 0.05, 9), 0.8 + 0.02);
}

TEST(SampleToDecide, OnTheBoundItIsWhatExcludesTwiceTheMargin) {
  const std::size_t needed = sample_to_decide(0.2, 0, 0.05).value();
  EXPECT_EQ(needed, sample_needed(0.2, 0.1, kPower, kAlpha / 2));
  EXPECT_GT(share(Decision::not_distinguishable, needed, 1, 0.2, 0.05, 10), 0.8 - 0.07)
      << "but for what is decided though it lies on the bound";
}

TEST(SampleToDecide, IsFiniteForEveryTruthBecauseOfTheMargin) {
  for (double distance = 0; distance < 0.5; distance += 0.01) {
    EXPECT_LE(sample_to_decide(0.2, distance, 0.05).value_or(1'000'000), 200u) << distance;
  }
  EXPECT_EQ(sample_to_decide(0, 0, 0.05), 2u);
  EXPECT_FALSE(sample_to_decide(1e4, 0, 1).has_value());
}

}  // namespace
}  // namespace seapile::present
