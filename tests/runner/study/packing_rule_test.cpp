#include "runner/study/packing_rule.h"

#include <gmock/gmock.h>

#include "tests/runner/study/scratch.h"

namespace seapile::study {
namespace {

const std::string kTips = R"("base": {"pile": {}}, "axes": {"pile.tip": ["flat", "conical"]}, "replicates": )";
const std::string kRule = R"({"at_least": 4, "at_most": 24, "metric": "q_c", "half_width": "5 %"})";

class PackingRules : public Scratch {
 protected:
  Study with(std::optional<std::int64_t> packings) const { return study(kTips + kRule, {{}, {}, packings}); }
  static std::vector<std::string> ids(const Study& study) {
    std::vector<std::string> all;
    for (const Case& one : study.cases) all.push_back(one.id);
    return all;
  }
};

TEST_F(PackingRules, BeginWithTheLeastAndSayWhatIsAskedFor) {
  const Study first = with({});
  EXPECT_EQ(first.cases.size(), 2u * 4u);
  ASSERT_TRUE(first.packing_rule.has_value());
  EXPECT_EQ(first.packing_rule->at_least, 4);
  EXPECT_EQ(first.packing_rule->at_most, 24);
  EXPECT_EQ(first.packing_rule->metric, "q_c");
  EXPECT_EQ(first.packing_rule->half_width, 0.05);
}

TEST_F(PackingRules, HaveAsManyPackingsAsTheyHaveComeToWithinTheirBounds) {
  EXPECT_EQ(with(7).cases.size(), 2u * 7u);
  EXPECT_EQ(with(24).cases.size(), 2u * 24u);
  EXPECT_EQ(with(25).cases.size(), 2u * 24u);
  EXPECT_EQ(with(1).cases.size(), 2u * 4u);
}

// A case is known by its scene, the seed inside, and not by why it was asked for.
TEST_F(PackingRules, MakeTheVeryCasesOfThatNumberOfSeeds) {
  const Study seeds = study(kTips + R"({"seeds": 7})");
  EXPECT_EQ(ids(with(7)), ids(seeds));
  for (std::size_t i = 0; i < seeds.cases.size(); ++i) EXPECT_EQ(with(7).cases[i].labels, seeds.cases[i].labels);
}

TEST_F(PackingRules, ANumberOfSeedsIsNoRuleAndStaysWhatItWas) {
  const Study three = study(kTips + R"({"seeds": 3})", {{}, {}, 9});
  EXPECT_FALSE(three.packing_rule.has_value());
  EXPECT_EQ(three.cases.size(), 2u * 3u);
  EXPECT_EQ(study(kTips + R"({"seed": [4, 9]})", {{}, {}, 9}).cases.size(), 2u * 2u);
}

TEST_F(PackingRules, GiveWayToTheCommandLine) {
  const Study seeds = study(kTips + kRule, {{}, 2, 9});
  EXPECT_FALSE(seeds.packing_rule.has_value());
  EXPECT_EQ(seeds.cases.size(), 2u * 2u);
  const Study one = study(kTips + kRule, {{"bed.seed=5"}, {}, 9});
  EXPECT_FALSE(one.packing_rule.has_value());
  EXPECT_EQ(one.cases.size(), 2u);
}

TEST_F(PackingRules, TheMostCasesAreCountedWithTheMostPackings) {
  const auto most = [](int packings) {
    return kTips + R"({"at_least": 2, "metric": "q", "half_width": 0.1, "at_most": )" + std::to_string(packings) + "}";
  };
  EXPECT_TRUE(problems(most(5000)).empty());
  EXPECT_EQ(problems(most(5001)).size(), 1u);
}

TEST_F(PackingRules, TheExampleOfTheDocumentationIsRead) {
  std::ifstream file(SEAPILE_SOURCE_DIR "/docs/study.md");
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  const std::size_t from = page.find("\"replicates\": {\"at_least\"");
  const auto rule = study(page.substr(from, page.find("```", from) - from)).packing_rule;
  ASSERT_TRUE(rule.has_value());
  EXPECT_EQ(rule->half_width, 0.05);
}

}  // namespace
}  // namespace seapile::study
