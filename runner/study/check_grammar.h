// One entry of a study's "checks", taken apart; no file is read yet.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runner/study/assignment.h"
#include "runner/study/json_value.h"
#include "runner/study/unit.h"

namespace seapile::study {

struct CheckText {
  PlacePtr place;
  std::string metric;
  std::string file;            ///< "reference/tip.csv"; "": the value stands in the study
  Quantity value, tolerance;   ///< in the study
  std::string source;          ///< in the study
  std::optional<Match> which;  ///< limits the cases
  double drift = 0;
};

/// The entries that are free of problems.
std::vector<CheckText> read_checks(const std::vector<Value>& list, base::Problems& problems);

}  // namespace seapile::study
