// What the store holds of a study's checked metrics.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runner/present/comparison.h"
#include "runner/store/finished.h"
#include "runner/study/accepted_file.h"
#include "runner/study/study.h"

namespace seapile::commands {

/// A metric of a case that some check is about; a claim watches nothing, as it has no value to be accepted.
struct Watched {
  std::string metric;
  std::size_t study_case;  ///< index
  double drift;            ///< the smallest of the checks
};

/// A metric that a check or a claim needs of some cases.
struct Asked {
  std::string pointer;  ///< of the check or claim
  std::string metric;
  std::vector<std::size_t> cases;  ///< by index
};

class CheckedCases {
 public:
  /// Reads the newest run of every case that a check or a claim is about. Throws store::StoreError, and study::BadInput
  /// when no finished case has a metric of that name.
  CheckedCases(const study::Study& study, const std::filesystem::path& root);

  /// Metrics and cases, each once, in the order of the checks.
  const std::vector<Watched>& watched() const { return watched_; }

  /// The finished case; null: it has no completed result.
  const store::FinishedCase* finished(std::size_t study_case) const;
  /// Its metric; null also when the run lacks it.
  const simulation::Metric* metric(std::size_t study_case, const std::string& name) const;

  /// The unit that the store has the claim's metric in; before any case is finished that of the bound is as good.
  std::string unit(const study::Claim& claim) const;

  /// Throws study::BadInput when a published value is in units of something else.
  std::vector<present::Comparison> with_published() const;
  /// Throws study::BadInput when an accepted value is in units of something else.
  std::vector<present::Comparison> with_accepted(const std::vector<study::AcceptedValue>& accepted) const;

 private:
  void refuse_unknown_metrics() const;
  std::string unit(const Asked& asked, const std::string& as_written) const;
  present::Measured measured(std::size_t study_case, const std::string& metric) const;

  const study::Study& study_;
  std::vector<Asked> checks_, claims_;  ///< in the study's order
  std::map<std::size_t, std::optional<store::FinishedCase>> cases_;
  std::vector<Watched> watched_;
};

/// Versions of the numerics that a run was made with: "grains=3 pile=1".
std::string numerics_text(const std::vector<simulation::NumericsVersion>& numerics);

}  // namespace seapile::commands
