// Frozen references: the runs that a study's variants are compared with, once and for all, beside the study in frozen/.
//
//   # study: frontier_dry, of variant "reference"
//   # made with: <compiler, flags, processor, commit, versions of the numerics>
//   # own error: <what separates it from steps twice as long>
//   # sha256: <of all that follows>
//   case,seal,state,cpu[s],memory[MB],steps,<metric>,...
//
// A reference is not computed anew by who compares with it, and never tuned to what is compared.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seapile::study {

struct FrozenRun {
  std::string case_id;
  std::string seal;        ///< SHA-256 of the run's manifest
  std::string state_hash;  ///< of its final state, 16 hex digits
  double cpu_seconds = 0, peak_memory_mb = 0, steps = 0;
  std::vector<std::pair<std::string, double>> metrics;  ///< in SI units, in the run's order
};

struct Frozen {
  std::string variant, made_with, own_error;  ///< each a line of text
  std::vector<FrozenRun> runs;                ///< all with the same metrics
};

/// Where the reference of a study lies: frozen/NAME.csv beside it.
std::filesystem::path frozen_path(const std::filesystem::path& study_file, const std::string& name);

std::string frozen_text(const std::string& study, const Frozen& frozen);

/// Absent when there is no such file. Throws BadInput with all problems at once, also when the file was changed since.
std::optional<Frozen> read_frozen(const std::filesystem::path& file);

/// The run of a case; null when there is none.
const FrozenRun* find_frozen(const Frozen& frozen, const std::string& case_id);

}  // namespace seapile::study
