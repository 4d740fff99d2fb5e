// What stands for the bits of a run's final state.
#pragma once

#include <filesystem>
#include <string>

#include "runner/store/run_folder.h"

namespace seapile::store {

/// 16 hex digits that are equal when the final states are, bit for bit: the state hash; of a bed, whose run has none,
/// the first digits of the SHA-256 of its grains. "": the run kept no state of that kind. Throws StoreError.
std::string final_state(const std::filesystem::path& run_folder, const Manifest& manifest);

}  // namespace seapile::store
