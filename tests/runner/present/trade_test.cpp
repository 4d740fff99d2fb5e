#include "runner/present/trade.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "runner/present/trade_figure.h"
#include "runner/present/trade_table.h"

namespace seapile::present {
namespace {

using testing::DoubleNear;
using testing::HasSubstr;
using testing::Not;

VariantRun run(int packing, std::vector<std::vector<double>> value, double cpu) {
  return {std::to_string(packing), std::move(value), "", cpu, 10, 100};
}

/// A number and a curve of three bins; the variants differ from the reference by `shift` and a scatter of `sd`.
TradedGroup group(double shift, double sd, int packings) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  TradedGroup group{{}, {"q", "bin_*"}, "reference", {{"reference", {}}, {"other", {}}}};
  for (int s = 0; s < packings; ++s) {
    const double level = 10 + 3 * normal(random);  // of the packing: cancels
    group.variants[0].runs.push_back(run(s, {{level}, {level, 2 * level, 2 * level}}, 8));
    const double q = level + 10 * (shift + sd * normal(random));
    group.variants[1].runs.push_back(run(
        s, {{q}, {level + 10 * sd * normal(random), 2 * level + 30 * shift, 2 * level + 30 * sd * normal(random)}}, 2));
  }
  return group;
}

TEST(Trade, AnErrorIsTheMeanOfPairsAndWhatPackingsShareCancels) {
  const auto levels = judge(group(0.2, 0, 8));
  EXPECT_THAT(levels[1].errors[0].error.mean, DoubleNear(0.2, 0.05));
  EXPECT_LT(levels[1].errors[0].error.high - levels[1].errors[0].error.low, 1e-12);
  EXPECT_EQ(levels[0].errors[0].n, 0u) << "the reference is not compared with itself";
  EXPECT_EQ(levels[1].cost, 0.25);
  EXPECT_EQ(levels[1].cpu_seconds, 2);
}

TEST(Trade, OfACurveItIsANormOverItsBins) {
  // One bin of three is off by 6, the curve is (10, 20, 20) long 30 but for the packings' level.
  TradedGroup exact{{}, {"bin_*"}, "reference", {{"reference", {}}, {"other", {}}}};
  for (int s = 0; s < 4; ++s) {
    exact.variants[0].runs.push_back(run(s, {{10, 20, 20}}, 1));
    exact.variants[1].runs.push_back(run(s, {{10, 26, 20}}, 1));
  }
  const TradeError error = judge(exact)[1].errors[0];
  EXPECT_DOUBLE_EQ(error.error.mean, 0.2);
  EXPECT_DOUBLE_EQ(error.bound, 0.2);
  EXPECT_DOUBLE_EQ(error.chance, 1.0 / 8) << "of eight choices of signs one is as large, up to all signs";
}

TEST(Trade, WhatIsNoMoreThanChanceIsSaid) {
  const auto same = judge(group(0, 0.1, 10)), other = judge(group(0.2, 0.1, 10));
  EXPECT_GT(same[1].errors[0].chance, 0.05);
  EXPECT_GT(same[1].errors[1].chance, 0.05);
  EXPECT_LT(other[1].errors[0].chance, 0.01);
  EXPECT_LT(other[1].errors[1].chance, 0.01);
  EXPECT_THAT(trade_text({group(0, 0.1, 10)}, false), HasSubstr("q is not distinguishable from \"reference\""));
  EXPECT_THAT(trade_text({group(0.2, 0.1, 10)}, false), Not(HasSubstr("not distinguishable")));
  EXPECT_THAT(trade_text({group(3, 0.1, 5)}, false), Not(HasSubstr("not distinguishable")))
      << "five signs tell nothing";
}

// Of studies in which nothing differs, one in twenty is called different; and bounds hold the truth in 19 of 20.
TEST(Trade, IsAsSureOfItselfAsItSays) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  int different = 0, held = 0;
  constexpr int kStudies = 1000;
  for (int k = 0; k < kStudies; ++k) {
    std::vector<std::vector<double>> pairs(8, std::vector<double>(4));
    for (auto& row : pairs)
      for (double& value : row) value = normal(random);
    different += sign_flip_chance(pairs) <= kAlpha;

    TradedGroup one{{}, {"bin_*"}, "reference", {{"reference", {}}, {"other", {}}}};
    for (int s = 0; s < 8; ++s) {
      one.variants[0].runs.push_back(run(s, {{1, 0, 0}}, 1));
      one.variants[1].runs.push_back(
          run(s, {{1.3 + 0.2 * normal(random), 0.2 * normal(random), 0.2 * normal(random)}}, 1));
    }
    held += judge(one)[1].errors[0].bound >= 0.3;
  }
  EXPECT_NEAR(different / static_cast<double>(kStudies), 0.05, 0.02);
  EXPECT_GE(held / static_cast<double>(kStudies), 0.95);
}

TEST(Trade, TheFrontierIsWhatNothingIsCheaperAndCloserThan) {
  TradedGroup four{{}, {"error"}, "", {{"exact", {}}, {"good", {}}, {"dear", {}}, {"cheap", {}}, {"broken", {}}}};
  const double error[] = {0, 0.01, -0.02, 0.5, 0.001}, cpu[] = {100, 10, 20, 1, 0.1};
  for (int v = 0; v < 5; ++v) four.variants[v].runs.push_back(run(0, {{error[v]}}, cpu[v]));
  four.variants[4].runs[0].failure = "diverged: it broke";
  const auto levels = judge(four);
  for (int v = 0; v < 5; ++v) EXPECT_EQ(levels[v].on_frontier[0], v == 0 || v == 1 || v == 3) << four.variants[v].name;
  EXPECT_EQ(levels[2].errors[0].bound, 0.02) << "exact: a single value is its own bound";
  EXPECT_THAT(trade_text({four}, false), HasSubstr("broken: 1 of 1 runs have no result: diverged: it broke"));
  const std::string script = gnuplot_script("t", four, 0);
  EXPECT_THAT(script, HasSubstr("broken (no result)"));
  EXPECT_THAT(script, HasSubstr("set logscale xy"));
}

TEST(Trade, ARunWithoutItsPairIsNotCompared) {
  TradedGroup one = group(0.1, 0, 4);
  one.variants[0].runs[2].failure = "never run";
  one.variants[1].runs[3].failure = "diverged: x";
  const auto levels = judge(one);
  EXPECT_EQ(levels[1].errors[0].n, 2u);
  EXPECT_EQ(levels[1].completed, 3u);
  EXPECT_EQ(levels[1].asked, 4u);
}

// Where nothing is left to chance a single run has an error with a bound, and the reference's own is part of it.
TEST(Trade, WaterIsCertainUpToTheReferencesOwnError) {
  const auto run = [](double value) { return VariantRun{"", {{value}}, "", 1, 1, 1}; };
  TradedGroup water{{},        {"chi"},
                    "finest",  {{"finest", {run(1)}}, {"coarser", {run(1.01)}}, {"other", {run(0.95)}}},
                    "coarser", false};
  std::vector<TradeLevel> levels = judge(water);
  EXPECT_NEAR(levels[2].errors[0].error.mean, -0.05, 1e-15);
  EXPECT_NEAR(levels[2].errors[0].bound, 0.06, 1e-15);
  EXPECT_NEAR(levels[1].errors[0].bound, 0.02, 1e-15);
  water.by_chance = true;
  EXPECT_TRUE(std::isnan(judge(water)[2].errors[0].bound)) << "of one packing nothing is known";
}

}  // namespace
}  // namespace seapile::present
