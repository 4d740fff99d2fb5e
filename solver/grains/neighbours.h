// Pairs of grains that may touch before the list is made anew.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "solver/grains/grains.h"

namespace seapile::grains {

struct Pair {
  std::int32_t i, j;  ///< i < j
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

/// All pairs whose gap is below `skin` [m], ascending. A cell grid of edge 2 r_max + skin; cost proportional to the count.
std::vector<Pair> neighbour_pairs(std::span<const Disc> discs, double skin);

/// The same by comparing all with all: the slow twin for tests.
std::vector<Pair> neighbour_pairs_brute_force(std::span<const Disc> discs, double skin);

}  // namespace seapile::grains
