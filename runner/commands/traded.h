// What the store holds of the variants of a study.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/present/trade.h"
#include "runner/study/study.h"

namespace seapile::commands {

struct Traded {
  std::vector<present::TradedGroup> groups;  ///< one for each combination of the axes beside variant and seed
  std::vector<std::string> remarks;          ///< lines about the frozen reference
};

/// Reads the newest run of every case; what is not completed is told as a failure. A frozen reference takes the place
/// of the store's. Throws store::StoreError, and study::BadInput when no finished case has a metric of a name.
Traded traded(const study::Study& study, const std::filesystem::path& root);

/// Writes the reference's runs beside the study. Throws UsageError when the study has no reference, or not all of its
/// runs are completed. Returns the file.
std::filesystem::path freeze(const study::Study& study, const std::filesystem::path& root);

}  // namespace seapile::commands
