#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "runner/execute/plan.h"

namespace seapile::cluster {

/// The median CPU time [s] of completed runs of a kind: of the study's own where there are any, else of the whole
/// catalogue; absent without history. Reads only.
std::optional<double> median_cpu_seconds(const std::filesystem::path& root, const std::string& study,
                                         execute::Kind kind);

/// "bed", "drive" or "flow", as requests and the catalogue write it.
const char* kind_name(execute::Kind kind);

}  // namespace seapile::cluster
