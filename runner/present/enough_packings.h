// How many packings narrow the bands of a study's cases to what it asks for: round by round, from the results alone.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runner/present/statistics.h"
#include "runner/present/table.h"

namespace seapile::present {

/// What a study asks of its packings.
struct PackingsAsked {
  std::string metric;       ///< what is measured, for people
  double half_width = 0;    ///< largest of the 95 % interval of a mean, as a share of the case's level
  std::size_t at_most = 0;  ///< packings
};

/// One metric, or the bins of a curve, over the packings of one case. Its level is the mean over all of them, so that a
/// curve is to be known within a share of itself and not of its beginning, where it is hardly more than nothing.
struct PackingsOfCase {
  Labels labels;                            ///< the seed apart
  std::vector<std::vector<double>> values;  ///< of each metric, in the order of the packings; finite, at least one
};

/// What a round of packings came to.
struct PackingRound {
  std::size_t packings = 0;  ///< so far
  std::size_t cases = 0;     ///< that have packings
  std::size_t wide = 0;      ///< cases with a wider band than is asked for
  double widest = 0;         ///< largest half-width as a share of its case's level
  Labels widest_case;        ///< where it is
  std::size_t needed = 0;    ///< packings that narrow all, as the scatter so far has it; as many as there are: enough
  std::size_t next = 0;      ///< packings to have in the next round; as many as there are: there is none
};

/// All cases get the same packings, so that they stay paired. From n packings to the number that the scatter so far
/// asks for, sample_for_half_width(), but never more than twice as many at a time, because the scatter of few packings
/// is known badly, and never beyond the cap. The answer depends on the values alone.
PackingRound next_round(const std::vector<PackingsOfCase>& cases, std::size_t packings, const PackingsAsked& asked);

/// One line: how wide the bands are, and what follows.
std::string round_text(const PackingRound& round, const PackingsAsked& asked);

}  // namespace seapile::present
