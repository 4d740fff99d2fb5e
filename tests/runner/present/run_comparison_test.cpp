// Whether two runs can be taken for equal, from what is known of their distance.
#include "runner/present/run_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "runner/store/run_folder.h"
#include "tests/runner/store/sample_run.h"
#include "tests/runner/store/scratch.h"

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

/// A drive whose records say nothing of the tip's resistance.
std::filesystem::path write_without_resistance(const std::filesystem::path& root) {
  const store::RunHeader header = store::sample::drive_header();
  const auto folder = store::case_folder(root, header.case_id) / "0001";
  store::RunWriter writer(folder, header);
  for (simulation::Record record : store::sample::records(0, 20)) {
    record.tip_resistance = std::numeric_limits<double>::quiet_NaN();
    writer.add(record);
  }
  writer.finish(store::sample::drive_result(), store::sample::provenance(), nullptr);
  return folder;
}

TEST(Inequality, AColumnThatOneRunLacksIsSeenThoughFinalStateAndMetricsAreTheSame) {
  const store::Scratch scratch;
  const auto finished = [](const std::filesystem::path& folder) {
    return FinishedRun{folder, store::read_manifest(folder)};
  };
  const FinishedRun whole = finished(store::sample::write(scratch.fresh("whole")).drive);
  const FinishedRun without = finished(write_without_resistance(scratch.fresh("without")));
  EXPECT_EQ(inequality(compare(whole, whole), 0), "");
  EXPECT_EQ(inequality(compare(without, without), 0), "");
  EXPECT_THAT(inequality(compare(whole, without), 1), HasSubstr("tip_resistance"));
  EXPECT_THAT(inequality(compare(without, whole), 1), HasSubstr("tip_resistance"));
}

}  // namespace
}  // namespace seapile::present
