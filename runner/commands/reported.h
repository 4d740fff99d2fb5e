// What the store holds of a study, gathered for its report.
#pragma once

#include <optional>
#include <string>

#include "runner/present/report.h"
#include "runner/study/study.h"

namespace seapile::commands {

struct ReportRequest {
  std::string study;  ///< file
  study::Options options;
  std::string root = "results";
  std::string command;  ///< by which the report is made, as one types it
};

/// Reads the run folders, the truth; the catalogue is not needed. Absent when no case of the study was ever begun.
/// Throws study::BadInput and store::StoreError.
std::optional<present::Report> reported(const ReportRequest& request);

}  // namespace seapile::commands
