// What a study claims of its cases against what they came to, through the real program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

using testing::HasSubstr;
using testing::Not;

/// t_0.95(2) and t_0.975(2), of tables: three packings.
constexpr double kOneSided = 2.919986, kTwoSided = 4.302653;

/// Two tips on three packings, run once; what each test claims it writes beside the same results.
struct ClaimCommand : testing::Test {
  static void SetUpTestSuite() {
    ran = new Workplace;
    ran->write("tips.json", small_study("tips", R"("replicates": {"seeds": 3},)"));
    ASSERT_EQ(ran->run({"tips.json"}).exit_code, 0);
    std::map<std::string, std::vector<double>> measured;
    const auto answer = nlohmann::json::parse(ran->run({"query", "tips", "--each", "--format", "json"}).out);
    for (const auto& row : answer.at("rows")) measured[row.at("pile.tip")].push_back(row.at("tip_resistance_mean"));
    for (std::size_t i = 0; i < 3; ++i) logarithms.push_back(std::log(measured["flat"][i] / measured["conical"][i]));
    first = measured["flat"][0];
    mean = (logarithms[0] + logarithms[1] + logarithms[2]) / 3;
    double squares = 0;
    for (const double x : logarithms) squares += (x - mean) * (x - mean);
    error = std::sqrt(squares / 2 / 3);
  }
  static void TearDownTestSuite() { delete ran; }

  /// The study with claims.
  void claims(const std::string& list) const {
    place.write("tips.json", small_study("tips", R"("replicates": {"seeds": 3}, "checks": [)" + list + "],"));
  }
  /// That the flat tip meets more than exp(bound) times the conical one's resistance.
  static std::string flatter(double bound, double margin, const std::string& more = "") {
    return fmt::format(R"({{"claim": "a flat tip meets more resistance", "number": 15, "metric": "tip_resistance_mean",
        "of": {{"pile.tip": "flat"}}, "over": {{"pile.tip": "conical"}}, "at_least": {}, "margin": {}{}}})",
                       std::exp(bound), margin, more);
  }
  Finished check(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"check", "tips.json", "--store", ran->results().string()});
    return place.run(more);
  }
  nlohmann::json row() const { return nlohmann::json::parse(check({"--format", "json"}).out).at("rows").at(0); }

  static Workplace* ran;
  static std::vector<double> logarithms;
  static double mean, error, first;  ///< of ln(flat / conical); the first packing's resistance under the flat tip
  const Workplace place;
};
Workplace* ClaimCommand::ran;
std::vector<double> ClaimCommand::logarithms;
double ClaimCommand::mean, ClaimCommand::error, ClaimCommand::first;

TEST_F(ClaimCommand, IsConfirmedWithItsRatioPackingByPacking) {
  claims(flatter(mean - 1.01 * kOneSided * error, 1e-6));
  const Finished finished = check();
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  EXPECT_THAT(finished.out, HasSubstr("tip flat  tip conical  3  "));
  EXPECT_THAT(finished.out, HasSubstr("  confirmed\n"));
  EXPECT_THAT(finished.out, HasSubstr("claim 15: a flat tip meets more resistance (ratio of tip_resistance_mean)\n"));
  EXPECT_THAT(finished.out, HasSubstr("one-sided at 5 %"));
  EXPECT_NEAR(row().at("value"), std::exp(mean), 1e-9);
  EXPECT_NEAR(row().at("low"), std::exp(mean - kTwoSided * error), 1e-5);
  EXPECT_NEAR(row().at("high"), std::exp(mean + kTwoSided * error), 1e-5);
  EXPECT_EQ(row().at("n"), 3);
  EXPECT_EQ(row().at("number"), 15);
}

TEST_F(ClaimCommand, ARefutedClaimIsAFindingAndNoFailure) {
  claims(flatter(mean + 1.01 * kOneSided * error, 1e-6));
  const Finished finished = check();
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  EXPECT_THAT(finished.out, HasSubstr("  refuted\n"));
  EXPECT_THAT(finished.out, Not(HasSubstr("FAILED")));
}

TEST_F(ClaimCommand, AVerdictThatIsNotTheExpectedExitsThree) {
  claims(flatter(mean + 1.01 * kOneSided * error, 1e-6, R"(, "expect": "confirmed")"));
  const Finished finished = check();
  EXPECT_EQ(finished.exit_code, 3);
  EXPECT_THAT(finished.out, HasSubstr("FAILED  claim 15, pile.tip=flat over pile.tip=conical: refuted, expected "
                                      "confirmed (a flat tip meets more resistance)\n"));
  claims(flatter(mean + 1.01 * kOneSided * error, 1e-6, R"(, "expect": "refuted")"));
  EXPECT_EQ(check().exit_code, 0);
}

TEST_F(ClaimCommand, AnUnderpoweredClaimSaysWhatItTakesAndExitsFourOnlyWhereSomethingIsExpected) {
  const double bound = mean - 0.5 * kOneSided * error;
  claims(flatter(bound, 1e-6));
  const Finished finished = check();
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  EXPECT_THAT(finished.out, testing::ContainsRegex("underpowered  claim 15, pile.tip=flat over pile.tip=conical: "
                                                   "about [0-9]+ packings decide, with a chance of 80 %"));
  EXPECT_GT(row().at("needed"), 3);
  claims(flatter(bound, 1e-6, R"(, "expect": "confirmed")"));
  EXPECT_EQ(check().exit_code, 4);
  EXPECT_THAT(check().out, Not(HasSubstr("FAILED")));
}

TEST_F(ClaimCommand, WithinTwoMarginsItIsNotDistinguishable) {
  claims(flatter(mean, std::expm1(kTwoSided * error / 2 * 1.01)));
  EXPECT_THAT(check().out, HasSubstr("not distinguishable"));
  EXPECT_EQ(check().exit_code, 0);
}

TEST_F(ClaimCommand, ExitsFourWhenResultsAreMissing) {
  claims(flatter(-3, 0.1));
  const Finished nothing = place.run({"check", "tips.json"});
  EXPECT_EQ(nothing.exit_code, 4) << nothing.error;
  EXPECT_THAT(nothing.out, HasSubstr("0 of 3"));
  EXPECT_THAT(nothing.out, HasSubstr("3 of 3 packings have no completed result"));
  EXPECT_EQ(check({"--seeds", "4"}).exit_code, 4);
  EXPECT_EQ(check({"--seeds", "3"}).exit_code, 0);
}

TEST_F(ClaimCommand, OneCaseIsTestedAndEachPackingMayDecideByItself) {
  claims(R"({"claim": "some", "metric": "tip_resistance_mean", "at_least": "1 Pa", "margin": "1 Pa"},
      {"claim": "all", "metric": "bed:solid_fraction", "at_most": 0.5, "deterministic": true, "expect": "refuted"})");
  const auto rows = nlohmann::json::parse(check({"--format", "json"}).out).at("rows");
  ASSERT_EQ(rows.size(), 2u + 6u);
  EXPECT_EQ(rows.at(0).at("verdict"), "confirmed");
  EXPECT_EQ(rows.at(0).at("cases"), "pile.tip=conical");
  EXPECT_EQ(rows.at(7).at("cases"), "pile.tip=flat, bed.seed=3");
  EXPECT_EQ(rows.at(7).at("verdict"), "refuted");
  EXPECT_EQ(check().exit_code, 0);
}

TEST_F(ClaimCommand, StandsBesideChecksAndIsNeverAccepted) {
  const std::string bounds = R"({"metric": "overlap_max", "at_most": 1, "if": {"bed.seed": 1, "pile.tip": "flat"}})";
  claims(bounds + ", " + flatter(-3, 0.1));
  const Finished both = check();
  EXPECT_EQ(both.exit_code, 0) << both.error;
  EXPECT_THAT(both.out, HasSubstr("bounds\n"));
  EXPECT_THAT(both.out, HasSubstr("\nclaims\n"));
  EXPECT_THAT(check({"--accept", "all", "--note", "good"}).out, Not(HasSubstr("tip_resistance_mean")));
  claims(flatter(-3, 0.1));
  EXPECT_EQ(check({"--accept", "all", "--note", "good"}).exit_code, 4);
  EXPECT_EQ(check().exit_code, 0);
}

TEST_F(ClaimCommand, AWrongNameOrUnitEndsWithTwoAndOneLine) {
  const auto refused = [&](const std::string& list, const std::string& why) {
    claims(list);
    const Finished finished = check();
    EXPECT_EQ(finished.exit_code, 2) << finished.out;
    EXPECT_EQ(finished.out, "");
    EXPECT_THAT(finished.error, HasSubstr(why));
    EXPECT_EQ(std::ranges::count(finished.error, '\n'), 1) << finished.error;
  };
  refused(R"({"claim": "c", "metric": "tip_resistence_mean", "at_least": 1, "margin": 1})",
          "tips.json: /checks/0/metric: no finished case has a metric \"tip_resistence_mean\"; allowed: a metric that "
          "`runner show` lists; did you mean \"tip_resistance_mean\"?");
  refused(R"({"claim": "c", "metric": "tip_resistance_mean", "at_least": "1 m", "margin": "1 m"})",
          "tips.json: /checks/0/at_least: is in m, which is not a unit for Pa");
  refused(R"({"claim": "c", "metric": "tip_resistance_mean", "at_most": 1})", "/checks/0: lacks \"margin\"");
}

TEST(ClaimOfABasin, TheValueDecides) {
  const Workplace place;
  place.run_study("wave", R"({"study": "wave", "base": {"basin": {"surface": {"initial": {"cosine": {}}},
      "mesh": {"pattern": {"structured": {"columns": 16, "rows": 4}}}, "time": {"step": 0.01, "duration": 0.2}}},
      "axes": {"basin.viscosity": [0.001, 0.1]}, "record": {"interval": 0.05}, "checks": [
      {"claim": "a viscous wave has no more volume", "metric": "volume_drift", "at_most": 1e-9, "deterministic": true},
      {"claim": "a viscous wave is as high", "metric": "highest", "of": {"basin.viscosity": 0.1},
       "over": {"basin.viscosity": 0.001}, "as": "difference", "at_least": "1 m", "deterministic": true,
       "expect": "refuted"}]})");
  const Finished finished = place.run({"check", "wave.json"});
  EXPECT_EQ(finished.exit_code, 0) << finished.out << finished.error;
  EXPECT_THAT(finished.out, HasSubstr("confirmed"));
  EXPECT_THAT(finished.out, HasSubstr("viscosity 0.1 Pa s  viscosity 0.001 Pa s  1  "));
  EXPECT_THAT(finished.out, HasSubstr("refuted    refuted"));
  EXPECT_THAT(finished.out, Not(HasSubstr("packing")));
}

}  // namespace
}  // namespace seapile::commands
