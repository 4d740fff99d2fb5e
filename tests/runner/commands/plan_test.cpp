// `runner plan`: what a study lacks, why, and its price, without a trace.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

TEST(PlanCommand, WithoutHistoryNoPriceIsGuessedAndNothingIsWritten) {
  const Workplace place;
  place.write("small.json", small_study("small"));
  const Finished plan = place.run({"plan", "small.json"});
  EXPECT_EQ(plan.exit_code, 0) << plan.error;
  EXPECT_THAT(plan.out, HasSubstr("never run"));
  EXPECT_THAT(plan.out, HasSubstr("3 cases to run; no history to tell their price by."));
  EXPECT_FALSE(std::filesystem::exists(place.results()));
}

/// A study that has been run, and what is planned after it.
struct PlanAfterRun : testing::Test {
  static void SetUpTestSuite() {
    place = new Workplace;
    place->run_study("small", small_study("small"));
  }
  static void TearDownTestSuite() { delete place; }
  static json cases(std::vector<std::string> more) {
    more.insert(more.begin(), {"plan", "small.json", "--format", "json"});
    return json::parse(place->run(more).out).at("rows");
  }
  static Workplace* place;
};
Workplace* PlanAfterRun::place;

TEST_F(PlanAfterRun, WhatIsFreshIsToldWithItsReasonAndCostsNothing) {
  const Finished plan = place->run({"plan", "small.json"});
  EXPECT_EQ(plan.exit_code, 0);
  EXPECT_THAT(plan.out, HasSubstr("completed with today's numerics"));
  EXPECT_THAT(plan.out, HasSubstr("Nothing to run: every case is fresh."));
  for (const json& row : cases({})) {
    EXPECT_EQ(row.at("action"), "fresh");
    EXPECT_TRUE(row.at("cpu").is_null());
  }
}

TEST_F(PlanAfterRun, PackingsMoreArePricedByThoseThatWereRun) {
  const json rows = cases({"--seeds", "3"});
  ASSERT_EQ(rows.size(), 9U);  // three beds with two drives each, one of them fresh
  std::size_t to_run = 0;
  for (const json& row : rows) {
    if (row.at("action") == "fresh") continue;
    ++to_run;
    EXPECT_EQ(row.at("reason"), "never run");
    EXPECT_GT(row.at("cpu"), 0.0) << row;
    EXPECT_GT(row.at("memory"), 1.0);
    EXPECT_GT(row.at("disk"), 1000.0);
    EXPECT_THAT(row.at("price from").get<std::string>(), HasSubstr("alike"));
  }
  EXPECT_EQ(to_run, 6U);
}

TEST_F(PlanAfterRun, APriceIsThatOfTheRunsItIsMadeFrom) {
  const json past =
      json::parse(place->run({"query", "--where", "kind = drive", "--columns", "pile.tip", "--format", "json"}).out);
  ASSERT_EQ(past.at("rows").size(), 2U);
  const json rows = cases({"--set", "bed.seed=2"});
  double drives = 0;
  for (const json& row : rows) drives += row.at("kind") == "drive" ? row.at("cpu").get<double>() : 0;
  double spent = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(place->results() / "cases")) {
    if (entry.path().filename() != "manifest.json") continue;
    const json manifest = json::parse(content(entry.path()));
    if (manifest.dump().find("\"drive\"") == std::string::npos) continue;
    const std::string text = manifest.dump();
    const auto at = text.find("\"cpu_seconds\":");
    spent = std::max(spent, std::stod(text.substr(at + 14)));
  }
  EXPECT_NEAR(drives, 2 * spent, 1.5 * spent) << "two drives by the median of two runs";
}

TEST_F(PlanAfterRun, ALongerDriveIsScaledAndSaysSo) {
  for (const json& row : cases({"--set", "pile.depth=0.4"})) {
    if (row.at("kind") != "drive") continue;
    EXPECT_THAT(row.at("price from").get<std::string>(), HasSubstr("scaled"));
  }
}

TEST_F(PlanAfterRun, AFinerStepHasNoHistory) {
  const Finished plan = place->run({"plan", "small.json", "--set", "contact.step=1e-4"});
  EXPECT_THAT(plan.out, HasSubstr("no history"));
  EXPECT_EQ(plan.exit_code, 0);
}

TEST_F(PlanAfterRun, OtherRecordsMakeDrivesStaleWithTheReason) {
  const json rows = cases({"--set", "record.frames=[0.05]"});
  for (const json& row : rows) {
    if (row.at("kind") != "drive") continue;
    EXPECT_EQ(row.at("action"), "run");
    EXPECT_THAT(row.at("reason").get<std::string>(), HasSubstr("frame at 0.05 m not recorded"));
  }
}

TEST_F(PlanAfterRun, BadInputIsTwo) {
  EXPECT_EQ(place->run({"plan", "missing.json"}).exit_code, 2);
  EXPECT_EQ(place->run({"plan", "small.json", "--set", "pile.dept=1"}).exit_code, 2);
  const Finished cores = place->run({"run", "small.json", "--jobs", "4000"});
  EXPECT_EQ(cores.exit_code, 2);
  EXPECT_THAT(cores.error, HasSubstr("--oversubscribe"));
}

}  // namespace
}  // namespace seapile::commands
