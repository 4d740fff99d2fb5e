// Published values of one metric as CSV: in the first line "# source: ...", then a header of scene paths with their
// units, the metric with its unit, "tolerance" and "reason", then a row for each value.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "runner/study/assignment.h"

namespace seapile::study {

struct ReferenceRow {
  std::size_t line = 0;
  Match which;                      ///< what a case must have
  double value = 0, tolerance = 0;  ///< in the file's unit
  std::string reason;
};

struct ReferenceFile {
  std::string source;
  std::string unit;  ///< of every value and tolerance
  std::vector<ReferenceRow> rows;
};

/// Takes the text of a file apart. Each problem's `what` begins with its line; the pointer is left to the caller.
ReferenceFile parse_reference(std::string_view text, const std::string& metric, base::Problems& problems);

/// Reads the file that a study calls `name`, from the study's folder or below it. Each problem's `what` begins with the
/// name; the pointer is left to the caller.
ReferenceFile read_reference(const std::filesystem::path& folder, const std::string& name, const std::string& metric,
                             base::Problems& problems);

}  // namespace seapile::study
