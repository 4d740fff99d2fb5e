#include "runner/study/claim.h"

#include <gmock/gmock.h>

#include "runner/study/problem_text.h"
#include "tests/runner/study/scratch.h"

namespace seapile::study {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Labels = std::vector<std::pair<std::string, std::string>>;

/// Two tips at two speeds on two packings: cases 0 to 7, the tip slowest, the seed fastest.
const std::string kEight = R"("base": {"pile": {}}, "axes": {"pile.tip": ["flat", "conical"],
    "pile.driving.constant.speed": ["6 cm/s", 0.4]}, "replicates": {"seeds": 2})";
const std::string kFaster = R"("of": {"pile.driving.constant.speed": "0.4 m/s"}, "over":
    {"pile.driving.constant.speed": 0.06})";

/// The cases of each packing of a row: {{of, over}, ...}.
std::vector<std::pair<std::size_t, std::size_t>> pairs(const ClaimRow& row) {
  std::vector<std::pair<std::size_t, std::size_t>> all;
  for (const ClaimPair& pair : row.packings) all.emplace_back(pair.of, pair.over.value_or(99));
  return all;
}

class Claims : public Scratch {
 protected:
  /// The claim with these members of the eight cases.
  Claim claim(const std::string& members, const Options& options = {}) const {
    const auto found = study(kEight + with(members), options).claims;
    EXPECT_EQ(found.size(), 1u);
    return found.at(0);
  }
  static std::string with(const std::string& members) {
    return R"(, "checks": [{"claim": "grows", "metric": "q_c", "at_least": 1, )" + members + "}]";
  }
};

TEST_F(Claims, TwoCasesArePairedWhereTheyAgreeInEveryAxisThatIsNotNamed) {
  const Claim found = claim(kFaster + R"(, "margin": 0.05, "number": 12)");
  EXPECT_EQ(found.text, "grows");
  EXPECT_EQ(found.number, 12);
  EXPECT_EQ(found.compared, Compared::ratio);
  EXPECT_EQ(found.pointer, "/checks/0");
  ASSERT_EQ(found.rows.size(), 2u);
  EXPECT_EQ(found.rows[0].common, (Labels{{"pile.tip", "flat"}}));
  EXPECT_EQ(found.rows[0].of, (Labels{{"pile.driving.constant.speed", "0.4 m/s"}}));
  EXPECT_EQ(found.rows[0].over, (Labels{{"pile.driving.constant.speed", "6 cm/s"}}));
  EXPECT_THAT(pairs(found.rows[0]), ElementsAre(std::pair(2u, 0u), std::pair(3u, 1u)));
  EXPECT_THAT(pairs(found.rows[1]), ElementsAre(std::pair(6u, 4u), std::pair(7u, 5u)));
}

TEST_F(Claims, IfLimitsBothSides) {
  const Claim found = claim(kFaster + R"(, "margin": 0.05, "if": {"pile.tip": "conical"})");
  ASSERT_EQ(found.rows.size(), 1u);
  EXPECT_THAT(pairs(found.rows[0]), ElementsAre(std::pair(6u, 4u), std::pair(7u, 5u)));
}

TEST_F(Claims, AnAxisThatOneSideNamesMayDiffer) {
  const Claim found = claim(R"("of": {"pile.tip": "flat", "pile.driving.constant.speed": 0.4}, "over":
      {"pile.tip": "conical", "pile.driving.constant.speed": 0.06}, "margin": 0.05)");
  ASSERT_EQ(found.rows.size(), 1u);
  EXPECT_THAT(pairs(found.rows[0]), ElementsAre(std::pair(2u, 4u), std::pair(3u, 5u)));
  EXPECT_THAT(found.rows[0].common, IsEmpty());
}

// What a side leaves open makes a row for each of its values.
TEST_F(Claims, SeveralPairsOfGroupsAreRows) {
  const Claim found = claim(R"("of": {"pile.tip": "flat"}, "over":
      {"pile.tip": "conical", "pile.driving.constant.speed": 0.06}, "margin": 0.05)");
  ASSERT_EQ(found.rows.size(), 2u);
  EXPECT_THAT(pairs(found.rows[0]), ElementsAre(std::pair(0u, 4u), std::pair(1u, 5u)));
  EXPECT_THAT(pairs(found.rows[1]), ElementsAre(std::pair(2u, 4u), std::pair(3u, 5u)));
}

TEST_F(Claims, AnAxisIsNamedByAPathAboveItOrBelowIt) {
  const Study found =
      study(R"("base": {"pile": {}}, "axes": {"pile.tip": ["flat", {"conical": {"apex_angle": "60 deg"}},
      {"conical": {"apex_angle": "90 deg"}}]}, "replicates": {"seeds": 2}, "checks": [
      {"claim": "c", "metric": "q", "of": {"pile.tip.conical.apex_angle": "90 deg"},
       "over": {"pile.tip.conical.apex_angle": "60 deg"}, "at_least": 1, "margin": 0.1}])");
  ASSERT_EQ(found.claims[0].rows.size(), 1u);
  EXPECT_THAT(pairs(found.claims[0].rows[0]), ElementsAre(std::pair(4u, 2u), std::pair(5u, 3u)));
  const Study below = study(R"("base": {"pile": {}}, "axes": {"pile.driving.constant.speed": [0.1, 0.2]},
      "replicates": {"seeds": 2}, "checks": [{"claim": "c", "metric": "q", "at_least": 1, "margin": 0.1,
      "of": {"pile.driving": {"constant": {"speed": 0.2}}}, "over": {"pile.driving": {"constant": {"speed": 0.1}}}}])");
  EXPECT_THAT(pairs(below.claims[0].rows[0]), ElementsAre(std::pair(2u, 0u), std::pair(3u, 1u)));
}

// A chain is a list of claims.
TEST_F(Claims, AChainIsAListOfClaims) {
  const auto link = [](const char* of, const char* over) {
    return std::string(R"({"claim": "c", "metric": "q", "of": {"pile.depth": )") + of +
           R"(}, "over": {"pile.depth": )" + over + R"(}, "at_least": 1, "margin": 0.1})";
  };
  const auto found = study(R"("base": {"pile": {}}, "axes": {"pile.depth": [1, 1.1, 1.2]}, "checks": [)" +
                           link("1.2", "1.1") + ", " + link("1.1", "1") + "]")
                         .claims;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_THAT(pairs(found[0].rows[0]), ElementsAre(std::pair(2u, 1u)));
  EXPECT_THAT(pairs(found[1].rows[0]), ElementsAre(std::pair(1u, 0u)));
}

TEST_F(Claims, WithoutOverEveryCaseIsComparedWithTheBoundOverItsPackings) {
  const Claim all = claim(R"("margin": 0.05)");
  EXPECT_EQ(all.compared, Compared::value);
  ASSERT_EQ(all.rows.size(), 4u);
  EXPECT_THAT(pairs(all.rows[1]), ElementsAre(std::pair(2u, 99u), std::pair(3u, 99u)));
  const Claim some = claim(R"("of": {"pile.tip": "flat", "pile.driving.constant.speed": 0.4}, "margin": 0.05)");
  ASSERT_EQ(some.rows.size(), 1u);
  EXPECT_THAT(pairs(some.rows[0]), ElementsAre(std::pair(2u, 99u), std::pair(3u, 99u)));
}

TEST_F(Claims, WhereTheValueDecidesEveryPackingIsARow) {
  const Claim found = claim(kFaster + R"(, "deterministic": true, "if": {"pile.tip": "flat"})");
  ASSERT_EQ(found.rows.size(), 2u);
  EXPECT_THAT(pairs(found.rows[0]), ElementsAre(std::pair(2u, 0u)));
  EXPECT_EQ(found.rows[0].common, (Labels{{"pile.tip", "flat"}, {"bed.seed", "1"}}));
  EXPECT_THAT(pairs(found.rows[1]), ElementsAre(std::pair(3u, 1u)));
  const Study jets = study(R"("base": {"jet": {}}, "axes": {"jet.reynolds": [24, 29]}, "checks": [{"claim": "c",
      "metric": "q", "of": {"jet.reynolds": 29}, "over": {"jet.reynolds": 24}, "at_most": 1, "deterministic": true}])");
  EXPECT_THAT(pairs(jets.claims[0].rows.at(0)), ElementsAre(std::pair(1u, 0u)));
}

TEST_F(Claims, UnitsAreOfTheBoundAndARatioHasNone) {
  const Claim value = study(kEight + R"(, "checks": [{"claim": "c", "metric": "q_c", "at_most": "44 kPa",
      "margin": "500 Pa", "expect": "refuted"}])")
                          .claims.at(0);
  EXPECT_FALSE(value.at_least);
  EXPECT_EQ(value.bound, 44);
  EXPECT_EQ(value.margin, 0.5);
  EXPECT_EQ(value.unit, "kPa");
  EXPECT_EQ(value.expect, "refuted");
  const Claim ratio = claim(kFaster + R"(, "margin": "5 %")");
  EXPECT_EQ(ratio.margin, 0.05);
  EXPECT_EQ(ratio.unit, "");
  const Claim difference = claim(kFaster + R"(, "margin": 2, "as": "difference")");
  EXPECT_EQ(difference.compared, Compared::difference);
}

TEST_F(Claims, WhatTheCommandLineTakesAwayIsNoProblem) {
  EXPECT_THAT(claim(kFaster + R"(, "margin": 0.05)", {{"pile.driving.constant.speed=0.4"}, {}}).rows, IsEmpty());
  const Claim more = claim(kFaster + R"(, "margin": 0.05)", {{}, 5});
  EXPECT_EQ(more.rows.at(0).packings.size(), 5u);
}

TEST_F(Claims, TheExamplesOfTheDocumentationAreRead) {
  std::ifstream file(SEAPILE_SOURCE_DIR "/docs/study.md");
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  const std::size_t from = page.rfind("\"checks\": [");
  const auto found = study(kEight + ", " + page.substr(from, page.find("```", from) - from)).claims;
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].number, 12);
  EXPECT_EQ(found[0].rows.size(), 2u);
  EXPECT_EQ(found[1].rows.size(), 1u);
  EXPECT_EQ(found[1].expect, "confirmed");
  EXPECT_EQ(found[2].rows.size(), 2u);
  EXPECT_EQ(found[3].rows.size(), 8u);
}

TEST_F(Claims, StandAmongChecksAndChangeNoIdentity) {
  const Study without = study(kEight);
  const Study with = study(kEight + R"(, "checks": [{"metric": "q_c", "at_most": 1}, {"claim": "c", "metric": "q_c",
      "at_most": 1, "margin": 1}, {"metric": "q_c", "at_least": 0}])");
  EXPECT_EQ(with.checks.size(), 2u);
  ASSERT_EQ(with.claims.size(), 1u);
  EXPECT_EQ(with.claims[0].pointer, "/checks/1");
  ASSERT_EQ(with.cases.size(), without.cases.size());
  for (std::size_t i = 0; i < with.cases.size(); ++i) EXPECT_EQ(with.cases[i].canonical, without.cases[i].canonical);
}

}  // namespace
}  // namespace seapile::study
