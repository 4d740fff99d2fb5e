#include "solver/grains/deposit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "solver/grains/neighbours.h"
#include "solver/grains/regions.h"

namespace seapile::grains {
namespace {

constexpr Box kBox{-0.5, 0.5, 0};

GrainsSpec three_hundred() {
  GrainsSpec spec;
  spec.count = 300;
  return spec;
}

TEST(Deposit, NoGrainTouchesAnotherOrAWall) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Grains grains = deposit(three_hundred(), kBox, seed);
    ASSERT_EQ(grains.count(), 300u);
    EXPECT_TRUE(neighbour_pairs_brute_force(grains.disc, 0).empty());
    for (const Disc& d : grains.disc) {
      EXPECT_GE(d.x - d.radius, kBox.left);
      EXPECT_LE(d.x + d.radius, kBox.right);
      EXPECT_GE(d.y - d.radius, kBox.base);
    }
  }
}

TEST(Deposit, RadiiAreWithinTheirBoundsAndMassesFollow) {
  const GrainsSpec spec = three_hundred();
  const Grains grains = deposit(spec, kBox, 1);
  double smallest = 1, largest = 0;
  for (std::size_t i = 0; i < grains.count(); ++i) {
    const double r = grains.disc[i].radius;
    smallest = std::min(smallest, r);
    largest = std::max(largest, r);
    EXPECT_DOUBLE_EQ(grains.mass[i], spec.density * std::numbers::pi * r * r);
  }
  // 300 numbers leave no gap of a tenth of the interval at either end (chance below 1e-13).
  EXPECT_GE(smallest, spec.radius.min);
  EXPECT_LT(smallest, spec.radius.min + 0.1 * (spec.radius.max - spec.radius.min));
  EXPECT_LE(largest, spec.radius.max);
  EXPECT_GT(largest, spec.radius.max - 0.1 * (spec.radius.max - spec.radius.min));
}

TEST(Deposit, AGrainOfAnIdIsTheSameHoweverManyFollowIt) {
  GrainsSpec fewer = three_hundred();
  fewer.count = 100;
  std::map<std::int64_t, double> radius;
  const Grains all = deposit(three_hundred(), kBox, 3), some = deposit(fewer, kBox, 3);
  for (std::size_t i = 0; i < all.count(); ++i) radius[all.id[i]] = all.disc[i].radius;
  for (std::size_t i = 0; i < some.count(); ++i) EXPECT_EQ(some.disc[i].radius, radius.at(some.id[i]));
}

TEST(Deposit, AnotherSeedGivesOtherGrains) {
  const Grains a = deposit(three_hundred(), kBox, 1), b = deposit(three_hundred(), kBox, 2);
  std::set<double> radii;
  for (const Disc& d : a.disc) radii.insert(d.radius);
  for (const Disc& d : b.disc) EXPECT_FALSE(radii.contains(d.radius));
}

TEST(Arrange, TheOrderDependsOnPlacesAndIdsNotOnTheInput) {
  std::vector<GivenGrain> given;
  for (std::int64_t id = 0; id < 60; ++id)
    given.push_back({id, 0.01 * static_cast<double>(id * 37 % 60), 0.01 * static_cast<double>(id * 23 % 60), 0.02});
  given.push_back({60, given[5].x, given[5].y, 0.01});  // In the same place: the id decides.
  const Grains sorted = arrange(given, 1500);
  std::reverse(given.begin(), given.end());
  std::rotate(given.begin(), given.begin() + 17, given.end());
  const Grains shuffled = arrange(given, 1500);
  EXPECT_EQ(sorted.id, shuffled.id);
  EXPECT_EQ(sorted.mass, shuffled.mass);
  for (std::size_t i = 0; i < sorted.count(); ++i) EXPECT_EQ(sorted.disc[i].y, shuffled.disc[i].y);
}

// Along a Hilbert curve the next grain stands nearby: a lattice in rows would have 1, a random order 13 of the 40 cells
// of the side; tiles are compact, where rows of 512 would be strips.
TEST(Arrange, NeighboursInMemoryAreNeighboursInSpace) {
  std::vector<GivenGrain> given;
  for (std::int64_t id = 0; id < 1600; ++id)
    given.push_back({id, 0.03 * static_cast<double>(id % 40), 0.03 * static_cast<double>(id / 40), 0.014});
  const Grains grains = arrange(given, 1500);
  double path = 0;
  for (std::size_t i = 1; i < grains.count(); ++i)
    path += std::hypot(grains.disc[i].x - grains.disc[i - 1].x, grains.disc[i].y - grains.disc[i - 1].y);
  EXPECT_LT(path / 1599, 1.3 * 0.03);
  for (std::size_t first = 0; first + 400 <= 1600; first += 400) {
    double x0 = 9, x1 = 0, y0 = 9, y1 = 0;
    for (std::size_t i = first; i < first + 400; ++i) {
      x0 = std::min(x0, grains.disc[i].x), x1 = std::max(x1, grains.disc[i].x);
      y0 = std::min(y0, grains.disc[i].y), y1 = std::max(y1, grains.disc[i].y);
    }
    EXPECT_LT((x1 - x0) + (y1 - y0), 1.1 * 2 * 20 * 0.03) << "a quarter of the square is a quarter of the curve";
  }
}

// 2025 grains are four tiles in two halves. A core that works on one half fetches what lies at the cut and nothing else.
TEST(Arrange, GrainsAtACutStandFirstInTheirTile) {
  std::vector<GivenGrain> given;
  for (std::int64_t id = 0; id < 2025; ++id)
    given.push_back({id, 0.03 * static_cast<double>(id % 45), 0.03 * static_cast<double>(id / 45), 0.014});
  const Grains grains = arrange(given, 1500);
  const Regions regions(grains.count());
  const std::int32_t bed = regions.count() - 1;
  ASSERT_GE(regions[bed].first_half, 0);
  std::vector<bool> at_cut(grains.count(), false);
  for (const Pair& p : neighbour_pairs_brute_force(grains.disc, 0.007))
    if (regions.holding(regions.tile_of(p.i), regions.tile_of(p.j)) == bed) at_cut[p.i] = at_cut[p.j] = true;
  EXPECT_GT(std::count(at_cut.begin(), at_cut.end(), true), 60);
  for (std::int32_t tile = 0; tile < regions.tiles(); ++tile)
    EXPECT_TRUE(std::is_partitioned(at_cut.begin() + regions.first_grain(tile), at_cut.begin() + regions.first_grain(tile + 1),
                                    [](bool cut) { return cut; }))
        << "tile " << tile;
}

TEST(Arrange, NoGrainAndOneGrainAreArrangedToo) {
  EXPECT_EQ(arrange({}, 1500).count(), 0u);
  const Grains one = arrange({{7, -3, 2, 0.5}}, 2000);
  ASSERT_EQ(one.count(), 1u);
  EXPECT_EQ(one.id[0], 7);
  EXPECT_EQ(one.disc[0].x, -3);
  EXPECT_DOUBLE_EQ(one.mass[0], 2000 * std::numbers::pi * 0.25);
}

}  // namespace
}  // namespace seapile::grains
