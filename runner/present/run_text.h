#pragma once

#include <filesystem>
#include <string>

#include "runner/store/run_folder.h"

namespace seapile::present {

/// Everything that is known of one run, for people. `command` does it once more.
std::string run_text(const store::Manifest& manifest, const std::filesystem::path& run_folder,
                     const std::string& command);

/// A study file whose only case is this run's.
std::string study_text(const store::Manifest& manifest);

}  // namespace seapile::present
