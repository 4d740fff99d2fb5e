// The depths over which a drive's headline metrics are means: docs/formulation.md 3.
#pragma once

#include "solver/simulation/record.h"

namespace seapile::simulation {

inline constexpr double kHeadlineFrom = 0.2, kHeadlineTo = 1.2;  // [m]

/// The last record of a run to the end may be a hair beyond it [m].
inline constexpr double kHeadlineEnd = kHeadlineTo + 1e-3;

inline bool is_in_headline(const Record& record) {
  return record.depth >= kHeadlineFrom && record.depth < kHeadlineEnd;
}

}  // namespace seapile::simulation
