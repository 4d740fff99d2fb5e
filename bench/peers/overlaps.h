// Overlaps of discs from their places alone, so that every code is judged by the same sums.
#pragma once

#include <istream>
#include <vector>

#include "solver/base/segment.h"

namespace seapile::peers {

struct Disc {
  double x, y, radius;  ///< [m]
};

/// What discs can overlap with beside each other: a box open at the top, and the pile.
struct Surroundings {
  double left = 0, right = 0, base = 0;  ///< places of the walls [m]
  std::vector<base::Segment> outline;    ///< of the pile, its apex at the origin [m]
  double pile_x = 0, pile_y = 0;         ///< place of the apex [m]
};

/// Overlaps as shares of the smaller radius [-], over all pairs with an overlap above zero.
struct Overlaps {
  double p999 = 0, mean = 0, max = 0;
  double contacts = 0;  ///< such pairs [-]
};

/// By a grid of cells as wide as the largest disc. The 99.9th percentile is the k-th largest overlap, counted from 0,
/// with k a thousandth of their number, rounded down: as in a record of a run.
Overlaps overlaps(const std::vector<Disc>& discs, const Surroundings& around);

/// Means over several moments of p999, mean and contacts; the largest max.
Overlaps over_moments(const std::vector<Overlaps>& moments);

/// One moment of a dump.
struct Snapshot {
  long step = 0;
  std::vector<Disc> discs;
};

/// Reads the next moment of a LAMMPS or LIGGGHTS text dump with columns "id x y radius"; false at its end.
/// Throws std::runtime_error with one sentence when the dump has another form or ends within a moment.
bool read_snapshot(std::istream& dump, Snapshot& snapshot);

}  // namespace seapile::peers
