// attempt.json in the folder of a run that has no manifest yet: what it was made with, so that a later attempt knows
// whether it may go on from its checkpoint, and what it has cost so far.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "solver/scene/spec.h"
#include "solver/simulation/run.h"

namespace seapile::execute {

struct Attempt {
  int count = 0;            ///< times that the run was started or resumed
  double cpu_seconds = 0;   ///< up to the last checkpoint
  double wall_seconds = 0;  ///< up to the last checkpoint
  std::vector<simulation::NumericsVersion> numerics;
  std::optional<scene::RecordSpec> record;  ///< absent where runs of the scene are not recorded
  std::string bed_run;                      ///< "" without a bed
};

/// Throws store::StoreError.
void write_attempt(const std::filesystem::path& run_folder, const Attempt& attempt);

/// Absent when there is none that can be read: such a run is begun again.
std::optional<Attempt> read_attempt(const std::filesystem::path& run_folder);

/// Once the manifest says it all. Never fails.
void remove_attempt(const std::filesystem::path& run_folder);

}  // namespace seapile::execute
