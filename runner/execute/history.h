// What the planner wants to know of a case, read from the store.
#pragma once

#include <filesystem>
#include <string>

#include "runner/execute/plan.h"

namespace seapile::execute {

/// Reads only. A run that cannot be used is told with its damage, never thrown.
History read_history(const std::filesystem::path& root, const std::string& case_id);

/// Whether a live process holds the case's claim.
bool is_claimed(const std::filesystem::path& root, const std::string& case_id);

}  // namespace seapile::execute
