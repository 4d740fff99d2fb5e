// What a change of the numerics has moved, by measurement: of each group of results that are stale by their numerics
// alone the cheapest case is computed again, beside the store, and compared with the run that it has.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runner/execute/plan.h"
#include "runner/execute/pool.h"
#include "runner/execute/request.h"
#include "runner/present/run_comparison.h"
#include "runner/study/study.h"

namespace seapile::commands {

/// Cases of a kind whose newest runs were made with the same list of numerics, where the same other list is asked for.
/// Dry and saturated scenes have other modules and are groups of their own.
struct ProbeGroup {
  std::string kind;
  store::NumericsList before, now;
  std::size_t cases = 0;
  present::FinishedRun cheapest;  ///< the run with the least CPU time among those that can be computed again
  execute::Task task;             ///< its case in the plan of its study
  study::Case of_study;
  execute::Request request;  ///< to compute it again; in which store is still to be said
  std::string hindrance;     ///< why none of them can be computed again; "" when one can
};

/// The groups of some studies, each case once, by kind and lists. Throws study::BadInput, store::StoreError.
std::vector<ProbeGroup> probe_groups(const std::vector<std::string>& studies, const std::filesystem::path& root);

enum class Probed {
  equivalent,
  stale,    ///< the new run is another one
  failed,   ///< there is no new run, or it cannot be compared
  stopped,  ///< by a signal, before it came to an end
};
const char* name(Probed probed);

struct ProbeResult {
  Probed probed = Probed::stopped;
  double largest = 0;      ///< relative distance of the metrics and curves [-]; NaN: nothing was compared
  std::string largest_of;  ///< the metric or column
  std::string reason;      ///< in words
  present::RunComparison comparison;
};

/// What the new run says of the old one's group.
ProbeResult judge_probe(const present::FinishedRun& before, const present::FinishedRun& now, double tolerance);

/// What came of probing every group.
struct Probes {
  std::vector<ProbeResult> results;  ///< one per group
  std::optional<int> stopped;        ///< the command's exit code, where a signal ended it early
};

/// Computes the cheapest case of every group in a folder of its own below the root, which is gone when this returns,
/// and judges it. Progress on standard error.
Probes probe(const std::vector<ProbeGroup>& groups, const std::filesystem::path& root, const execute::Sharing& sharing,
             double tolerance);

}  // namespace seapile::commands
