#include "runner/present/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace seapile::present {
namespace {

using testing::ElementsAre;

/// Values of as many cases, beside a reference of 10 with a tolerance of 1.
Comparison compared(const std::vector<double>& values) {
  Comparison comparison;
  comparison.metric = "q_c";
  comparison.unit = "Pa";
  comparison.case_ids.resize(values.size());
  comparison.values = values;
  comparison.reference = 10;
  comparison.tolerance = 1;
  return comparison;
}
Finding finding(const std::vector<double>& values) { return judge(compared(values)).finding; }

TEST(Judge, OnePackingIsOkUpToTheToleranceAndItsEndIncluded) {
  EXPECT_EQ(finding({10}), Finding::ok);
  EXPECT_EQ(finding({11}), Finding::ok);
  EXPECT_EQ(finding({9}), Finding::ok);
  EXPECT_EQ(finding({std::nextafter(11.0, 12.0)}), Finding::failed);
  EXPECT_EQ(finding({std::nextafter(9.0, 8.0)}), Finding::failed);
}

TEST(Judge, OfSeveralPackingsTheMeanDecides) {
  EXPECT_EQ(finding({10.4, 10.5, 10.6}), Finding::ok);
  EXPECT_EQ(finding({11.0, 11.1, 11.2}), Finding::failed);
  // Within the tolerance one by one is not asked for.
  EXPECT_EQ(finding({9.9, 10.0, 10.1, 10.2, 9.8, 9.9, 10.1, 11.1}), Finding::ok);
}

TEST(Judge, TheIntervalIsStudents) {
  const Judgement judgement = judge(compared({10.4, 10.5, 10.6}));
  // t_0.975(2), of a table, times s / sqrt(3).
  EXPECT_NEAR(judgement.mean.high - judgement.mean.low, 2 * 4.302653 * 0.1 / std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(judgement.difference, 0.5, 1e-12);
}

TEST(Judge, AnIntervalWiderThanTheToleranceIsUnderpoweredWhereverItsMeanLies) {
  EXPECT_EQ(finding({9, 11}), Finding::underpowered);
  EXPECT_EQ(finding({12, 14}), Finding::underpowered);
}

TEST(Judge, AnIntervalThatIsWhollyBeyondTheToleranceHasFailedHoweverWideItIs) {
  EXPECT_EQ(finding({99, 101}), Finding::failed);
  EXPECT_EQ(finding({-101, -99}), Finding::failed);
}

TEST(Judge, AnUnfinishedPackingIsMissingWhateverTheOthersSay) {
  EXPECT_EQ(finding({}), Finding::missing);
  Comparison comparison = compared({10, 10});
  comparison.case_ids.resize(3);
  EXPECT_EQ(judge(comparison).finding, Finding::missing);
  EXPECT_EQ(judge(comparison).mean.n, 2u);
}

TEST(Judge, WhatIsNoNumberHasFailed) { EXPECT_EQ(finding({std::nan("")}), Finding::failed); }

TEST(Judge, WithoutAReferenceNothingIsAcceptedYet) {
  Comparison comparison = compared({10});
  comparison.reference.reset();
  EXPECT_EQ(judge(comparison).finding, Finding::not_accepted);
  EXPECT_TRUE(std::isnan(judge(comparison).difference));
}

TEST(Judge, AToleranceOfNothingAsksForTheVerySameNumber) {
  Comparison comparison = compared({10});
  comparison.tolerance = 0;
  EXPECT_EQ(judge(comparison).finding, Finding::ok);
  comparison.values = {std::nextafter(10.0, 11.0)};
  EXPECT_EQ(judge(comparison).finding, Finding::failed);
}

/// Values of as many cases beside bounds.
Finding within(const std::vector<double>& values, std::optional<double> at_least, std::optional<double> at_most) {
  Comparison comparison = compared(values);
  comparison.against = Against::bounds;
  comparison.reference.reset();
  comparison.at_least = at_least;
  comparison.at_most = at_most;
  return judge(comparison).finding;
}

TEST(JudgeBounds, WhatLiesOnABoundIsWithin) {
  EXPECT_EQ(within({1e-10}, {}, 1e-10), Finding::ok);
  EXPECT_EQ(within({std::nextafter(1e-10, 1.0)}, {}, 1e-10), Finding::failed);
  EXPECT_EQ(within({2}, 2, {}), Finding::ok);
  EXPECT_EQ(within({std::nextafter(2.0, 1.0)}, 2, {}), Finding::failed);
  EXPECT_EQ(within({2.5}, 2, 3), Finding::ok);
  EXPECT_EQ(within({3.5}, 2, 3), Finding::failed);
  EXPECT_EQ(within({1.5}, 2, 3), Finding::failed);
  EXPECT_EQ(within({-1e300}, {}, 0), Finding::ok);
}

TEST(JudgeBounds, WhatIsNoNumberIsWithinNone) {
  EXPECT_EQ(within({std::nan("")}, {}, 1), Finding::failed);
  EXPECT_EQ(within({std::nan("")}, 0, {}), Finding::failed);
}

TEST(JudgeBounds, OfSeveralPackingsTheMeanDecidesAndAllHaveToBeThere) {
  EXPECT_EQ(within({1, 4}, {}, 3), Finding::ok);
  EXPECT_EQ(within({1, 6}, {}, 3), Finding::failed);
  EXPECT_EQ(within({}, {}, 3), Finding::missing);
}

TEST(OverPackings, CasesThatDifferInTheSeedAloneAreOneComparison) {
  const auto labels = [](const std::string& tip, const std::string& seed) {
    return Labels{{"pile.tip", tip}, {"bed.seed", seed}};
  };
  const auto found = over_packings(compared({}), {{"a", labels("flat", "1"), 10.0},
                                                  {"b", labels("conical", "1"), 5.0},
                                                  {"c", labels("flat", "2"), std::nullopt},
                                                  {"d", labels("flat", "3"), 12.0}});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_THAT(found[0].case_ids, ElementsAre("a", "c", "d"));
  EXPECT_THAT(found[0].values, ElementsAre(10, 12));
  EXPECT_EQ(found[0].labels, (Labels{{"pile.tip", "flat"}}));
  EXPECT_EQ(found[0].metric, "q_c");
  EXPECT_THAT(found[1].case_ids, ElementsAre("b"));
  EXPECT_EQ(found[1].labels, labels("conical", "1"));
}

}  // namespace
}  // namespace seapile::present
