// What of a store may go so that it keeps within a budget, in which order, and how it goes (docs/decisions/0014).
//
// Kept for ever: the manifest, with its metrics, of the newest run of every case. A run is removed manifest first, and
// files of a run that stays are named in a sealed dropped.json before the first of them goes: after a crash at any
// point nothing looks complete that is not.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runner/store/disk_use.h"

namespace seapile::store {

struct GarbageRules {
  std::size_t keep = 1;                   ///< newest complete runs of each case
  std::optional<std::uint64_t> budget;    ///< bytes of the whole store; absent: everything that may go goes
  std::set<Purpose> drop;                 ///< of runs that stay: checkpoint, fields, series
  std::set<std::string> bed_runs_in_use;  ///< numbers of runs of beds that interrupted drives may be built on
};

/// One thing that goes: a run, or files of a run that stays.
struct Removal {
  const StoredRun* run;
  bool whole;                      ///< the run
  Purpose purpose;                 ///< of the files; leftover for a run that was interrupted
  std::vector<std::string> paths;  ///< relative to the run's folder
  std::uint64_t bytes = 0;
  std::string reason;
};

/// In the order in which they go: leftovers, runs that are no longer the newest, then what is dropped of the others,
/// checkpoints before fields before series; in each the largest first, of equal size the oldest. With a budget the list
/// ends where it is met. `total`: bytes of the store. Runs with strange files or a damaged manifest are left alone.
std::vector<Removal> plan_removals(const std::vector<StoredRun>& runs, std::uint64_t total, const GarbageRules& rules);

enum class Removed {
  yes,
  claimed,  ///< another process holds the case
  changed,  ///< it is not any more what it was when the plan was made
};

/// Carries one out, under the case's claim. Throws StoreError when something cannot be removed.
Removed remove(const Removal& removal);

}  // namespace seapile::store
