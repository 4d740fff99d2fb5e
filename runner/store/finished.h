// What finished cases came to, read from their run folders: the truth, also where the catalogue is behind.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runner/store/run_folder.h"

namespace seapile::store {

/// A case whose newest complete run was completed.
struct FinishedCase {
  Manifest manifest;
  std::vector<simulation::Metric> bed_metrics;  ///< of the very run of the bed that it was built on

  /// The metric of a name, "bed:NAME" of its bed; null when it has none.
  const simulation::Metric* metric(const std::string& name) const;
  /// Every name that metric() knows.
  std::vector<std::string> metric_names() const;
};

/// Whether a name means a metric: it is its name, or with a "*" at its end the beginning of it.
bool means(const std::string& name, const std::string& metric);

/// Absent when the case has no complete run, or when the newest one is not completed. `with_bed`: its metrics are read
/// too, where the bed's run is still there. Throws StoreError.
std::optional<FinishedCase> read_finished(const std::filesystem::path& root, const std::string& case_id, bool with_bed);

}  // namespace seapile::store
