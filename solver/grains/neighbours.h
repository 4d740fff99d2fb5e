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

/// Grains sorted into the cells of a square grid of edge 2 r_max + skin, so that all neighbours of a grain stand in its
/// own cell and the eight around it.
class CellGrid {
 public:
  CellGrid(std::span<const Disc> discs, double skin);

  /// Appends the pairs whose gap is below the skin and whose first grain is in [first, last), ascending. May be called by
  /// several threads at once.
  void find_pairs(std::int32_t first, std::int32_t last, std::vector<Pair>& pairs) const;

 private:
  /// A grain where its cell has it; `reach`: radius + skin / 2.
  struct Inside {
    double x, y, reach;
    std::int32_t grain;
  };
  std::span<const Disc> discs_;
  double skin_;
  double x0_ = 0, y0_ = 0, edge_ = 1;
  std::int32_t nx_ = 0, ny_ = 0;
  std::vector<std::int32_t> start_;  ///< first grain of each cell, and the end
  std::vector<Inside> inside_;       ///< by cell, row by row; inside a cell by index

  std::int32_t column(double x) const;
  std::int32_t row(double y) const;
};

/// All pairs whose gap is below `skin` [m], ascending; cost proportional to the count.
std::vector<Pair> neighbour_pairs(std::span<const Disc> discs, double skin);

/// The same by comparing all with all: the slow twin for tests.
std::vector<Pair> neighbour_pairs_brute_force(std::span<const Disc> discs, double skin);

}  // namespace seapile::grains
