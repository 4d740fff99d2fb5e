#include "runner/store/disk_use.h"

#include <algorithm>
#include <array>
#include <regex>
#include <set>

#include "runner/store/durable.h"
#include "runner/store/layout.h"
#include "runner/store/run_folder.h"

namespace seapile::store {

namespace {

namespace fs = std::filesystem;
using Path = fs::path;

/// The files of a folder of the run, and of its folders of running files.
void list(const Path& folder, const std::string& before, StoredRun& run) {
  for (const Path& entry : entries(folder)) {
    const std::string path = before + entry.filename().string();
    const fs::file_type type = fs::symlink_status(entry).type();
    if (type == fs::file_type::directory && (path == "checkpoint" || path == "segment")) {
      list(entry, path + "/", run);
      continue;
    }
    const auto purpose = purpose_of(path);
    if (type != fs::file_type::regular || !purpose) {
      run.strange.push_back(path);
    } else {
      run.files.push_back({path, *purpose, fs::file_size(entry)});
    }
  }
}

/// In a complete run what the manifest no longer counts is left over: dropped, or not removed when it was finished.
void judge_complete(StoredRun& run) {
  try {
    const Manifest manifest = read_manifest(run.folder);
    run.completed = manifest.result.outcome == simulation::Outcome::completed;
    run.bed_id = manifest.header.bed_id;
    run.bed_run = manifest.header.bed_run;
    for (StoredFile& file : run.files) {
      const bool counts = std::ranges::find(manifest.files, file.path, &FileEntry::path) != manifest.files.end();
      if (!counts && file.purpose != Purpose::record) file.purpose = Purpose::leftover;
    }
  } catch (const StoreError& error) {
    run.trouble = error.what();
  }
}

}  // namespace

const char* name(Purpose purpose) {
  constexpr std::array<const char*, kPurposes> kNames = {"record", "grains",      "series",
                                                         "fields", "checkpoints", "leftovers"};
  return kNames[static_cast<std::size_t>(purpose)];
}

std::optional<Purpose> purpose_of(const std::string& path) {
  static const std::set<std::string> kRecord = {kManifestFile,  "dropped.json",  "log.txt",
                                                "attempt.json", "progress.json", "failure.json"};
  static const std::regex kFields("(grains|contacts|fields|flow)\\.(vtkhdf|xdmf)|surface\\.h5");
  static const std::regex kRunning("checkpoint/[ab]\\.h5|segment/[0-9]{6}\\.h5|post_mortem\\.h5");
  if (is_temporary(path) || path.ends_with(".aside")) return Purpose::leftover;
  if (kRecord.contains(path)) return Purpose::record;
  if (path == "bed.h5") return Purpose::grains;
  if (path == "series.h5") return Purpose::series;
  if (std::regex_match(path, kFields)) return Purpose::fields;
  if (std::regex_match(path, kRunning)) return Purpose::checkpoint;
  return std::nullopt;
}

std::vector<StoredRun> runs_on_disk(const Path& case_folder) {
  std::vector<StoredRun> runs;
  for (const Path& entry : entries(case_folder)) {
    const std::string number = entry.filename().string();
    if (run_number(number) == 0 || fs::symlink_status(entry).type() != fs::file_type::directory) continue;
    StoredRun run;
    run.folder = entry;
    run.case_id = case_folder.filename().string();
    run.run = number;
    list(entry, "", run);
    run.complete = is_there(entry / kManifestFile);
    run.modified = fs::last_write_time(run.complete ? entry / kManifestFile : entry);
    if (run.complete) judge_complete(run);
    runs.push_back(std::move(run));
  }
  std::ranges::sort(runs, {}, [](const StoredRun& run) { return run_number(run.run); });
  if (!runs.empty()) runs.back().newest = true;
  return runs;
}

std::vector<StoredRun> runs_in_store(const Path& root) {
  std::vector<StoredRun> all;
  for (const Path& folder : entries(root / "cases")) {
    if (!is_case_id(folder.filename().string()) || fs::is_symlink(folder)) continue;
    for (StoredRun& run : runs_on_disk(folder)) all.push_back(std::move(run));
  }
  return all;
}

std::uint64_t bytes_of(const StoredRun& run) {
  std::uint64_t bytes = 0;
  for (const StoredFile& file : run.files) bytes += file.bytes;
  return bytes;
}

std::uint64_t bytes_below(const Path& folder) {
  std::uint64_t bytes = 0;
  for (const Path& entry : entries(folder)) {
    const fs::file_type type = fs::symlink_status(entry).type();
    if (type == fs::file_type::directory) bytes += bytes_below(entry);
    if (type == fs::file_type::regular) bytes += fs::file_size(entry);
  }
  return bytes;
}

}  // namespace seapile::store
