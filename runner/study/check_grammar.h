// One entry of a study's "checks", taken apart; no file is read yet.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runner/study/assignment.h"
#include "runner/study/json_value.h"

namespace seapile::study {

struct CheckText {
  PlacePtr place;
  std::string metric;
  std::string file;  ///< "reference/tip.csv"; "": the value stands in the study
  double value = 0, tolerance = 0;
  std::optional<double> at_least, at_most;  ///< instead of value and tolerance
  std::string unit;                         ///< of all; "": the metric's own
  std::string source;
  std::optional<Match> which;  ///< limits the cases
  double drift = 0;
};

/// The entries that are free of problems.
std::vector<CheckText> read_checks(const std::vector<Value>& list, base::Problems& problems);

}  // namespace seapile::study
