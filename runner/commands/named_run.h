// A run as it is named on a command line: a case id, or how it begins, and perhaps which run of the case.
#pragma once

#include <optional>
#include <string>

#include "runner/present/run_comparison.h"

namespace seapile::commands {

/// "1a2b3c" is the newest run of the case, "1a2b3c/2" its run 0002. Absent, with a line on standard error, when there
/// is none. Throws UsageError when several cases begin like that, and store::StoreError.
std::optional<present::FinishedRun> find_run(const std::string& root, const std::string& name);

}  // namespace seapile::commands
