// Whether two runs can be taken for equal, from what is known of their distance.
#include "runner/present/run_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace seapile::present {
namespace {

using testing::HasSubstr;

/// Two runs with a metric and a curve, a ten-millionth apart.
RunComparison close_runs() {
  RunComparison comparison;
  comparison.state_a = "0123456789abcdef";
  comparison.state_b = "fedcba9876543210";
  comparison.metrics = {{"q_c", "Pa", 1, 1, 0}};
  comparison.curves = {{"tip_resistance", "Pa", "depth", "m", {0, 1, 1e-7, 1, 0.5}}};
  comparison.largest = 1e-7;
  comparison.largest_of = "tip_resistance";
  return comparison;
}

std::string objection(const std::function<void(RunComparison&)>& change, double tolerance = 1e-6) {
  RunComparison comparison = close_runs();
  change(comparison);
  return inequality(comparison, tolerance);
}

TEST(Inequality, TheLargestDistanceIsWhatAToleranceIsAbout) {
  const auto as_they_are = [](RunComparison&) {};
  EXPECT_EQ(objection(as_they_are, 1e-6), "");
  EXPECT_EQ(objection(as_they_are, 1e-7), "") << "its end included";
  EXPECT_EQ(objection(as_they_are, 0.99e-7), "tip_resistance differs by 1e-07");
  EXPECT_EQ(objection(as_they_are, 0), "tip_resistance differs by 1e-07");
}

TEST(Inequality, WithoutAToleranceTheFinalStateCountsToo) {
  const auto same_numbers = [](RunComparison& one) { one.largest = 0, one.largest_of = ""; };
  EXPECT_EQ(objection(same_numbers, 0), "their final states differ");
  EXPECT_EQ(objection(same_numbers, 1e-12), "");
  const auto identical = [&](RunComparison& one) { same_numbers(one), one.likeness = Likeness::identical; };
  EXPECT_EQ(objection(identical, 0), "");
}

TEST(Inequality, WhatOneOfThemLacksIsNeverWithinATolerance) {
  const auto with = [](auto change) {
    // Not even where the final states are the same.
    return objection([&](RunComparison& one) { one.likeness = Likeness::identical, change(one); }, 1e9);
  };
  EXPECT_EQ(with([](RunComparison&) {}), "");
  EXPECT_THAT(with([](RunComparison& one) {
                one.metrics.push_back({"steps", "-", 1, 0, std::numeric_limits<double>::quiet_NaN()});
              }),
              HasSubstr("steps"));
  EXPECT_THAT(with([](RunComparison& one) { one.uncompared = {"pile_work"}; }), HasSubstr("pile_work"));
  EXPECT_EQ(with([](RunComparison& one) { one.differ_alone = {"completed and diverged"}; }), "completed and diverged");
  EXPECT_THAT(with([](RunComparison& one) { one.metrics.clear(), one.curves.clear(); }), HasSubstr("nothing"));
}

}  // namespace
}  // namespace seapile::present
