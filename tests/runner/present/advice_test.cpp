#include "runner/present/advice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seapile::present {
namespace {

MeasuredFrontier frontier() {
  return {"dry",
          {{"fine", 100, 0.001, 0.01, 8, 8},
           {"coarse", 10, 0.02, 0.04, 8, 8},
           {"rough", 1, 0.1, 0.2, 8, 8},
           {"broken", 0.1, 0.001, 0.002, 7, 8},
           {"unknown", 0.2, 0.001, std::nan(""), 8, 8}},
          2};
}
const std::vector<bool> kAll(5, true);

TEST(Advice, IsTheCheapestLevelWhoseBoundHolds) {
  const Advice advice = advise({frontier()}, kAll, 0.05, 6);
  ASSERT_TRUE(advice.level);
  EXPECT_EQ(*advice.level, 1u);
  EXPECT_EQ(advice.bound, 0.04);
  EXPECT_EQ(advice.cpu_seconds, 30) << "three times the work";
}

TEST(Advice, SaysThatNoneHoldsAndWhichIsClosest) {
  const Advice advice = advise({frontier()}, kAll, 0.005, 1);
  EXPECT_FALSE(advice.level);
  ASSERT_TRUE(advice.closest);
  EXPECT_EQ(*advice.closest, 0u);
  EXPECT_EQ(advice.closest_bound, 0.01);
}

// What was measured elsewhere and is worse there counts.
TEST(Advice, ALevelIsAsGoodAsInTheWorstOfItsScenes) {
  MeasuredFrontier elsewhere{"holdout", {{"coarse", 20, 0.05, 0.07, 8, 8}}, 1};
  EXPECT_EQ(advise({frontier(), elsewhere}, kAll, 0.05, 1).level, 0u);
  elsewhere.levels[0].bound = std::nan("");
  EXPECT_EQ(advise({frontier(), elsewhere}, kAll, 0.05, 1).level, 0u) << "nothing is known there";
}

TEST(Advice, WhatWasMeasuredInEverySceneGoesBeforeWhatIsKnownFromFewer) {
  const MeasuredFrontier elsewhere{"holdout", {{"fine", 200, 0.02, 0.03, 8, 8}}, 1};
  const Advice advice = advise({frontier(), elsewhere}, kAll, 0.05, 1);
  EXPECT_EQ(advice.level, 0u) << "coarse is cheaper, and holds in the one scene that has it";
  EXPECT_EQ(advice.measured_in, (std::vector<std::string>{"dry", "holdout"}));
  EXPECT_TRUE(advice.lacking_in.empty());
  const MeasuredFrontier worse{"holdout", {{"fine", 200, 0.02, 0.06, 8, 8}}, 1};
  const Advice some = advise({frontier(), worse}, kAll, 0.05, 1);
  EXPECT_EQ(some.level, 1u);
  EXPECT_EQ(some.lacking_in, std::vector<std::string>{"holdout"});
}

TEST(Advice, LeavesOutWhatIsAnotherSceneAndWhatHasFailures) {
  EXPECT_EQ(advise({frontier()}, {true, false, true, true, true}, 0.05, 1).level, 0u);
  EXPECT_FALSE(advise({}, {}, 0.05, 1).level);
}

}  // namespace
}  // namespace seapile::present
