#include "runner/present/crossing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace seapile::present {
namespace {

/// Lines of a trend: series, x, y.
Trend of(const std::vector<std::tuple<std::string, double, double>>& points) {
  Trend trend;
  trend.question = {"swell_ratio", "jet.reynolds", ""};
  trend.of_unit = trend.against_unit = "-";
  for (const auto& [series, x, y] : points) {
    TrendCase& one = trend.cases.emplace_back();
    one.series = series;
    one.x.mean = x;
    one.y.mean = y;
  }
  return trend;
}

TEST(Crossing, IsWhereTheLineBetweenNeighboursPassesTheValue) {
  // The order of the cases does not matter.
  const auto found = crossings(of({{"round", 24, 0.95}, {"round", 6, 1.08}, {"round", 12, 1.02}}), 1);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_DOUBLE_EQ(found[0].x, 12 + 12 * 0.02 / 0.07);
  EXPECT_EQ(found[0].low, 12);
  EXPECT_EQ(found[0].high, 24);
}

TEST(Crossing, EachSeriesHasItsOwn) {
  const auto found = crossings(of({{"b", 0, 2}, {"a", 0, 3}, {"b", 1, 0}, {"a", 3, 0}}), 1);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].series, "b");
  EXPECT_DOUBLE_EQ(found[0].x, 0.5);
  EXPECT_EQ(found[1].series, "a");
  EXPECT_DOUBLE_EQ(found[1].x, 2);
}

TEST(Crossing, ACaseAtTheValueCountsOnce) {
  const auto found = crossings(of({{"", 0, 2}, {"", 1, 1}, {"", 2, 0}}), 1);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].x, 1);
}

TEST(Crossing, NoneIsSaid) {
  EXPECT_EQ(crossing_text(of({{"", 0, 2}, {"", 1, 1.5}}), 1), "swell_ratio does not pass 1\n");
  EXPECT_EQ(crossing_text(of({{"geometry planar", 0, 2}, {"geometry planar", 4, 0}}), 1),
            "geometry planar: swell_ratio is 1 at jet.reynolds = 2 (linear between 0 and 4)\n");
}

}  // namespace
}  // namespace seapile::present
