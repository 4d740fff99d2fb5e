// Runs that have a series, as `curve` takes them from the catalogue, and the files that it writes.
#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "runner/present/curve.h"
#include "runner/store/catalogue.h"

namespace seapile::commands {

/// Runs with a series, all of the same.
struct CurveRuns {
  std::vector<present::CurveSource> sources;
  present::Series series = present::Series::grains;
  bool with_pile = false, without_pile = false;  ///< of basins
};

/// Those of a study ("": of all) that the conditions hold for. Throws UsageError when drives and basins are among them,
/// store::StoreError.
CurveRuns curve_runs(const store::Catalogue& catalogue, const std::filesystem::path& root, const std::string& study,
                     const std::vector<std::string>& where, bool only_completed);

/// Hands `write` a file that gets its name when it is whole; what is there already and is no regular file, such as a
/// device, is written as it stands. Throws UsageError when it cannot be written.
void write_file(const std::filesystem::path& file, const std::function<void(std::FILE*)>& write);

}  // namespace seapile::commands
