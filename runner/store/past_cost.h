// What runs of the past have cost, with the parameters that a price goes by.
#pragma once

#include <string>
#include <vector>

#include "runner/store/parameters.h"

namespace SQLite {
class Database;
}

namespace seapile::store {

/// A completed run and its cost.
struct PastCost {
  std::string case_id;
  std::string kind;                   ///< "bed", "drive" or "flow"
  double cpu_seconds = 0;             ///< [s]
  double peak_memory_mb = 0;          ///< [MB]
  double bytes = 0;                   ///< of all its files
  std::vector<Parameter> parameters;  ///< of its case
};

/// So many of the latest runs of a kind are looked at: what was computed long ago says little of today's program.
inline constexpr int kMostPastCosts = 2000;

/// The latest completed runs of each kind, the latest first.
std::vector<PastCost> past_costs(SQLite::Database& sqlite);

}  // namespace seapile::store
