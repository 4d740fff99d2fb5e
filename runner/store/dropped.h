// dropped.json in the folder of a complete run: files that were removed on purpose, to save space. The manifest stays
// as it was sealed; what is named here is no longer asked for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/store/run_folder.h"

namespace seapile::store {

inline constexpr const char* kDroppedFile = "dropped.json";

/// The text of dropped.json that names these files and those that were removed before. `manifest`: as read_manifest()
/// gives it.
std::string dropped_text(const Manifest& manifest, const std::vector<std::string>& paths);

/// Seals it, before those files are removed. Until this has returned no file may go: a crash before leaves a whole run,
/// one after leaves files that no longer count. Throws StoreError.
void write_dropped(const std::filesystem::path& run_folder, const Manifest& manifest,
                   const std::vector<std::string>& paths);

/// Takes what the folder's dropped.json names out of the manifest: its files, and the counts of frames that went with
/// them. Throws StoreError::damaged when that file is not sealed or is of another manifest.
void apply_dropped(const std::filesystem::path& run_folder, Manifest& manifest);

}  // namespace seapile::store
