// What the planner wants to know of a case, read from the store.
#pragma once

#include <filesystem>
#include <string>

#include "runner/execute/plan.h"

namespace seapile::execute {

/// Reads only. A run that cannot be used is told with its damage, never thrown.
History read_history(const std::filesystem::path& root, const std::string& case_id);

/// The folder of a run that is newer than all complete ones and has not come to an end; empty when there is none.
std::filesystem::path unfinished_run(const std::filesystem::path& root, const std::string& case_id);

/// Whether a live process holds the case's claim. Tries to take it, and lets go.
bool is_claimed(const std::filesystem::path& root, const std::string& case_id);

/// The same without touching the claim, for those who only look: by the kernel's list of locks, which knows those of
/// this machine alone.
bool is_seen_claimed(const std::filesystem::path& root, const std::string& case_id);

}  // namespace seapile::execute
