#include "runner/present/thinning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seapile::present {
namespace {

constexpr std::size_t kMost = 2000, kCount = 50'000;

/// q_c of a pile that moves up and down as it goes deeper, with one peak of a single record.
struct Loops {
  std::vector<double> x, y;
  Loops() {
    for (std::size_t i = 0; i < kCount; ++i) {
      const double t = static_cast<double>(i) / kCount;
      y.push_back(t + 0.02 * std::sin(400 * t));
      x.push_back(100 * t + 5 * std::sin(3000 * t));
    }
    x[kPeak] = 1e4;
    y[kTurn] = -0.5;
  }
  static constexpr std::size_t kPeak = 31'234, kTurn = 12'345;
};

bool has(const std::vector<std::size_t>& kept, std::size_t i) { return std::ranges::binary_search(kept, i); }

TEST(ThinnedPath, KeepsThePointsOfALineThatIsShortEnough) {
  const std::vector<double> x(kMost, 1.0), y(kMost, 2.0);
  EXPECT_EQ(thinned_path(x, y, kMost).size(), kMost);
}

TEST(ThinnedPath, KeepsEndsAndPeaksInBothDirectionsInTheOrderOfThePath) {
  const Loops path;
  const auto kept = thinned_path(path.x, path.y, kMost);
  EXPECT_LE(kept.size(), kMost);
  EXPECT_GT(kept.size(), kMost / 2);
  EXPECT_TRUE(std::ranges::is_sorted(kept));
  EXPECT_EQ(kept.front(), 0u);
  EXPECT_EQ(kept.back(), kCount - 1);
  EXPECT_TRUE(has(kept, Loops::kPeak)) << "a peak of q_c";
  EXPECT_TRUE(has(kept, Loops::kTurn)) << "a turn of the pile";
}

TEST(ThinnedPath, LosesNoExtremeOfAnyStretch) {
  const Loops path;
  const auto kept = thinned_path(path.x, path.y, kMost);
  const std::size_t stretches = (kMost - 2) / 5;
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t first = s * kCount / stretches, last = (s + 1) * kCount / stretches;
    for (const auto* values : {&path.x, &path.y}) {
      double low = 1e9, high = -1e9, kept_low = 1e9, kept_high = -1e9;
      for (std::size_t i = first; i < last; ++i) {
        low = std::min(low, (*values)[i]);
        high = std::max(high, (*values)[i]);
        if (!has(kept, i)) continue;
        kept_low = std::min(kept_low, (*values)[i]);
        kept_high = std::max(kept_high, (*values)[i]);
      }
      EXPECT_EQ(kept_low, low);
      EXPECT_EQ(kept_high, high);
    }
  }
}

TEST(ThinnedPath, KeepsAGapAGap) {
  Loops path;
  for (std::size_t i = 20'000; i < 20'500; ++i) path.x[i] = std::numeric_limits<double>::quiet_NaN();
  const auto kept = thinned_path(path.x, path.y, kMost);
  EXPECT_LE(kept.size(), kMost);
  EXPECT_TRUE(std::ranges::any_of(kept, [&](std::size_t i) { return std::isnan(path.x[i]); }));
  EXPECT_TRUE(has(kept, Loops::kPeak));
}

}  // namespace
}  // namespace seapile::present
