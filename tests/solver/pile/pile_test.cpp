#include "solver/pile/pile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "solver/base/random.h"

namespace seapile::pile {
namespace {

using std::numbers::pi;

PileSpec with_tip(Tip tip) {
  PileSpec pile;
  pile.tip = tip;
  return pile;
}

std::vector<PileSpec> piles() {
  return {with_tip(FlatTip{}), with_tip(ConicalTip{}), with_tip(ConicalTip{pi / 18}), with_tip(ConicalTip{pi / 2})};
}

const std::vector<Driving> kDrives = {
    ConstantDriving{0.06},         SinusoidalDriving{0.2, 0.1},         VibratoryDriving{0.06, 1e-3, 20},
    VibratoryDriving{0.4, 0, 5},   VibratoryDriving{0.02, 3e-3, 7},     VibratoryDriving{0.5, 1e-3, 10},
    ConstantDriving{-0.1},         SinusoidalDriving{-0.3, 2},          VibratoryDriving{-0.05, 2e-3, 12},
    VibratoryDriving{0, 2e-3, 12}, VibratoryDriving{-0.001, 4e-3, 0.5},
};

TEST(TipHeight, IsTheRadiusOverTheTangentOfHalfTheApexAngle) {
  EXPECT_NEAR(tip_height(with_tip(ConicalTip{})), 0.2165, 5e-5);  // Thesis 6.1: 60 deg, R = 0.125 m.
  EXPECT_NEAR(tip_height(with_tip(ConicalTip{pi / 2})), 0.125, 1e-15);
  EXPECT_EQ(tip_height(with_tip(FlatTip{})), 0);
}

TEST(Outline, IsConvexAndClosedButForTheTop) {
  for (const PileSpec& pile : piles()) {
    const std::vector<base::Segment> edges = outline(pile, 3);
    ASSERT_GE(edges.size(), 3u);
    for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
      EXPECT_EQ(edges[k].to, edges[k + 1].from);
      // Anticlockwise and convex: each edge turns left.
      const base::Vec2 a = edges[k].to - edges[k].from, b = edges[k + 1].to - edges[k + 1].from;
      EXPECT_GT(a.x * b.y - a.y * b.x, 0);
    }
    EXPECT_EQ(edges.front().from, (base::Vec2{-pile.radius, 3}));
    EXPECT_EQ(edges.back().to, (base::Vec2{pile.radius, 3}));
    for (const base::Segment& edge : edges) EXPECT_GT(norm(edge.to - edge.from), 0.01);
  }
}

TEST(Outline, NoEdgeIsThereTwiceAndEachHasItsFeature) {
  for (const PileSpec& pile : piles()) {
    const double height = tip_height(pile);
    double sleeve = 0, tip = 0;
    for (const base::Segment& edge : outline(pile, 3)) {
      const bool above = edge.from.y >= height && edge.to.y >= height && edge.from.x == edge.to.x;
      EXPECT_EQ(edge.feature, above ? kSleeve : kTip);
      (above ? sleeve : tip) += norm(edge.to - edge.from);
    }
    EXPECT_NEAR(sleeve, 2 * (3 - height), 1e-14);
    EXPECT_NEAR(tip, 2 * std::hypot(pile.radius, height), 1e-14);
  }
}

TEST(Outline, TheLowestPointIsTheOrigin) {
  for (const PileSpec& pile : piles()) {
    double lowest = 1;
    for (const base::Segment& edge : outline(pile, 3)) lowest = std::min({lowest, edge.from.y, edge.to.y});
    EXPECT_EQ(lowest, 0);
  }
}

// Simpson's rule over 2000 intervals: its error, (2 pi f dt)^4 / 180 of the path, is below 1e-9 here.
TEST(Path, IsTheIntegralOfTheVelocity) {
  for (const Driving& drive : kDrives)
    for (const double end : {0.0, 0.01, 0.37, 2.0}) {
      constexpr int kIntervals = 2000;
      double sum = velocity(drive, 0) + velocity(drive, end);
      for (int k = 1; k < kIntervals; ++k) sum += (k % 2 ? 4 : 2) * velocity(drive, end * k / kIntervals);
      EXPECT_NEAR(path(drive, end), sum * end / kIntervals / 3, 1e-9) << "drive " << drive.index();
    }
}

TEST(LargestSpeed, IsReachedAndNeverExceeded) {
  for (const Driving& drive : kDrives) {
    double largest = 0;
    for (int k = 0; k <= 20'000; ++k) largest = std::max(largest, std::abs(velocity(drive, 1e-3 * k)));
    EXPECT_LE(largest, largest_speed(drive) * (1 + 1e-12));
    // Sampled every millisecond, the peak of 20 Hz is missed by 0.2 %.
    EXPECT_GT(largest, 0.99 * largest_speed(drive));
  }
}

/// The first time at which a sampled path reaches a depth; infinity when it does not within `longest`.
double first_time_by_sampling(const Driving& drive, double depth, double longest, double stride) {
  for (double t = 0; t <= longest; t += stride)
    if (path(drive, t) >= depth) return t;
  return std::numeric_limits<double>::infinity();
}

// Sampled every 20 us, the first crossing is met within one sample, unless the path only grazes the depth.
TEST(TimeToReach, IsTheFirstTimeAtWhichThePathHasTheDepth) {
  for (const Driving& drive : kDrives)
    for (std::uint64_t k = 0; k < 40; ++k) {
      const double depth = base::uniform(1e-5, 0.02, 3, 0, k), time = time_to_reach(drive, depth);
      const double sampled = first_time_by_sampling(drive, depth, 3, 2e-5);
      if (std::isinf(sampled)) {
        EXPECT_GT(time, 3 - 2e-5) << "drive " << drive.index() << ", depth " << depth;
        continue;
      }
      EXPECT_NEAR(time, sampled, 2.1e-5) << "drive " << drive.index() << ", depth " << depth;
      EXPECT_NEAR(path(drive, time), depth, 1e-9) << "drive " << drive.index();
    }
}

// A strong vibration on a slow drive reaches most depths at the crest of an oscillation, which the search must not
// pass.
TEST(TimeToReach, SeesACrestThatOnlyJustReachesTheDepth) {
  const VibratoryDriving drive{0.02, 3e-3, 7};
  for (int crest = 1; crest < 12; ++crest) {
    // Crests lie where the velocity changes sign, just before half periods.
    double early = (crest - 0.5) / drive.frequency, late = (crest - 0.25) / drive.frequency;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (early + late);
      (velocity(Driving{drive}, middle) > 0 ? early : late) = middle;
    }
    const double top = path(Driving{drive}, early), depth = top - 1e-7;
    EXPECT_LE(time_to_reach(drive, depth), early) << "crest " << crest;
  }
}

TEST(TimeToReach, IsInfiniteForWhatIsNeverReached) {
  const double never = std::numeric_limits<double>::infinity();
  EXPECT_EQ(time_to_reach(ConstantDriving{0}, 0.1), never);
  EXPECT_EQ(time_to_reach(ConstantDriving{-0.1}, 0.1), never);
  EXPECT_EQ(time_to_reach(SinusoidalDriving{0.2, 0.1}, 0.2 / (pi * 0.1) + 1e-9), never);
  EXPECT_EQ(time_to_reach(SinusoidalDriving{-0.2, 0.1}, 0.1), never);
  EXPECT_EQ(time_to_reach(VibratoryDriving{-0.01, 1e-3, 10}, 0.1), never);
  EXPECT_EQ(time_to_reach(VibratoryDriving{0, 1e-3, 10}, 2.1e-3), never);
  EXPECT_EQ(time_to_reach(VibratoryDriving{-0.05, 2e-3, 12}, 3.9e-3), never);
}

TEST(TimeToReach, OfASineIsItsHalfPeriodAtTheFullStroke) {
  EXPECT_NEAR(time_to_reach(SinusoidalDriving{0.2, 0.1}, 0.2 / (pi * 0.1) * (1 - 1e-15)), 5, 1e-6);
}

}  // namespace
}  // namespace seapile::pile
