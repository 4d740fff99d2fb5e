// What an interrupted run left behind, and how much of it holds.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/store/segment.h"

namespace seapile::store {

/// The newest point from which a run can go on.
struct Recovered {
  Checkpoint checkpoint;                        ///< generation 0: from the start
  std::vector<std::filesystem::path> segments;  ///< of the generations 1..generation
};

std::filesystem::path segment_file(const std::filesystem::path& run_folder, std::int64_t generation);
/// Odd generations are a, even ones b: the newest good checkpoint is never written over.
std::filesystem::path checkpoint_file(const std::filesystem::path& run_folder, std::int64_t generation);

/// Finds the newest checkpoint that verifies together with every segment that it builds on. Newer checkpoints and
/// segments, and damaged ones, are set aside under another name, never deleted: the run that goes on writes its own.
Recovered recover(const std::filesystem::path& run_folder, const Stamp& stamp);

}  // namespace seapile::store
