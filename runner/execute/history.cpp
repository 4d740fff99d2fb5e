#include "runner/execute/history.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <fstream>
#include <system_error>

#include "runner/execute/attempt.h"
#include "runner/store/run_folder.h"

namespace seapile::execute {
namespace {

namespace fs = std::filesystem;

/// One sentence about the first file that is missing or has another size; the full check is `runner verify`.
std::string visible_damage(const fs::path& run_folder, const store::Manifest& manifest) {
  for (const store::FileEntry& file : manifest.files) {
    std::error_code error;
    const auto bytes = fs::file_size(run_folder / file.path, error);
    if (error) return fmt::format("run {} is damaged: {} is missing", manifest.run, file.path);
    if (bytes != file.bytes) {
      return fmt::format("run {} is damaged: {} has {} bytes instead of {}", manifest.run, file.path, bytes,
                         file.bytes);
    }
  }
  return "";
}

/// Of a run whose frames were dropped none counts as recorded; one without its series is of no use to a study.
void note_dropped(const store::Manifest& manifest, PastRun& past) {
  for (const std::string& path : manifest.dropped) {
    if (path == "series.h5" && past.damage.empty())
      past.damage = fmt::format("the series of run {} was dropped to save space", manifest.run);
    if (!path.ends_with(".vtkhdf") || !past.record) continue;
    past.record->frames.clear();
    past.record->times.clear();
  }
}

PastRun read_past(const fs::path& run_folder, const std::string& run) {
  PastRun past;
  past.run = run;
  try {
    const store::Manifest manifest = store::read_manifest(run_folder);
    past.outcome = manifest.result.outcome;
    past.reason = manifest.result.reason;
    past.numerics = manifest.header.numerics;
    past.bed_run = manifest.header.bed_run;
    if (!manifest.header.record_json.empty()) past.record = study::record_from_json(manifest.header.record_json);
    past.damage = visible_damage(run_folder, manifest);
    note_dropped(manifest, past);
  } catch (const store::StoreError& error) {
    past.damage = fmt::format("run {} is damaged: {}", run, error.what());
  } catch (const study::BadInput& error) {
    past.damage = fmt::format("run {} is damaged: {}", run, error.what());
  }
  return past;
}

}  // namespace

fs::path unfinished_run(const fs::path& root, const std::string& case_id) {
  const fs::path folder = store::case_folder(root, case_id);
  if (!fs::is_directory(folder)) return {};
  const auto complete = store::complete_runs(folder);
  const std::string open = store::next_run(folder, true);
  const bool newer = complete.empty() || open > complete.back();
  return newer && fs::is_directory(folder / open) ? folder / open : fs::path();
}

History read_history(const fs::path& root, const std::string& case_id) {
  History history;
  const fs::path folder = store::case_folder(root, case_id);
  if (!fs::is_directory(folder)) return history;
  const auto complete = store::complete_runs(folder);
  if (!complete.empty()) history.past = read_past(folder / complete.back(), complete.back());
  if (const fs::path open = unfinished_run(root, case_id); !open.empty()) {
    InterruptedRun interrupted;
    interrupted.run = open.filename().string();
    if (const auto attempt = read_attempt(open)) {
      interrupted.checkpoint = fs::exists(open / "checkpoint" / "a.h5") || fs::exists(open / "checkpoint" / "b.h5");
      interrupted.numerics = attempt->numerics;
      interrupted.record = attempt->record;
      interrupted.bed_run = attempt->bed_run;
    }
    history.interrupted = std::move(interrupted);
  }
  return history;
}

bool is_seen_claimed(const fs::path& root, const std::string& case_id) {
  struct stat lock {};
  if (::stat((store::case_folder(root, case_id) / "lock").c_str(), &lock) != 0) return false;
  const std::string wanted =
      fmt::format(" {:02x}:{:02x}:{} ", major(lock.st_dev), minor(lock.st_dev), lock.st_ino);  // as proc(5) writes it
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    // "->" stands before those who wait for the lock.
    if (line.find("FLOCK") != std::string::npos && line.find("->") == std::string::npos &&
        line.find(wanted) != std::string::npos)
      return true;
  }
  return false;
}

bool is_claimed(const fs::path& root, const std::string& case_id) {
  return !store::Claim::take(store::case_folder(root, case_id)).has_value();
}

}  // namespace seapile::execute
