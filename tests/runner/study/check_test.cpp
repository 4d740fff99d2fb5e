#include "runner/study/check.h"

#include <gmock/gmock.h>

#include "runner/study/problem_text.h"
#include "tests/runner/study/scratch.h"

namespace seapile::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Two tips at two speeds on two packings: cases 0 to 7, the tip slowest, the seed fastest.
const std::string kEight = R"("base": {"pile": {}}, "axes": {"pile.tip": ["flat", "conical"],
    "pile.driving.constant.speed": ["6 cm/s", 0.4]}, "replicates": {"seeds": 2})";

class Checks : public Scratch {
 protected:
  void reference(const std::string& rows,
                 const std::string& header = "pile.tip,pile.driving.constant.speed [m/s]") const {
    write("reference/tip.csv", "# source: Somebody (2024)\n" + header + ",q_c [kPa],tolerance,reason\n" + rows);
  }
  /// The checks of the eight cases.
  std::vector<Check> checks(const std::string& list, const Options& options = {}) const {
    return study(kEight + R"(, "checks": )" + list, options).checks;
  }
  std::string problem(const std::string& list, const Options& options = {}) const {
    const auto found = problems(kEight + R"(, "checks": )" + list, options);
    EXPECT_EQ(found.size(), 1u);
    return found.empty() ? "" : sentence("s", found[0]);
  }
};

const std::string kOfFile = R"([{"metric": "q_c", "reference": "reference/tip.csv"}])";

TEST_F(Checks, ARowIsOfTheCasesThatHaveItsValues) {
  reference("conical,0.06,44.3,1,read off\nflat,0.4,72,2,read off\n");
  const auto found = checks(kOfFile);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].metric, "q_c");
  EXPECT_EQ(found[0].source, "Somebody (2024) (reference/tip.csv)");
  EXPECT_EQ(found[0].drift, 1e-6);
  ASSERT_EQ(found[0].references.size(), 2u);
  EXPECT_THAT(found[0].references[0].cases, ElementsAre(4, 5));
  EXPECT_THAT(found[0].references[1].cases, ElementsAre(2, 3));
  EXPECT_EQ(found[0].references[1].place, "\"reference/tip.csv\" line 4");
}

// The study says "6 cm/s", a scene holds 0.06, the file says 60 mm/s.
TEST_F(Checks, ValuesAreComparedAsNumbersHoweverTheyAreWritten) {
  reference("60,44.3,1,read off\n", "pile.driving.constant.speed [mm/s]");
  EXPECT_THAT(checks(kOfFile)[0].references[0].cases, ElementsAre(0, 1, 4, 5));
}

TEST_F(Checks, ADefaultIsAValueOfTheSceneToo) {
  reference("1.2,44.3,1,read off\n", "pile.depth [m]");
  EXPECT_EQ(checks(kOfFile)[0].references[0].cases.size(), 8u);
}

TEST_F(Checks, AValueInTheStudyIsOfEveryCaseOrOfThoseOfItsCondition) {
  const auto found = checks(R"([
    {"metric": "q_c", "value": "44.3 kPa", "tolerance": "1500 Pa", "source": "hand", "drift": 1e-3},
    {"metric": "q_c", "value": 44300, "tolerance": 1500, "source": "hand", "if": {"pile.tip": "flat", "bed.seed": 2}}])");
  EXPECT_EQ(found[0].references[0].cases.size(), 8u);
  EXPECT_EQ(found[0].references[0].value, 44.3);
  EXPECT_EQ(found[0].references[0].unit, "kPa");
  EXPECT_EQ(found[0].references[0].tolerance, 1.5);
  EXPECT_EQ(found[1].references[0].tolerance, 1500);
  EXPECT_EQ(found[1].references[0].unit, "");
  EXPECT_EQ(found[0].source, "hand");
  EXPECT_EQ(found[0].drift, 1e-3);
  EXPECT_THAT(found[1].references[0].cases, ElementsAre(1, 3));
}

TEST_F(Checks, BoundsAreOfEveryCaseOrOfThoseOfTheirCondition) {
  const auto found = checks(R"([
    {"metric": "drift", "at_most": 1e-10},
    {"metric": "q_c", "at_least": "1 kPa", "at_most": "2000 Pa", "source": "hand", "if": {"pile.tip": "flat"}}])");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].references[0].at_most, 1e-10);
  EXPECT_FALSE(found[0].references[0].at_least);
  EXPECT_EQ(found[0].references[0].cases.size(), 8u);
  EXPECT_EQ(found[0].source, "");
  EXPECT_EQ(found[1].references[0].at_least, 1);
  EXPECT_EQ(found[1].references[0].at_most, 2);
  EXPECT_EQ(found[1].references[0].unit, "kPa");
  EXPECT_EQ(found[1].references[0].cases.size(), 4u);
}

TEST_F(Checks, AConditionLimitsTheRowsOfAFileAsWell) {
  reference("0.06,44.3,1,read off\n", "pile.driving.constant.speed [m/s]");
  EXPECT_THAT(checks(R"([{"metric": "q_c", "reference": "reference/tip.csv", "if": {"pile.tip": "conical"}}])")[0]
                  .references[0]
                  .cases,
              ElementsAre(4, 5));
}

TEST_F(Checks, ARowThatMatchesNoCaseIsBadInputWithItsLine) {
  reference("conical,0.06,44.3,1,read off\nflat,0.5,72,2,read off\n");
  EXPECT_EQ(problem(kOfFile),
            "s: /checks/0/reference: \"reference/tip.csv\" line 4: matches no case; allowed: values that a case has");
}

TEST_F(Checks, WhatTheCommandLineTakesAwayIsNoProblem) {
  reference("conical,0.06,44.3,1,read off\nflat,0.4,72,2,read off\n");
  EXPECT_THAT(checks(kOfFile, {{"pile.tip=flat"}, {}})[0].references.size(), 1u);
  EXPECT_THAT(checks(kOfFile, {{"pile.depth=0.3 m"}, {}})[0].references.size(), 2u);
  reference("2,44.3,1,read off\n", "bed.seed");
  EXPECT_THAT(checks(kOfFile, {{}, 1})[0].references, IsEmpty());
}

TEST_F(Checks, EveryProblemOfFileAndStudyIsToldAtOnce) {
  reference("conical,0.06,44.3,0,read off\nflat,0.4,72,2,\n");
  const auto found =
      problems(kEight + R"(, "fidelity": "drafty", "checks": [{"metric": "q_c", "reference": "reference/tip.csv"},
      {"metric": "q_c", "reference": "reference/absent.csv"}])");
  std::vector<std::string> pointers;
  for (const auto& problem : found) pointers.push_back(problem.pointer);
  EXPECT_THAT(pointers, ElementsAre("/fidelity", "/checks/0/reference", "/checks/0/reference", "/checks/1/reference"));
}

TEST_F(Checks, NullAndAnEmptyListAskForNothing) {
  EXPECT_THAT(checks("null"), IsEmpty());
  EXPECT_THAT(checks("[]"), IsEmpty());
}

TEST_F(Checks, TheExamplesOfTheDocumentationAreRead) {
  std::ifstream file(SEAPILE_SOURCE_DIR "/docs/study.md");
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  const auto block = [&](const std::string& start) {
    const std::size_t from = page.find(start);
    return from == std::string::npos ? "" : page.substr(from, page.find("```", from) - from);
  };
  write("reference/tip.csv", block("# source:"));
  const auto found = study(kEight + ", " + block("\"checks\": [")).checks;
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].references.size(), 2u);
  EXPECT_THAT(found[1].references[0].cases, ElementsAre(4, 5, 6, 7));
  EXPECT_EQ(found[2].references[0].at_most, 0.05);
}

TEST_F(Checks, ChangeNoIdentity) {
  reference("conical,0.06,44.3,1,read off\n");
  const Study without = study(kEight);
  const Study with = study(kEight + R"(, "checks": )" + kOfFile);
  ASSERT_EQ(with.cases.size(), without.cases.size());
  for (std::size_t i = 0; i < with.cases.size(); ++i) {
    EXPECT_EQ(with.cases[i].id, without.cases[i].id);
    EXPECT_EQ(with.cases[i].canonical, without.cases[i].canonical);
    EXPECT_EQ(with.cases[i].labels, without.cases[i].labels);
  }
}

}  // namespace
}  // namespace seapile::study
