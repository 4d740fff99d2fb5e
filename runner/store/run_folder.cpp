#include "runner/store/run_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "runner/store/bed_file.h"
#include "runner/store/dropped.h"
#include "runner/store/durable.h"
#include "runner/store/flow_file.h"
#include "runner/store/frames_file.h"
#include "runner/store/layout.h"
#include "runner/store/manifest.h"
#include "runner/store/series.h"
#include "runner/store/sha256.h"

namespace seapile::store {

namespace {

using Path = std::filesystem::path;

/// The runs of a case by rising number, complete or not.
std::vector<std::string> all_runs(const Path& case_folder) {
  std::vector<std::string> runs;
  for (const Path& entry : entries(case_folder)) {
    const std::string name = entry.filename().string();
    const bool is_folder = std::filesystem::symlink_status(entry).type() == std::filesystem::file_type::directory;
    if (run_number(name) > 0 && is_folder) runs.push_back(name);
  }
  std::ranges::sort(runs, {}, run_number);
  return runs;
}

bool has_manifest(const Path& run_folder) { return is_there(run_folder / kManifestFile); }

Stamp stamp_of(const Manifest& manifest) { return {manifest.header.case_id, manifest.run}; }

/// What is wrong with a file of a complete run; empty: nothing. Throws StoreError::io when it cannot be read.
std::string difference(const Path& run_folder, const FileEntry& entry) {
  const Path file = run_folder / entry.path;
  std::error_code error;
  const std::uint64_t bytes = std::filesystem::file_size(file, error);
  if (!error && bytes != entry.bytes) {
    return fmt::format("{} has {} bytes instead of {}", file.string(), bytes, entry.bytes);
  }
  if (sha256_of_file(file) != entry.sha256) return file.string() + " has another SHA-256 than the manifest says";
  return {};
}

bool is_listed(const Manifest& manifest, const std::string& path) {
  return std::ranges::find(manifest.files, path, &FileEntry::path) != manifest.files.end();
}

/// The file, compared with the manifest first: the HDF5 library can crash on a damaged one.
Path intact(const Path& run_folder, const Manifest& manifest, const std::string& path) {
  const auto entry = std::ranges::find(manifest.files, path, &FileEntry::path);
  if (entry == manifest.files.end()) {
    const bool dropped = std::ranges::find(manifest.dropped, path) != manifest.dropped.end();
    throw StoreError(StoreError::Kind::damaged,
                     run_folder.string() + (dropped ? " has no longer a " + path + ", which was dropped to save space"
                                                    : " has no " + path));
  }
  const std::string found = difference(run_folder, *entry);
  if (!found.empty()) throw StoreError(StoreError::Kind::damaged, found);
  return run_folder / path;
}

template <class R>
std::vector<R> series_of(const Path& run_folder, const Manifest& manifest) {
  hdf5::FileReader reader(intact(run_folder, manifest, "series.h5"));
  check_stamp(reader, "series", stamp_of(manifest));
  std::vector<R> records = read_series<R>(reader);
  reader.close();
  return records;
}

/// The path without dots and without a slash at its end.
Path plain(const Path& folder) {
  const Path normal = std::filesystem::absolute(folder).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

}  // namespace

bool is_case_id(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == text.npos;
}

unsigned long run_number(const std::string& name) {
  if (name.size() < 4 || name.size() > 9 || name.find_first_not_of("0123456789") != name.npos) return 0;
  return std::stoul(name);
}

std::string run_name(const Path& run_folder) { return plain(run_folder).filename().string(); }

std::optional<Claim> Claim::take(const Path& case_folder) {
  make_folder(case_folder);
  std::optional<Descriptor> lock = try_lock(case_folder / "lock");
  if (!lock) return std::nullopt;
  return Claim(lock->release());
}

Claim::Claim(int descriptor) : descriptor_(descriptor) {}

Claim::Claim(Claim&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

Claim::~Claim() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Path case_folder(const Path& root, const std::string& case_id) {
  if (!is_case_id(case_id)) throw std::invalid_argument("\"" + case_id + "\" is no case id");
  return root / "cases" / case_id;
}

Path bed_run_folder(const Path& root, const RunHeader& drive) {
  return case_folder(root, drive.bed_id) / drive.bed_run;
}

std::vector<std::string> complete_runs(const Path& case_folder) {
  std::vector<std::string> runs = all_runs(case_folder);
  std::erase_if(runs, [&](const std::string& run) { return !has_manifest(case_folder / run); });
  return runs;
}

Path newest_run(const Path& root, const std::string& case_id) {
  const Path folder = case_folder(root, case_id);
  const std::vector<std::string> runs = complete_runs(folder);
  return runs.empty() ? Path() : folder / runs.back();
}

std::string next_run(const Path& case_folder, bool resume) {
  const std::vector<std::string> runs = all_runs(case_folder);
  if (runs.empty()) return "0001";
  if (resume && !has_manifest(case_folder / runs.back())) return runs.back();
  return fmt::format("{:04}", run_number(runs.back()) + 1);
}

Manifest read_manifest(const Path& run_folder) {
  const Path file = run_folder / kManifestFile;
  Manifest manifest = parse_manifest(read_text(file), file);
  const std::string parent = plain(run_folder).parent_path().filename().string();
  // A copy elsewhere is fine; one in the place of another run is not.
  if (is_case_id(parent) && (parent != manifest.header.case_id || run_name(run_folder) != manifest.run)) {
    throw StoreError(StoreError::Kind::damaged, file.string() + " is damaged: it is of run " + manifest.run +
                                                    " of case " + manifest.header.case_id);
  }
  apply_dropped(run_folder, manifest);
  return manifest;
}

std::vector<std::string> verify(const Path& run_folder) {
  std::vector<std::string> differences;
  for (const FileEntry& entry : read_manifest(run_folder).files) {
    try {
      std::string found = difference(run_folder, entry);
      if (!found.empty()) differences.push_back(std::move(found));
    } catch (const StoreError& error) {
      differences.emplace_back(error.what());
    }
  }
  return differences;
}

std::vector<simulation::Record> read_series(const Path& run_folder) {
  const Manifest manifest = read_manifest(run_folder);
  if (is_listed(manifest, "bed.h5")) return read_bed(run_folder).records;
  if (manifest.records == 0 && manifest.header.kind == "flow") return {};
  return series_of<simulation::Record>(run_folder, manifest);
}

std::vector<simulation::FlowRecord> read_flow_series(const Path& run_folder) {
  const Manifest manifest = read_manifest(run_folder);
  if (manifest.flow_records == 0) return {};
  return series_of<simulation::FlowRecord>(run_folder, manifest);
}

simulation::Bed read_bed(const Path& run_folder) {
  const Manifest manifest = read_manifest(run_folder);
  return read_bed(intact(run_folder, manifest, "bed.h5"), stamp_of(manifest));
}

std::size_t frame_count(const Path& run_folder) { return read_manifest(run_folder).frames; }

simulation::Frame read_frame(const Path& run_folder, std::size_t index) {
  const Manifest manifest = read_manifest(run_folder);
  if (index >= manifest.frames) throw std::out_of_range("the run has no frame " + std::to_string(index));
  for (const char* file : kFrameFiles) intact(run_folder, manifest, file);
  return read_frame(run_folder, stamp_of(manifest), index);
}

std::size_t flow_frame_count(const Path& run_folder) { return read_manifest(run_folder).flow_frames; }

simulation::FlowFrame read_flow_frame(const Path& run_folder, std::size_t index) {
  const Manifest manifest = read_manifest(run_folder);
  if (index >= manifest.flow_frames) throw std::out_of_range("the run has no flow frame " + std::to_string(index));
  intact(run_folder, manifest, kFlowFile);
  const bool with_surface = is_listed(manifest, kSurfaceFile);
  if (with_surface) intact(run_folder, manifest, kSurfaceFile);
  return read_flow_frame(run_folder, stamp_of(manifest), index, with_surface);
}

std::vector<double> flow_frame_times(const Path& run_folder) {
  const Manifest manifest = read_manifest(run_folder);
  if (manifest.flow_frames == 0) return {};
  return read_flow_times(intact(run_folder, manifest, kFlowFile).parent_path(), stamp_of(manifest));
}

std::vector<double> asked_depths(const Path& run_folder) {
  const Manifest manifest = read_manifest(run_folder);
  if (manifest.frames == 0) return {};
  intact(run_folder, manifest, kFrameFiles.front());
  return read_asked_depths(run_folder, stamp_of(manifest));
}

}  // namespace seapile::store
