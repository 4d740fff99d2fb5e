// A study's results against published and accepted values, through the real program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string kOfFile = R"("checks": [{"metric": "tip_resistance_mean", "reference": "reference/tip.csv"}],)";

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Two tips on three packings, run once; what each test checks it writes beside the same results.
struct Check : testing::Test {
  static void SetUpTestSuite() {
    ran = new Workplace;
    ran->write("tips.json", small_study("tips", R"("replicates": {"seeds": 3},)"));
    ASSERT_EQ(ran->run({"tips.json"}).exit_code, 0);
    const auto answer = nlohmann::json::parse(ran->run({"query", "tips", "--each", "--format", "json"}).out);
    for (const auto& row : answer.at("rows")) measured[row.at("pile.tip")].push_back(row.at("tip_resistance_mean"));
  }
  static void TearDownTestSuite() { delete ran; }

  void SetUp() override { fs::create_directories(place.folder() / "reference"); }

  /// The study with more at its top level.
  void study(const std::string& more) const {
    place.write("tips.json", small_study("tips", R"("replicates": {"seeds": 3},)" + more));
  }
  void reference(const std::string& rows) const {
    place.write("reference/tip.csv",
                "# source: Somebody (2024), table 2\n"
                "pile.tip, pile.driving.constant.speed [cm/s], tip_resistance_mean [kPa], tolerance, "
                "reason\n" +
                    rows);
  }
  /// A row beside the measured mean [kPa].
  static std::string row(const std::string& tip, double away, double tolerance) {
    return fmt::format("{}, 40, {}, {}, \"read off, twice\"\n", tip, mean_of(measured[tip]) / 1000 + away, tolerance);
  }
  Finished check(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"check", "tips.json", "--store", ran->results().string()});
    return place.run(more);
  }
  nlohmann::json rows() const { return nlohmann::json::parse(check({"--format", "json"}).out).at("rows"); }
  /// A check of one packing of the flat tip, which is within its tolerance.
  void study_of_one_packing(const std::string& more = "") const {
    study(fmt::format(R"("checks": [{{"metric": "tip_resistance_mean", "value": {}, "tolerance": 1, "source": "hand",
        "if": {{"pile.tip": "flat", "bed.seed": 1}}{}}}],)",
                      measured["flat"][0], more));
  }
  fs::path accepted() const { return place.folder() / "accepted" / "tips.csv"; }

  static Workplace* ran;
  static std::map<std::string, std::vector<double>> measured;
  const Workplace place;
};
Workplace* Check::ran;
std::map<std::string, std::vector<double>> Check::measured;

TEST_F(Check, ExitsZeroWhenEveryMeanIsWithinItsTolerance) {
  study(kOfFile);
  reference(row("flat", 1, 1000) + row("conical", -1, 1000));
  const Finished finished = check();
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  EXPECT_THAT(finished.out, HasSubstr("  ok  "));
  EXPECT_THAT(finished.out, HasSubstr(" ± "));
  EXPECT_THAT(finished.out, HasSubstr("source 1: Somebody (2024), table 2 (reference/tip.csv)"));
  EXPECT_THAT(finished.out, HasSubstr("± is the 95 % interval of the mean over n packings"));
  EXPECT_THAT(finished.out, Not(HasSubstr("FAILED")));
}

TEST_F(Check, ExitsThreeWhenARowFails) {
  study(kOfFile);
  reference(row("flat", 1, 1000) + row("conical", 800, 500));
  const Finished finished = check();
  EXPECT_EQ(finished.exit_code, 3);
  EXPECT_THAT(finished.out, HasSubstr("FAILED  tip_resistance_mean, pile.tip=conical: 800 kPa away"));
  EXPECT_THAT(finished.out, HasSubstr("(read off, twice)"));
}

TEST_F(Check, ComparesTheMeanOverPackingsWithItsInterval) {
  study(kOfFile);
  reference(row("flat", 1, 1000));
  const auto found = rows().at(0);
  const std::vector<double>& v = measured["flat"];
  double squares = 0;
  for (const double x : v) squares += (x - mean_of(v)) * (x - mean_of(v));
  const double half = 4.302653 * std::sqrt(squares / 2) / std::sqrt(3.0);  // t_0.975(2), of a table
  EXPECT_EQ(found.at("n"), 3);
  EXPECT_NEAR(found.at("value"), mean_of(v), 1e-9 * mean_of(v));
  EXPECT_NEAR(found.at("high"), mean_of(v) + half, 1e-6 * mean_of(v));
  EXPECT_NEAR(found.at("difference"), -1000, 1e-6);
  EXPECT_EQ(found.at("unit"), "Pa");
  EXPECT_EQ(found.at("verdict"), "ok");
}

TEST_F(Check, ExitsFourWhenPackingsAreTooFewToDecide) {
  study(kOfFile);
  reference(row("flat", 0, 1e-6));
  const Finished finished = check();
  EXPECT_EQ(finished.exit_code, 4);
  EXPECT_THAT(finished.out, HasSubstr("underpowered"));
}

TEST_F(Check, ExitsFourWhenResultsAreMissingAndWritesNothing) {
  study(kOfFile);
  reference(row("flat", 1, 1000));
  const auto before = everything(place.folder());
  const Finished finished = place.run({"check", "tips.json"});
  EXPECT_EQ(finished.exit_code, 4) << finished.error;
  EXPECT_THAT(finished.out, HasSubstr("0 of 3"));
  EXPECT_THAT(finished.out, HasSubstr("missing"));
  EXPECT_FALSE(fs::exists(place.results()));
  const Finished some = check({"--seeds", "4"});
  EXPECT_EQ(some.exit_code, 4) << some.error;
  EXPECT_THAT(some.out, HasSubstr("3 of 4"));
}

TEST_F(Check, AFailureOutweighsWhatIsMissing) {
  reference(row("flat", 5000, 1000));
  study(
      R"("checks": [{"metric": "tip_resistance_mean", "reference": "reference/tip.csv", "if": {"bed.seed": 1}}, {"metric":
      "tip_resistance_mean", "value": 1, "tolerance": 1e9, "source": "hand", "if": {"bed.seed": 4}}],)");
  // --seeds 4 makes a case that was never run.
  EXPECT_EQ(check({"--seeds", "4"}).exit_code, 3);
}

TEST_F(Check, AStudyWithoutChecksMatchesNothing) {
  study("");
  EXPECT_EQ(check().exit_code, 4);
}

TEST_F(Check, AMetricOfTheBedIsCheckedUnderItsMark) {
  study(R"("checks": [{"metric": "bed:solid_fraction", "value": 0.8, "tolerance": 0.1, "source": "hand",
                       "if": {"bed.seed": 2, "pile.tip": "flat"}}],)");
  EXPECT_EQ(check().exit_code, 0);
  EXPECT_EQ(rows().at(0).at("metric"), "bed:solid_fraction");
  EXPECT_EQ(rows().at(0).at("unit"), "-");
}

TEST_F(Check, EveryWrongInputEndsWithTwoAndOneLineAndNothingIsWritten) {
  study(kOfFile);
  const auto refused = [&](const std::string& why, const std::vector<std::string>& more = {}) {
    const auto before = everything(place.folder());
    const Finished finished = check(more);
    EXPECT_EQ(finished.exit_code, 2) << finished.out;
    EXPECT_EQ(finished.out, "");
    EXPECT_THAT(finished.error, HasSubstr(why));
    const bool of_the_command_line = finished.error.ends_with("Run with --help for more information.\n");
    EXPECT_EQ(std::ranges::count(finished.error, '\n'), of_the_command_line ? 2 : 1) << finished.error;
    auto after = everything(place.folder());
    for (const char* of_the_call : {"out", "error"}) after.erase((place.folder() / of_the_call).string());
    for (const auto& [file, text] : after) EXPECT_EQ(before.at(file), text);
  };
  refused("tips.json: /checks/0/reference: \"reference/tip.csv\" cannot be read");
  reference("flat, 41, 30, 10, x\n");
  refused("/checks/0/reference: \"reference/tip.csv\" line 3: matches no case");
  reference("flat, 40, 30, 0, x\n");
  refused("\"reference/tip.csv\" line 3: tolerance 0 is out of range; allowed: more than 0");
  reference("flat, 40, 30, 10,\n");
  refused("\"reference/tip.csv\" line 3: has no reason for its tolerance");
  const auto direct = [&](const std::string& metric, const std::string& value, const std::string& tolerance) {
    study(fmt::format(R"("checks": [{{"metric": "{}", "value": "{}", "tolerance": "{}", "source": "hand"}}],)", metric,
                      value, tolerance));
  };
  direct("tip_resistence_mean", "30 kPa", "1 kPa");
  refused("/checks/0/metric: no finished case has a metric \"tip_resistence_mean\"");
  refused("did you mean \"tip_resistance_mean\"?");
  direct("tip_resistance_mean", "30 m", "1 m");
  refused("/checks/0/value: is in m, which is not a unit for Pa");
  study_of_one_packing();
  refused("--note", {"--accept", "all"});
  refused("--accept", {"--note", "good"});
  refused("--note: is no line of text", {"--accept", "all", "--note", " "});
  refused("--note: is no line of text", {"--accept", "all", "--note", "two\nlines"});
  refused("begins several case ids", {"--accept", "", "--note", "good"});
  refused("xml", {"--format", "xml"});
  fs::create_directories(place.folder() / "accepted");
  place.write("accepted/tips.csv", "case,value\n");
  refused("accepted/tips.csv: line 1: is not the header");
  refused("accepted/tips.csv: line 1: is not the header", {"--accept", "all", "--note", "good"});
}

TEST_F(Check, AcceptRecordsOurOwnValueWithItsRunItsNumericsAndTheNote) {
  study_of_one_packing();
  const std::string id = rows().at(0).at("case");
  const Finished finished = check({"--accept", id, "--note", "looked at, \"good\""});
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  EXPECT_THAT(finished.out,
              HasSubstr(fmt::format("accepted  tip_resistance_mean of case {}: {} Pa", id, measured["flat"][0])));
  EXPECT_THAT(finished.out, HasSubstr("accepted/tips.csv"));
  const std::string text = content(accepted());
  EXPECT_THAT(text, HasSubstr("case,metric,value,unit,tolerance,run,numerics,note\n" + id));
  EXPECT_THAT(text, HasSubstr(fmt::format(",tip_resistance_mean,{},Pa,1e-06,0001,grains=", measured["flat"][0])));
  EXPECT_THAT(text, HasSubstr(R"(,"looked at, ""good""")"));
  EXPECT_EQ(std::ranges::count(text, '\n'), 2);
}

TEST_F(Check, AcceptingAgainReplacesTheRow) {
  study_of_one_packing(R"(, "drift": 0.001)");
  ASSERT_EQ(check({"--accept", "all", "--note", "first"}).exit_code, 0);
  ASSERT_EQ(check({"--accept", "all", "--note", "second"}).exit_code, 0);
  const std::string text = content(accepted());
  EXPECT_EQ(std::ranges::count(text, '\n'), 2);
  EXPECT_THAT(text, HasSubstr(",0.001,0001,"));
  EXPECT_THAT(text, HasSubstr("second"));
  EXPECT_THAT(text, Not(HasSubstr("first")));
  EXPECT_EQ(std::distance(fs::directory_iterator(accepted().parent_path()), {}), 1) << "something was left aside";
}

TEST_F(Check, WhatWasNotAcceptedYetIsNoFailureAndWhatIsAsAcceptedIsOk) {
  study_of_one_packing();
  const Finished before = check();
  EXPECT_EQ(before.exit_code, 0);
  EXPECT_THAT(before.out, HasSubstr("not accepted yet"));
  ASSERT_EQ(check({"--accept", "all", "--note", "good"}).exit_code, 0);
  const Finished after = check();
  EXPECT_EQ(after.exit_code, 0);
  EXPECT_THAT(after.out, Not(HasSubstr("not accepted yet")));
  EXPECT_EQ(rows().at(1).at("verdict"), "ok");
  EXPECT_EQ(rows().at(1).at("difference"), 0);
}

TEST_F(Check, DriftWithinThePublishedToleranceExitsThree) {
  study_of_one_packing();
  ASSERT_EQ(check({"--accept", "all", "--note", "good"}).exit_code, 0);
  const std::string text = content(accepted()), value = fmt::format("{}", measured["flat"][0]);
  const auto with_value_times = [&](double factor) {
    std::string other = text;
    other.replace(other.find(value), value.size(), fmt::format("{}", measured["flat"][0] * factor));
    place.write("accepted/tips.csv", other);
    return check();
  };
  EXPECT_EQ(with_value_times(1 + 1e-8).exit_code, 0);
  const Finished drifted = with_value_times(1 + 1e-5);
  EXPECT_EQ(drifted.exit_code, 3);
  EXPECT_EQ(rows().at(0).at("verdict"), "ok");
  EXPECT_THAT(drifted.out, HasSubstr("FAILED  tip_resistance_mean, pile.tip=flat, bed.seed=1"));
  EXPECT_THAT(drifted.out, HasSubstr("accepted of run 0001 with grains="));
  EXPECT_THAT(drifted.out, HasSubstr("(good)"));
}

TEST_F(Check, AcceptIsAllOrNothing) {
  study_of_one_packing();
  // In an empty store nothing is finished.
  const Finished nothing = place.run({"check", "tips.json", "--accept", "all", "--note", "good"});
  EXPECT_EQ(nothing.exit_code, 4);
  EXPECT_THAT(nothing.error, HasSubstr("has no completed result with tip_resistance_mean: nothing was accepted"));
  study(R"("checks": [{"metric": "tip_resistance_mean", "value": 1, "tolerance": 1, "source": "hand"}],)");
  const Finished some = check({"--seeds", "4", "--accept", "all", "--note", "good"});
  EXPECT_EQ(some.exit_code, 4);
  EXPECT_FALSE(fs::exists(accepted()));
  EXPECT_EQ(check({"--accept", "ffffffffff", "--note", "good"}).exit_code, 4);
  EXPECT_FALSE(fs::exists(accepted()));
  EXPECT_EQ(check({"--accept", "all", "--note", "good"}).exit_code, 0);
  EXPECT_EQ(std::ranges::count(content(accepted()), '\n'), 7);
}

TEST_F(Check, AFolderThatCannotBeWrittenEndsWithFive) {
  study_of_one_packing();
  place.write("accepted", "a file in the way");
  EXPECT_EQ(check({"--accept", "all", "--note", "good"}).exit_code, 5);
}

TEST_F(Check, AnswersInThreeFormatsWithRemarksBesideTheTable) {
  study(kOfFile);
  reference(row("flat", 5000, 1000));
  const Finished csv = check({"--format", "csv"});
  EXPECT_EQ(csv.exit_code, 3);
  EXPECT_THAT(csv.out, testing::StartsWith("against,metric,case,pile.tip,bed.seed,n,value,low,high,unit,"));
  EXPECT_EQ(std::ranges::count(csv.out, '\n'), 1 + 1 + 3);
  EXPECT_THAT(csv.error, HasSubstr("FAILED"));
  EXPECT_EQ(rows().size(), 4u);
}

TEST_F(Check, ReadsTheFoldersAndNeedsNoCatalogueAndWritesNothingIntoTheStore) {
  study_of_one_packing();
  const Workplace copy;
  fs::copy(ran->results(), copy.results(), fs::copy_options::recursive);
  fs::remove(copy.results() / "catalogue.sqlite");
  const auto before = everything(copy.results());
  EXPECT_EQ(place.run({"check", "tips.json", "--store", copy.results().string()}).exit_code, 0);
  EXPECT_EQ(everything(copy.results()), before);
}

}  // namespace
}  // namespace seapile::commands
