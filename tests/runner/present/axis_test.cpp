#include "runner/present/axis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace seapile::present {
namespace {

using testing::ElementsAre;

std::vector<std::string> texts(double from, double to, double step) {
  std::vector<std::string> list;
  for (const Tick& tick : ticks(from, to, step)) list.push_back(tick.text);
  return list;
}

TEST(NiceStep, IsTheSmallestOneTwoOrFiveOfWhichNotTooManyFit) {
  EXPECT_DOUBLE_EQ(nice_step(1.2, 10), 0.2);
  EXPECT_DOUBLE_EQ(nice_step(5.2, 14), 0.5);
  EXPECT_DOUBLE_EQ(nice_step(65e3, 8), 10e3);
  EXPECT_DOUBLE_EQ(nice_step(10, 10), 1);
  for (double span = 1e-6; span < 1e9; span *= 1.37) {
    for (const int most : {1, 3, 10}) {
      const double step = nice_step(span, most);
      EXPECT_LE(span / step, most * (1 + 1e-6));
      EXPECT_GT(span / step, most / 2.6) << "a smaller step would have done";
      const double digit = step / std::pow(10, std::floor(std::log10(step) + 1e-6));
      EXPECT_LT(std::min({std::abs(digit - 1), std::abs(digit - 2), std::abs(digit - 5)}), 1e-6);
    }
  }
}

TEST(Ticks, AreTheMultiplesBetweenTheEndsWithTheDecimalsOfTheStep) {
  EXPECT_THAT(texts(-0.6, 0.6, 0.2), ElementsAre("-0.6", "-0.4", "-0.2", "0.0", "0.2", "0.4", "0.6"));
  EXPECT_THAT(texts(0.74, 0.86, 0.05), ElementsAre("0.75", "0.80", "0.85"));
  EXPECT_THAT(texts(0, 3000, 1000), ElementsAre("0", "1000", "2000", "3000"));
}

}  // namespace
}  // namespace seapile::present
