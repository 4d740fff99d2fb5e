// A study that asks for as many packings as narrow a band, through the real program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Two tips until the metric is known within a share of itself.
std::string until(const std::string& metric, double half_width, int at_least, int at_most,
                  const std::string& more = "") {
  std::ostringstream rule;
  rule << R"("replicates": {"at_least": )" << at_least << R"(, "at_most": )" << at_most << R"(, "metric": ")" << metric
       << R"(", "half_width": )" << half_width << "}," << more;
  return small_study("tips", rule.str());
}

/// The lines that say what a round decided.
std::vector<std::string> decisions(const Finished& finished) {
  std::vector<std::string> lines;
  std::istringstream text(finished.error);
  for (std::string line; std::getline(text, line);) {
    if (line.find(" packings: ") != std::string::npos) lines.push_back(line);
  }
  return lines;
}

std::ptrdiff_t run_folders(const Workplace& place) {
  return std::distance(fs::directory_iterator(place.results() / "cases"), {});
}

/// Run once: two packings at first, six at most, and a band that these beds of 200 grains do not reach.
struct Packings : testing::Test {
  static void SetUpTestSuite() {
    place = new Workplace;
    place->write("tips.json", until("tip_resistance_mean", 0.01, 2, 6));
    first = new Finished(place->run({"tips.json"}));
  }
  static void TearDownTestSuite() {
    delete first;
    delete place;
  }
  /// Another rule on the same store.
  static Finished again(const std::string& study, std::vector<std::string> more = {}) {
    place->write("tips.json", study);
    more.insert(more.begin(), "tips.json");
    return place->run(more);
  }
  static Workplace* place;
  static Finished* first;
};
Workplace* Packings::place;
Finished* Packings::first;

TEST_F(Packings, AreRunRoundAfterRoundUpToTheCapAndEachRoundSaysWhy) {
  ASSERT_EQ(first->exit_code, 0) << first->error;
  EXPECT_THAT(decisions(*first),
              ElementsAre(testing::AllOf(testing::StartsWith("2 packings: tip_resistance_mean is known within ± "),
                                         HasSubstr(", 1 % asked for"), testing::EndsWith(", 4 next")),
                          testing::AllOf(testing::StartsWith("4 packings: "), testing::EndsWith(", 6 next")),
                          testing::AllOf(testing::StartsWith("6 packings: "), testing::EndsWith(", 6 is the most"))));
  EXPECT_EQ(run_folders(*place), 6 + 2 * 6) << "six beds and twelve drives";
  const auto answer = nlohmann::json::parse(place->run({"query", "tips", "--format", "json"}).out);
  EXPECT_EQ(answer.at("rows").at(0).at("n"), 6);
}

TEST_F(Packings, TheSameCommandFindsItAllDoneAndEndsAtTheSameNumber) {
  const Finished second = again(until("tip_resistance_mean", 0.01, 2, 6));
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_EQ(decisions(second), decisions(*first));
  EXPECT_EQ(second.out, first->out);
  EXPECT_THAT(second.error, HasSubstr("nothing to run: every case is fresh"));
  EXPECT_THAT(second.error, Not(HasSubstr("started")));
}

TEST_F(Packings, AHigherCapGoesOnWhereALowerOneEnded) {
  const Workplace other;
  other.write("tips.json", until("tip_resistance_mean", 0.01, 2, 4));
  EXPECT_EQ(decisions(other.run({"tips.json"})).size(), 2u);
  other.write("tips.json", until("tip_resistance_mean", 0.01, 2, 6));
  const Finished more = other.run({"tips.json", "--jobs", "1"});
  EXPECT_EQ(decisions(more), decisions(*first)) << "in another order, and in two commands";
  EXPECT_EQ(more.out.substr(0, more.out.find("  0.")), first->out.substr(0, first->out.find("  0.")));
}

TEST_F(Packings, AWiderBandIsReachedWithFewerAndAskedForNoMore) {
  // Of two packings no band is narrow; of three or four it is within 100 %.
  const Finished wide = again(until("tip_resistance_mean", 1, 2, 6));
  ASSERT_EQ(decisions(wide).size(), 2u);
  EXPECT_THAT(decisions(wide).back(), testing::EndsWith("100 % asked for: enough"));
  const auto answer = nlohmann::json::parse(place->run({"query", "tips", "--format", "json"}).out);
  EXPECT_EQ(answer.at("rows").at(0).at("n"), std::stoi(decisions(wide).back()));
  EXPECT_LT(answer.at("rows").at(0).at("n"), 6);
}

TEST_F(Packings, OfACurveEveryBinCountsThatAllPackingsReach) {
  const Finished curve = again(until("tip_resistance_bin_*", 0.01, 4, 6));
  EXPECT_EQ(curve.exit_code, 0) << curve.error;
  ASSERT_EQ(decisions(curve).size(), 2u);
  EXPECT_THAT(decisions(curve)[0], HasSubstr("tip_resistance_bin_* is known within"));
  const Finished bed = again(until("bed:solid_fraction", 0.5, 2, 6));
  EXPECT_THAT(decisions(bed), ElementsAre(testing::EndsWith("50 % asked for: enough")));
}

TEST_F(Packings, AreTheCasesOfThatNumberOfSeeds) {
  const Finished seeds = again(small_study("tips", R"("replicates": {"seeds": 6},)"));
  EXPECT_THAT(seeds.error, HasSubstr("nothing to run"));
  EXPECT_TRUE(decisions(seeds).empty());
  EXPECT_EQ(seeds.out, first->out);
}

TEST_F(Packings, TheCommandLineReplacesTheRule) {
  const Finished two = again(until("tip_resistance_mean", 0.01, 4, 6), {"--seeds", "2"});
  EXPECT_EQ(two.exit_code, 0);
  EXPECT_TRUE(decisions(two).empty());
  EXPECT_THAT(two.error, HasSubstr("nothing to run"));
}

TEST_F(Packings, CheckJudgesThePackingsThatTheRuleHasComeTo) {
  const std::string claim = R"("checks": [{"claim": "some", "metric": "tip_resistance_mean", "at_least": "1 Pa",
      "margin": "1 Pa", "of": {"pile.tip": "flat"}}],)";
  const auto n = [&](const std::string& study) {
    place->write("tips.json", study);
    const Finished finished = place->run({"check", "tips.json", "--format", "json"});
    EXPECT_EQ(finished.exit_code, 0) << finished.error;
    return nlohmann::json::parse(finished.out).at("rows").at(0).at("n").get<int>();
  };
  EXPECT_EQ(n(until("tip_resistance_mean", 0.01, 2, 6, claim)), 6);
  EXPECT_LT(n(until("tip_resistance_mean", 1, 2, 6, claim)), 6);
  // Of a round that is still to come results are missing.
  place->write("tips.json", until("tip_resistance_mean", 0.01, 2, 7, claim));
  const Finished missing = place->run({"check", "tips.json"});
  EXPECT_EQ(missing.exit_code, 4);
  EXPECT_THAT(missing.out, HasSubstr("6 of 7"));
}

TEST_F(Packings, ADryRunSaysWhatTheNextRoundRunsAndWritesNothing) {
  const auto before = everything(place->results());
  const Finished dry = again(until("tip_resistance_mean", 0.01, 2, 7), {"--dry-run"});
  EXPECT_EQ(dry.exit_code, 0);
  EXPECT_EQ(decisions(dry).size(), 2u);
  EXPECT_THAT(decisions(dry).back(), testing::EndsWith(", 7 next"));
  EXPECT_THAT(dry.error, HasSubstr("run     3 cases: never run"));
  EXPECT_EQ(everything(place->results()), before);
}

TEST_F(Packings, AMetricThatNoCaseHasIsToldInOneLine) {
  const Finished wrong = again(until("tip_resistence_mean", 0.01, 2, 6));
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_EQ(wrong.error,
            "tips.json: /replicates/metric: no finished case has a metric \"tip_resistence_mean\"; allowed: a metric "
            "that `runner show` lists; did you mean \"tip_resistance_mean\"?\n");
  const std::string less_deep = R"("when": [{"if": {"pile.tip": "flat"}, "set": {"pile.depth": "0.15 m"}}],)";
  EXPECT_THAT(again(until("tip_resistance_bin_0.20", 0.01, 2, 6, less_deep)).error,
              HasSubstr("tips.json: /replicates/metric: \"tip_resistance_bin_0.20\" is no number in every packing of "
                        "pile.tip=flat; allowed: a metric that every case has\n"));
}

TEST_F(Packings, ARoundThatIsNotDoneAsksForNoMore) {
  const Workplace other;
  const auto rows = nlohmann::json::parse(place
                                              ->run({"query", "--where", "bed.seed = 2", "--where", "pile.tip = flat",
                                                     "--where", "pile.depth = 0.3", "--format", "json"})
                                              .out);
  const std::string id = rows.at("rows").at(0).at("case");
  fs::create_directories(other.results() / "cases");
  for (const auto& entry : fs::directory_iterator(place->results() / "cases")) {
    const std::string name = entry.path().filename();
    // A file where the second packing's folder should be.
    if (name.starts_with(id)) std::ofstream(other.results() / "cases" / name) << "in the way";
  }
  other.write("tips.json", until("tip_resistance_mean", 0.01, 2, 6));
  const Finished failed = other.run({"tips.json"});
  EXPECT_NE(failed.exit_code, 0);
  EXPECT_TRUE(decisions(failed).empty()) << failed.error;
  EXPECT_THAT(failed.error, HasSubstr("this round is not done: no more packings are asked for"));
}

}  // namespace
}  // namespace seapile::commands
