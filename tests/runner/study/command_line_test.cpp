#include <gmock/gmock.h>

#include "runner/study/problem_text.h"
#include "tests/runner/study/scratch.h"

namespace seapile::study {
namespace {

using testing::HasSubstr;

class CommandLine : public Scratch {
 protected:
  Study with(const std::vector<std::string>& set, const std::string& members = R"("base": {"pile": {}})") const {
    return study(members, {set, {}});
  }
  /// The sentence about the one problem.
  std::string problem(const Options& options, const std::string& members = R"("base": {"pile": {}})") const {
    const auto found = problems(members, options);
    EXPECT_EQ(found.size(), 1u);
    return found.empty() ? "" : sentence("s", found[0]);
  }
};

TEST_F(CommandLine, AValueIsJsonOrBareText) {
  EXPECT_EQ(with({"pile.depth=0.3"}).cases[0].scene.pile->depth, 0.3);
  EXPECT_EQ(with({"pile.depth=0.3 m"}).cases[0].scene.pile->depth, 0.3);
  EXPECT_EQ(with({"pile.depth=\"30 cm\""}).cases[0].scene.pile->depth, 0.3);
  EXPECT_EQ(with({"pile.tip=flat"}).cases[0].scene.pile->tip, pile::Tip(pile::FlatTip{}));
  EXPECT_EQ(with({"pile.tip={\"conical\": {\"apex_angle\": 1}}"}).cases[0].scene.pile->tip,
            pile::Tip(pile::ConicalTip{1}));
  EXPECT_EQ(with({"pile.depth=null", "pile.duration=2 s"}).cases[0].scene.pile->depth, std::nullopt);
  EXPECT_EQ(with({"pile=null"}).cases[0].scene.pile, std::nullopt);
}

TEST_F(CommandLine, TheRecordIsSetByItsName) {
  const Study one = with({"record.travel=1 mm", "record.frames=[0.1, \"0.2 m\"]"});
  EXPECT_EQ(one.record.travel, 1e-3);
  EXPECT_EQ(one.record.frames, (std::vector<double>{0.1, 0.2}));
}

TEST_F(CommandLine, MakesWhatTheStudyLeavesOut) {
  EXPECT_EQ(with({"pile.depth=0.3"}, "").cases[0].scene.pile->depth, 0.3);
}

TEST_F(CommandLine, WinsOverBaseAndWhen) {
  const std::string members = R"("base": {"pile": {"depth": 1}}, "axes": {"pile.tip": ["flat", "conical"]},
      "when": [{"if": {"pile.tip": "flat"}, "set": {"pile.depth": 0.8}}])";
  for (const Case& one : with({"pile.depth=0.3"}, members).cases) EXPECT_EQ(one.scene.pile->depth, 0.3);
}

TEST_F(CommandLine, OnThePathOfAnAxisReplacesTheAxis) {
  const std::string members =
      R"("axes": {"pile.tip": ["flat", "conical"], "pile.depth": [0.5, 1]}, "replicates": {"seeds": 3})";
  EXPECT_EQ(with({"pile.tip=flat"}, members).cases.size(), 6u);
  const Study one = with({"pile.tip=flat", "pile.depth=0.3", "bed.seed=9"}, members);
  ASSERT_EQ(one.cases.size(), 1u);
  EXPECT_TRUE(one.cases[0].labels.empty());
  EXPECT_EQ(one.cases[0].scene.bed.seed, 9u);
}

TEST_F(CommandLine, InsideAnAxisHoldsForTheCasesThatHaveThePlace) {
  const Study two = with({"pile.tip.conical.apex_angle=45 deg"}, R"("axes": {"pile.tip": ["flat", "conical"]})");
  EXPECT_EQ(two.cases[0].scene.pile->tip, pile::Tip(pile::FlatTip{}));
  EXPECT_NE(two.cases[1].scene.pile->tip, pile::Tip(pile::ConicalTip{}));
}

TEST_F(CommandLine, StandsAboveFidelity) {
  EXPECT_EQ(
      with({"contact.substeps=3"}, R"("base": {"pile": {}}, "fidelity": "reference")").cases[0].scene.contact.substeps,
      3);
}

TEST_F(CommandLine, AShorterDepthKeepsTheFramesWithinReach) {
  const Study tips = read(SEAPILE_SOURCE_DIR "/studies/tip_shape.json", {{"pile.depth=0.3 m"}, {}});
  EXPECT_EQ(tips.record.frames, (std::vector<double>{0, 0.2}));
}

TEST_F(CommandLine, SeedsReplaceTheReplicates) {
  const Study five = study(R"("replicates": {"seed": [7, 8]})", {{}, 5});
  ASSERT_EQ(five.cases.size(), 5u);
  EXPECT_EQ(five.cases[0].scene.bed.seed, 1u);
  EXPECT_EQ(five.cases[4].scene.bed.seed, 5u);
  EXPECT_EQ(study("", {{}, 1}).cases.size(), 1u);
}

TEST_F(CommandLine, MayEndARunBeforeAFrameOfTheStudy) {
  const std::string driven = R"("base": {"pile": {"depth": 1}}, "record": {"frames": [0.2, 0.8]})",
                    water = R"("base": {"basin": {}}, "record": {"times": [0.5]})";
  EXPECT_TRUE(problems(driven, {{"pile.depth=0.5"}, {}}).empty());
  EXPECT_TRUE(problems(water, {{"basin.time.duration=0.1"}, {}}).empty());
  EXPECT_THAT(problem({{"record.times=[2]"}, {}}, water), HasSubstr("--set record.times/0: is after the end of the run"));
}

TEST_F(CommandLine, AProblemNamesTheOption) {
  EXPECT_EQ(problem({{"pile.depht=1"}, {}}),
            "s: --set pile.depht: is no path: pile has no \"depht\"; allowed: radius, friction, tip, driving, depth, "
            "duration; did you mean \"pile.depth\"?");
  EXPECT_THAT(problem({{"pile.friction=11"}, {}}), HasSubstr("--set pile.friction: 11 is out of range"));
  EXPECT_THAT(problem({{"pile.radius=3 m"}, {}}), HasSubstr("--set pile.radius: makes a pile of 6 m that is too wide"));
  EXPECT_THAT(problem({{"pile.tip={\"conical\": {\"apex_angle\": 60}}"}, {}}),
              HasSubstr("--set pile.tip/conical/apex_angle: 60 rad"));
  EXPECT_THAT(problem({{"record.frmes=[1]"}, {}}), HasSubstr("did you mean \"record.frames\"?"));
  EXPECT_THAT(problem({{"record.frames=[3]"}, {}}), HasSubstr("--set record.frames/0: is deeper than the pile goes"));
}

TEST_F(CommandLine, WhatCannotBeReadIsRefused) {
  EXPECT_THAT(problem({{"pile.depth"}, {}}), HasSubstr("--set pile.depth: has no \"path=value\""));
  EXPECT_THAT(problem({{"=1"}, {}}), HasSubstr("has no \"path=value\""));
  EXPECT_THAT(problem({{"pile.depth="}, {}}), HasSubstr("--set pile.depth: \"\" is a string without a number"));
  EXPECT_THAT(problem({{"pile.depth=1e400"}, {}}), HasSubstr("1e400 overflows"));
  EXPECT_THAT(problem({{"pile.depth=NaN"}, {}}), HasSubstr("is a string without a number"));
  EXPECT_THAT(problem({{"pile.tip={\"conical\""}, {}}), HasSubstr("--set pile.tip/conical: line 1, column"));
  EXPECT_THAT(problem({{"bed.file=\x1b[2J"}, {}}), HasSubstr("control character 0x1b"));
  EXPECT_THAT(problem({{"bed.file=\xff"}, {}}), HasSubstr("ill-formed UTF-8"));
}

TEST_F(CommandLine, WhatWouldHaveNoEffectIsRefused) {
  EXPECT_THAT(problem({{"pile.depth=1", "pile.depth=0.5"}, {}}), HasSubstr("--set pile.depth: is set twice"));
  EXPECT_THAT(problem({{"pile.tip.conical.apex_angle=1"}, {}}, R"("base": {"pile": {"tip": "flat"}})"),
              HasSubstr("--set pile.tip.conical.apex_angle: has no place in any case"));
  EXPECT_THAT(problem({{"contact.step=1 ms"}, {}}, ""), HasSubstr("--set contact.step: has no place in any case"));
  EXPECT_THAT(problem({{}, 3}, R"("axes": {"bed.seed": [1, 2]})"), HasSubstr("--seeds: bed.seed is an axis already"));
  EXPECT_THAT(problem({{"bed.seed=4"}, 3}), HasSubstr("--seeds: bed.seed is given by --set as well"));
}

TEST_F(CommandLine, SeedsAreAWholeNumberOfCases) {
  for (const std::int64_t seeds : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{10'001}, std::int64_t{1} << 62}) {
    EXPECT_THAT(problem({{}, seeds}), HasSubstr("is out of range; allowed: a whole number from 1 to 10000"));
  }
}

TEST_F(CommandLine, ALevelOfFidelityTakesThePlaceOfTheStudys) {
  const auto steps = [&](const std::string& members, const std::string& level) {
    Options options;
    options.fidelity = level;
    std::vector<double> all;
    for (const Case& one : study(members, options).cases) all.push_back(one.scene.contact.step);
    return all;
  };
  EXPECT_EQ(steps(R"("base": {"pile": {}}, "fidelity": "reference")", "draft"), std::vector<double>{4e-3});
  EXPECT_EQ(steps(R"("base": {"pile": {}})", "thesis"), std::vector<double>{1e-4});
  const std::string variants =
      R"("base": {"pile": {}}, "variants": [{"name": "a", "fidelity": "reference"}, {"name": "b"}])";
  EXPECT_EQ(steps(variants, "draft"), (std::vector<double>{5e-4, 4e-3})) << "a variant's own level stays";
  Options wrong;
  wrong.fidelity = "drafd";
  EXPECT_THAT(problem(wrong), testing::AllOf(HasSubstr("--fidelity: "), HasSubstr("did you mean \"draft\"")));
}

}  // namespace
}  // namespace seapile::study
