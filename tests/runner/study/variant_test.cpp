// Variants of a study, what they are compared for, and the values of an edge.
#include <gmock/gmock.h>

#include "runner/study/problem_text.h"
#include "tests/runner/study/scratch.h"

namespace seapile::study {
namespace {

using testing::HasSubstr;

/// The problems of a study, each a line.
class Told : public Scratch {
 protected:
  std::string problem_of(const std::string& members, const Options& options = {}) const {
    std::string lines;
    for (const auto& problem : problems(members, options)) lines += sentence("", problem) + "\n";
    return lines;
  }
};

class Variants : public Told {
 protected:
  static constexpr const char* kThree = R"("base": {"pile": {}}, "variants": [{"name": "plain"},
    {"name": "fine", "set": {"contact.substeps": 40}}, {"name": "rough", "fidelity": "draft"}])";
};

TEST_F(Variants, AreTheCasesOfTheStudyWithWhatTheySay) {
  const Study three = study(std::string(kThree) + R"(, "axes": {"pile.tip": ["flat", "conical"]})");
  ASSERT_EQ(three.cases.size(), 6u);
  const std::pair<std::string, std::string> expected{kVariant, "fine"};
  EXPECT_EQ(three.cases[2].labels.front(), expected);
  EXPECT_EQ(three.cases[3].labels.front(), expected);
  EXPECT_EQ(three.cases[0].scene.contact.substeps, 10);
  EXPECT_EQ(three.cases[2].scene.contact.substeps, 40);
  EXPECT_EQ(three.cases[4].scene.contact.step, 4e-3);
}

TEST_F(Variants, AVariantThatSaysNothingIsTheStudyWithoutVariants) {
  EXPECT_EQ(study(kThree).cases[0].id, study(R"("base": {"pile": {}})").cases[0].id);
}

TEST_F(Variants, AreOverAxesAndUnderConditionsAndTheCommandLine) {
  const std::string text = R"("base": {"pile": {}}, "variants": [{"name": "flat", "set": {"pile.tip": "flat"}}],
    "when": [{"if": {"pile.tip": "flat"}, "set": {"pile.depth": "0.5 m"}}])";
  EXPECT_EQ(study(text).cases[0].scene.pile->depth, 0.5);
  EXPECT_EQ(study(text, {{"pile.depth=0.4 m"}, {}}).cases[0].scene.pile->depth, 0.4);
}

TEST_F(Variants, ThatAreTheSameCaseAreRefused) {
  EXPECT_THAT(
      problem_of(
          R"("base": {"pile": {}}, "variants": [{"name": "a"}, {"name": "b", "set": {"contact.substeps": 10}}])"),
      HasSubstr("/variants/1: gives the same case as the variant \"a\""));
}

TEST_F(Variants, AreComparedWithOneOfThem) {
  const Study compared = study(std::string(kThree) + R"(, "frontier": {"reference": "fine", "of": ["q_c", "bin_*"]})");
  ASSERT_TRUE(compared.trade.has_value());
  EXPECT_EQ(compared.trade->kind, TradeKind::frontier);
  EXPECT_EQ(compared.trade->against, "fine");
  EXPECT_EQ(compared.trade->metrics, (std::vector<std::string>{"q_c", "bin_*"}));
  EXPECT_THAT(
      problem_of(std::string(kThree) + R"(, "ablate": {"whole": "fin", "of": ["q_c"]})"),
      HasSubstr("/ablate/whole: \"fin\" is no variant; allowed: the name of a variant; did you mean \"fine\"?"));
}

class Edges : public Told {
 protected:
  static constexpr const char* kEdge = R"("base": {"pile": {}}, "axes": {"pile.tip": ["flat", "conical"]},
    "edge": {"path": "contact.substeps", "good": 40, "bad": 1, "invariants": [{"metric": "overlap_max", "at_most": 0.1}]})";
};

TEST_F(Edges, BeginWithBothEndsOfEveryCombination) {
  const Study both = study(kEdge);
  ASSERT_EQ(both.cases.size(), 4u);
  EXPECT_EQ(both.cases[0].scene.contact.substeps, 40);
  EXPECT_EQ(both.cases[1].scene.contact.substeps, 1);
  EXPECT_EQ(both.cases[1].probe, 1);
  EXPECT_EQ(both.cases[3].combination, 1u);
  EXPECT_EQ(both.cases[1].labels.back(), (std::pair<std::string, std::string>{"contact.substeps", "1"}));
}

TEST_F(Edges, HaveTheValuesThatEachCombinationHasComeTo) {
  Options options;
  options.probes = {{}, {40, 1, 6}};
  const Study second = study(kEdge, options);
  ASSERT_EQ(second.cases.size(), 3u);
  EXPECT_EQ(second.cases[2].scene.contact.substeps, 6);
  EXPECT_EQ(second.cases[2].combination, 1u);
}

TEST_F(Edges, ThatTheCommandLineTakesAwayAreRefused) {
  EXPECT_THAT(problem_of(kEdge, {{"contact.substeps=7"}, {}}), HasSubstr("/edge: gives the same case for two values"));
}

}  // namespace
}  // namespace seapile::study
