#include "runner/present/enough_packings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/base/random.h"

namespace seapile::present {
namespace {

using Values = std::vector<double>;

PackingsOfCase of_case(const std::string& tip, std::vector<Values> values) {
  return {{{"pile.tip", tip}}, std::move(values)};
}

constexpr std::size_t kCap = 24;
PackingRound round_of(const std::vector<PackingsOfCase>& cases, double half_width, std::size_t at_most = kCap) {
  return next_round(cases, cases[0].values[0].size(), {"q_c", half_width, at_most});
}

TEST(SampleForHalfWidth, IsTheSmallestWhoseIntervalIsNarrowEnough) {
  // t_0.975 of tables: 2.776 / sqrt(5) = 1.24166 and 2.571 / sqrt(6) = 1.04943 standard deviations.
  EXPECT_EQ(sample_for_half_width(1, 1.2417), 5u);
  EXPECT_EQ(sample_for_half_width(1, 1.2416), 6u);
  EXPECT_EQ(sample_for_half_width(2, 2 * 1.0495), 6u);
  EXPECT_EQ(sample_for_half_width(2, 2 * 1.0494), 7u);
  EXPECT_EQ(sample_for_half_width(0, 0), 2u);
  EXPECT_FALSE(sample_for_half_width(1, 0).has_value());
}

TEST(NextRound, NarrowBandsAreEnough) {
  // 99 100 101 100: standard deviation 0.8165, t_0.975(3) = 3.182446, half-width 1.2992.
  const auto cases = {of_case("flat", {{99, 100, 101, 100}})};
  const PackingRound enough = round_of(cases, 0.012993);
  EXPECT_NEAR(enough.widest, 0.012992, 1e-6);
  EXPECT_EQ(enough.wide, 0u);
  EXPECT_EQ(enough.next, 4u);
  EXPECT_EQ(round_of(cases, 0.01299).wide, 1u);
  EXPECT_GT(round_of(cases, 0.01299).next, 4u);
}

TEST(NextRound, GoesToTheNumberThatTheScatterAsksFor) {
  // Within 1: t_0.975(4) 0.8165 / sqrt(5) = 1.0138 is too wide, t_0.975(5) 0.8165 / sqrt(6) = 0.8569 is not.
  EXPECT_EQ(round_of({of_case("flat", {{99, 100, 101, 100}})}, 0.01).next, 6u);
}

TEST(NextRound, ButNeverToMoreThanTwiceAsManyNorBeyondTheCap) {
  const auto cases = {of_case("flat", {{80, 120, 90, 110}})};
  EXPECT_EQ(round_of(cases, 0.02).next, 8u);
  EXPECT_GT(round_of(cases, 0.02).needed, 100u);
  EXPECT_EQ(round_of(cases, 0.02, 7).next, 7u);
  const PackingRound last = round_of(cases, 0.02, 4);
  EXPECT_EQ(last.next, 4u);
  EXPECT_EQ(last.wide, 1u);
}

TEST(NextRound, TheWidestBandOfAllCasesDecidesForAllOfThem) {
  const auto narrow = of_case("flat", {{99, 100, 101, 100}}), wide = of_case("conical", {{45, 50, 55, 50}});
  const PackingRound both = round_of({narrow, wide}, 0.05);
  EXPECT_EQ(both.cases, 2u);
  EXPECT_EQ(both.wide, 1u);
  EXPECT_EQ(both.widest_case, wide.labels);
  EXPECT_EQ(both.next, round_of({wide}, 0.05).next);
  EXPECT_EQ(both.next, round_of({wide, narrow}, 0.05).next);
}

TEST(NextRound, OfSeveralWideBandsTheOneThatNeedsMostDecides) {
  // Standard deviations 0.8165 and 0.9798 to within 1: six packings, and t_0.975(6) 0.9798 / sqrt(7) = 0.9062, seven.
  const auto six = of_case("flat", {{99, 100, 101, 100}}), seven = of_case("conical", {{98.8, 100, 101.2, 100}});
  EXPECT_EQ(round_of({six}, 0.01).next, 6u);
  EXPECT_EQ(round_of({six, seven}, 0.01).next, 7u);
  EXPECT_EQ(round_of({seven, six}, 0.01).next, 7u);
  EXPECT_EQ(round_of({seven, six}, 0.01).wide, 2u);
}

// The bins of a curve: a first one that is nearly nothing and scatters as much as the rest is not what is asked about.
TEST(NextRound, ACurveIsMeasuredAgainstItsOwnLevel) {
  const PackingsOfCase curve = of_case("flat", {{0, 2, 1, 1}, {99, 101, 100, 100}});
  const double level = 50.5, half = 1.2992;
  EXPECT_NEAR(round_of({curve}, 0.05).widest, half / level, 1e-5);
  EXPECT_EQ(round_of({curve}, 0.05).wide, 0u);
}

TEST(NextRound, WithoutScatterAnyNumberIsEnoughAndALevelOfNothingIsNeverKnown) {
  EXPECT_EQ(round_of({of_case("flat", {{0, 0}})}, 0.05).wide, 0u);
  EXPECT_EQ(round_of({of_case("flat", {{7, 7}})}, 1e-9).wide, 0u);
  const PackingRound around_zero = round_of({of_case("flat", {{-1, 1}})}, 0.05);
  EXPECT_EQ(around_zero.wide, 1u);
  EXPECT_EQ(around_zero.next, 4u);
}

TEST(NextRound, ACaseOfOnePackingIsNotKnown) {
  const PackingRound round = next_round({of_case("flat", {{1, 1}}), of_case("conical", {{1}})}, 2, {"q_c", 0.05, 24});
  EXPECT_EQ(round.wide, 1u);
  EXPECT_EQ(round.next, 3u);
}

/// The rule on packings that are there to be drawn: the number that it ends at.
std::size_t settled(const Values& packings, std::size_t at_least, const PackingsAsked& asked) {
  std::size_t n = at_least;
  for (;;) {
    const Values so_far(packings.begin(), packings.begin() + static_cast<std::ptrdiff_t>(n));
    const std::size_t next = next_round({of_case("flat", {so_far})}, n, asked).next;
    if (next == n) return n;
    n = next;
  }
}

Values normal_values(std::size_t count, double mean, double sd, std::uint64_t sample) {
  Values values;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t at = 2 * (1000 * sample + i);
    const double radius = std::sqrt(-2 * std::log(1 - base::uniform(13, 1, at)));
    values.push_back(mean + sd * radius * std::cos(2 * std::numbers::pi * base::uniform(13, 1, at + 1)));
  }
  return values;
}

// A sample that stops where it happens to be narrow is a little too sure of itself: with 8 % of scatter and 5 % asked
// for, intervals of 95 % hold the truth in 92 of 100 studies that begin with four packings.
TEST(NextRound, TheBandsThatItEndsWithHoldTheTruthNearlyAsOftenAsTheySay) {
  const PackingsAsked asked = {"q_c", 0.05, 100};
  int covered = 0, narrow = 0;
  double packings = 0;
  constexpr int kStudies = 4000;
  for (std::uint64_t sample = 0; sample < kStudies; ++sample) {
    Values values = normal_values(100, 44, 0.08 * 44, sample);
    values.resize(settled(values, 4, asked));
    const Interval mean = mean_interval(values);
    covered += mean.low < 44 && 44 < mean.high ? 1 : 0;
    narrow += (mean.high - mean.low) / 2 <= 0.05 * mean.mean * (1 + 1e-12) ? 1 : 0;
    packings += static_cast<double>(values.size()) / kStudies;
  }
  EXPECT_EQ(narrow, kStudies);
  EXPECT_NEAR(covered / static_cast<double>(kStudies), 0.92, 0.015);
  EXPECT_NEAR(packings, 12, 1.5) << "sample_for_half_width gives " << *sample_for_half_width(0.08, 0.05);
}

TEST(RoundText, SaysInOneLineWhatFollowsAndWhy) {
  const PackingsAsked asked = {"tip_resistance_mean", 0.05, 24};
  const std::vector<PackingsOfCase> cases = {of_case("flat", {{80, 120, 90, 110}}),
                                             of_case("conical", {{99, 100, 101, 100}})};
  EXPECT_EQ(round_text(next_round(cases, 4, asked), asked),
            "4 packings: tip_resistance_mean is known within ± 29 % at pile.tip=flat, 5 % asked for (1 of 2 cases too "
            "wide): about 54 would do, 8 next");
  EXPECT_EQ(round_text(next_round(cases, 4, {"tip_resistance_mean", 0.05, 4}), {"tip_resistance_mean", 0.05, 4}),
            "4 packings: tip_resistance_mean is known within ± 29 % at pile.tip=flat, 5 % asked for (1 of 2 cases too "
            "wide): about 54 would do, 4 is the most");
  EXPECT_EQ(round_text(next_round({cases[1]}, 4, asked), asked),
            "4 packings: tip_resistance_mean is known within ± 1.3 % at pile.tip=conical, 5 % asked for: enough");
}

}  // namespace
}  // namespace seapile::present
