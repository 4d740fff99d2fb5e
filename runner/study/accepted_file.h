// Our own values that somebody has looked at and accepted, so that a change within a published tolerance is seen too.
// One CSV file per study, accepted/<study>.csv beside it, to be kept with the study.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/study/study.h"

namespace seapile::study {

struct AcceptedValue {
  std::string case_id;  ///< 64 hex digits
  std::string metric;
  double value = 0;
  std::string unit;
  double tolerance = 0;  ///< relative
  std::string run;       ///< "0001"
  std::string numerics;  ///< versions of the modules: "grains=3 pile=1"
  std::string note;      ///< why the value is right
  friend bool operator==(const AcceptedValue&, const AcceptedValue&) = default;
};

std::filesystem::path accepted_path(const Study& study);

/// The rows of the file; none when it is not there. Throws BadInput with all problems.
std::vector<AcceptedValue> read_accepted(const std::filesystem::path& file);

/// The row of a case and metric; null: none.
const AcceptedValue* find_accepted(const std::vector<AcceptedValue>& values, const std::string& case_id,
                                   const std::string& metric);

/// Puts a value in the place of the one that its case and metric had.
void accept(std::vector<AcceptedValue>& values, AcceptedValue value);

/// The text of the file: rows sorted by case and metric, numbers in shortest round-trip form.
std::string accepted_text(std::vector<AcceptedValue> values);

}  // namespace seapile::study
