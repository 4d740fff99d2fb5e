#include "solver/grains/regions.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace seapile::grains {
namespace {

constexpr std::size_t kCounts[] = {0, 1, 4, 5, 511, 512, 513, 1200, 4100, 6000, 11'596, 63'489, 100'000, 200'000};

bool holds(const Region& region, std::int32_t tile) { return region.first_tile <= tile && tile < region.last_tile; }

TEST(Regions, EveryGrainIsInOneTileAndTilesAreEqualRows) {
  for (const std::size_t count : kCounts) {
    SCOPED_TRACE(count);
    const Regions regions(count);
    EXPECT_EQ(regions.first_grain(0), 0);
    EXPECT_EQ(regions.first_grain(regions.tiles()), static_cast<std::int32_t>(count));
    for (std::int32_t tile = 0; tile < regions.tiles(); ++tile) {
      const std::int32_t first = regions.first_grain(tile), last = regions.first_grain(tile + 1);
      ASSERT_LE(first, last);
      EXPECT_LE(last - first, kTileGrains);
      if (first == last) {
        EXPECT_EQ(last, static_cast<std::int32_t>(count)) << "only the last tiles may be empty";
        continue;
      }
      EXPECT_EQ(first % 4, 0);
      EXPECT_EQ(regions.tile_of(first), tile);
      EXPECT_EQ(regions.tile_of(last - 1), tile);
    }
  }
}

TEST(Regions, EachStandsBehindAllThatItHoldsAndTheLastIsTheBed) {
  for (const std::size_t count : kCounts) {
    SCOPED_TRACE(count);
    const Regions regions(count);
    if (count == 0) {
      EXPECT_EQ(regions.count(), 0);
      continue;
    }
    EXPECT_EQ(regions[regions.count() - 1].first_tile, 0);
    EXPECT_EQ(regions[regions.count() - 1].last_tile, regions.tiles());
    for (std::int32_t r = 0; r < regions.count(); ++r)
      for (std::int32_t q = 0; q < regions.count(); ++q) {
        const bool inside =
            regions[r].first_tile <= regions[q].first_tile && regions[q].last_tile <= regions[r].last_tile;
        EXPECT_EQ(inside, regions.first_inside(r) <= q && q <= r) << q << " in " << r;
      }
  }
}

TEST(Regions, TheSmallestThatHoldsTwoTilesIsFound) {
  for (const std::size_t count : kCounts) {
    SCOPED_TRACE(count);
    const Regions regions(count);
    for (std::int32_t a = 0; a < std::min(regions.tiles(), 30); ++a)
      for (std::int32_t b = 0; b < regions.tiles(); ++b) {
        std::int32_t smallest = 0;
        while (!holds(regions[smallest], a) || !holds(regions[smallest], b)) ++smallest;
        EXPECT_EQ(regions.holding(a, b), smallest) << a << ' ' << b;
      }
  }
}

TEST(Regions, HalvesOfTheThesisBedAreEqual) {
  const Regions regions(11'596);
  for (std::int32_t r = regions.count() - 1; regions[r].first_half >= 0; r = regions[r].first_half) {
    const Region &a = regions[regions[r].first_half], &b = regions[regions.second_half(r)];
    EXPECT_EQ(a.last_tile - a.first_tile, b.last_tile - b.first_tile);
  }
}

}  // namespace
}  // namespace seapile::grains
