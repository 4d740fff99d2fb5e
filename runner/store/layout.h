#pragma once

#include <filesystem>
#include <string>

namespace seapile::store {

inline constexpr const char* kManifestFile = "manifest.json";

/// Whether a text is one: 64 lower-case hex digits.
bool is_case_id(const std::string& text);

/// The number that a run's folder is named by; 0 when it is no run's.
unsigned long run_number(const std::string& name);

/// The last part of a run folder's path, also when the path ends in a slash.
std::string run_name(const std::filesystem::path& run_folder);

}  // namespace seapile::store
