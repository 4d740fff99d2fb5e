#include "solver/grains/neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "solver/base/random.h"

namespace seapile::grains {
namespace {

/// `count` discs at random in a square in which they overlap here and there; radii between 1/ratio and 1 times 0.02 m.
std::vector<Disc> random_discs(int count, double ratio, std::uint64_t seed) {
  std::vector<Disc> discs;
  const double side = 0.03 * std::sqrt(static_cast<double>(count));
  for (int k = 0; k < count; ++k) {
    const auto index = static_cast<std::uint64_t>(k);
    discs.push_back({base::uniform(-side, side, seed, 0, index), base::uniform(5, 5 + side, seed, 1, index),
                     base::uniform(0.02 / ratio, 0.02, seed, 2, index), 0});
  }
  return discs;
}

void expect_the_pairs_of_brute_force(const std::vector<Disc>& discs, double skin, const std::string& what) {
  const std::vector<Pair> fast = neighbour_pairs(discs, skin), slow = neighbour_pairs_brute_force(discs, skin);
  EXPECT_TRUE(std::is_sorted(fast.begin(), fast.end())) << what;
  EXPECT_TRUE(fast == slow) << what << ": " << fast.size() << " pairs against " << slow.size();
}

TEST(Neighbours, TheGridFindsWhatBruteForceFinds) {
  for (const double ratio : {1.0, 1.7, 5.0, 20.0})
    for (const double skin : {0.0, 0.006, 0.05})
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const std::string what = "ratio " + std::to_string(ratio) + ", skin " + std::to_string(skin);
        expect_the_pairs_of_brute_force(random_discs(300, ratio, seed), skin, what);
      }
}

TEST(Neighbours, BruteForceFindsPairsByTheirGap) {
  const std::vector<Disc> discs = {{0, 0, 1, 0}, {3.5, 0, 1, 0}, {0, 2.25, 1, 0}};
  EXPECT_TRUE(neighbour_pairs_brute_force(discs, 0.2).empty());
  EXPECT_EQ(neighbour_pairs_brute_force(discs, 0.3), (std::vector<Pair>{{0, 2}}));
  EXPECT_EQ(neighbour_pairs_brute_force(discs, 1.75), (std::vector<Pair>{{0, 1}, {0, 2}}));
}

TEST(Neighbours, GrainsThatFlewFarAreFoundAndCostNoCells) {
  std::vector<Disc> discs = random_discs(200, 2, 4);
  discs.push_back({1e6, 1e6, 0.02, 0});
  discs.push_back({1e6 + 0.03, 1e6, 0.02, 0});
  discs.push_back({-1e9, 3, 0.01, 0});
  discs.push_back({0, -1e9, 0.01, 0});
  expect_the_pairs_of_brute_force(discs, 0.006, "far flyers");
  const std::vector<Pair> pairs = neighbour_pairs(discs, 0.006);
  EXPECT_TRUE(std::binary_search(pairs.begin(), pairs.end(), Pair{200, 201}));
}

TEST(Neighbours, CoincidentGrainsAreNeighbours) {
  std::vector<Disc> discs(5, Disc{0.3, -0.2, 0.01, 0});
  expect_the_pairs_of_brute_force(discs, 0.001, "all in one place");
  EXPECT_EQ(neighbour_pairs(discs, 0.001).size(), 10u);
}

TEST(Neighbours, OneGrainHasNoneAndNoneHasNone) {
  EXPECT_TRUE(neighbour_pairs({}, 0.01).empty());
  EXPECT_TRUE(neighbour_pairs(std::vector<Disc>{{1, 2, 0.01, 0}}, 0.01).empty());
}

// Grains whose centres stand exactly on the borders of cells.
TEST(Neighbours, GrainsOnTheBordersOfCellsAreFound) {
  std::vector<Disc> discs;
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 9; ++x) discs.push_back({0.25 * x, 0.25 * y, 0.125, 0});
  for (const double skin : {0.0, 1e-9, 0.125, 0.25}) expect_the_pairs_of_brute_force(discs, skin, "square lattice");
}

}  // namespace
}  // namespace seapile::grains
