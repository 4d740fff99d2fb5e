// Small files in the folder of a run that is not finished, for `runner status`: how far it has come, and how its last
// attempt ended. They are no part of a result: nothing is decided by them, and a finished run has none.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seapile::execute {

/// progress.json, written every few seconds by the worker.
struct RunProgress {
  double fraction = 0;        ///< of simulated time or depth, 0..1
  double start_fraction = 0;  ///< where this attempt began
  double elapsed = 0;         ///< [s] of wall time, of this attempt
  int threads = 1;
  std::string host;  ///< on which it runs
};

/// failure.json, written when an attempt has ended without a result.
struct Failure {
  std::string kind;      ///< "killed", "io", "failed"
  std::string sentence;  ///< "killed by SIGKILL (Killed)"
};

// Writers never throw: a note that cannot be written is a note less. Readers give nothing where there is none.
void write_progress(const std::filesystem::path& run_folder, const RunProgress& progress) noexcept;
std::optional<RunProgress> read_progress(const std::filesystem::path& run_folder);
void write_failure(const std::filesystem::path& run_folder, const Failure& failure) noexcept;
std::optional<Failure> read_failure(const std::filesystem::path& run_folder);
void remove_notes(const std::filesystem::path& run_folder) noexcept;

/// The last `count` lines of a run's log; fewer when it has fewer.
std::vector<std::string> last_log_lines(const std::filesystem::path& run_folder, std::size_t count);

}  // namespace seapile::execute
