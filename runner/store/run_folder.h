// The sealed run folder: the truth about one run of one case.
//
//   <root>/catalogue.sqlite                 an index, rebuilt from the folders at any time
//   <root>/cases/<case id>/lock             flock: who holds it may run the case
//   <root>/cases/<case id>/<nnnn>/          one run; complete if and only if manifest.json is there and verifies
//       manifest.json  series.h5  grains.vtkhdf + .xdmf  contacts.vtkhdf + .xdmf  fields.vtkhdf + .xdmf
//       bed.h5 (a bed's grains, exact)  flow.vtkhdf + .xdmf  surface.h5 (the water's mesh and free surface)
//       checkpoint/a.h5, b.h5  segment/<nnnnnn>.h5 (only while running)  post_mortem.h5 (diverged)  log.txt
//
// The seal of every file: written under a temporary name, flushed, every close's return code checked, fsynced,
// re-opened and compared with what was held, renamed, directory fsynced. On the first error StoreError is thrown and
// nothing is published.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runner/store/store_error.h"
#include "solver/simulation/array.h"
#include "solver/simulation/flow_frame.h"
#include "solver/simulation/flow_record.h"
#include "solver/simulation/frame.h"
#include "solver/simulation/record.h"
#include "solver/simulation/run.h"

namespace seapile::store {

/// An exclusive claim on a case, held until destroyed or the process dies.
class Claim {
 public:
  /// Absent when another process holds it.
  static std::optional<Claim> take(const std::filesystem::path& case_folder);
  Claim(Claim&&) noexcept;
  ~Claim();

 private:
  explicit Claim(int descriptor);
  int descriptor_;
};

/// What is known of a run before it starts.
struct RunHeader {
  std::string kind;         ///< "bed", "drive" or "flow"
  std::string case_id;      ///< 64 hex digits
  std::string canonical;    ///< canonical text of the case
  std::string scene_json;   ///< the full scene, as study::to_json gives it
  std::string bed_id;       ///< case id of the bed ("" where there is none)
  std::string bed_run;      ///< run number of the bed that was used ("" where there is none)
  std::string record_json;  ///< what was asked to be recorded
  std::vector<simulation::Part> parts;
  std::vector<simulation::NumericsVersion> numerics;
};

/// How it was done. Kept beside the result; enters no identity.
struct Provenance {
  std::string version, commit;  ///< of Seapile
  bool dirty = false;
  std::string compiler, flags, build_type;
  std::string libraries;  ///< "HDF5 1.10.8, ..."
  std::string host_cpu;
  int cores = 0, threads = 0;
  std::string simd;
  double cpu_seconds = 0, wall_seconds = 0, peak_memory_mb = 0;
  int attempts = 1;  ///< times that the run was started or resumed
};

/// A file of a run, as its manifest lists it.
struct FileEntry {
  std::string path;  ///< relative to the run folder
  std::uint64_t bytes = 0;
  std::string sha256;
};

/// A complete run, as manifest.json says.
struct Manifest {
  int schema = 1;
  std::string run;   ///< "0001"
  RunHeader header;  ///< its JSON texts come back compact, whatever their spacing was
  std::size_t records = 0, frames = 0, flow_records = 0, flow_frames = 0;
  simulation::RunResult result;
  Provenance provenance;
  std::vector<FileEntry> files;
  std::string seal;                       ///< SHA-256 of the manifest's own text, when read
  std::vector<std::string> dropped = {};  ///< files that were removed on purpose and no longer count (dropped.h)
};

/// What an interrupted run left behind.
struct Resumable {
  std::vector<simulation::Array> state;              ///< of the newest checkpoint that verifies
  std::vector<simulation::Record> records;           ///< of the sealed segments up to that checkpoint
  std::size_t frames = 0;                            ///< frames in those segments
  std::vector<simulation::FlowRecord> flow_records;  ///< records of the water in those segments
  std::size_t flow_frames = 0;                       ///< frames of the water in those segments
};

/// Writes one run. Records and frames are held in memory until a checkpoint seals them into a segment.
class RunWriter {
 public:
  /// Opens the run folder (created if missing). An interrupted run's segments beyond its newest good checkpoint are
  /// set aside. The caller holds the case's claim. Throws StoreError.
  RunWriter(std::filesystem::path folder, RunHeader header);

  /// What can be continued; empty state when there is nothing.
  const Resumable& resumable() const;

  void add(const simulation::Record& record);
  void add(const simulation::FlowRecord& record);
  /// Throw std::logic_error when a frame is not what its header promises.
  void add(const simulation::Frame& frame);
  void add(const simulation::FlowFrame& frame);

  /// Seals the records and frames since the last call and the state, alternating a.h5 and b.h5.
  void checkpoint(const std::vector<simulation::Array>& state);

  /// Seals the state that a diverged run could not accept, beside its last accepted one, the newest checkpoint.
  void post_mortem(const std::vector<simulation::Array>& rejected, const std::string& reason);

  /// Merges, seals and verifies every file, writes the manifest last, then removes segments and checkpoints (a diverged
  /// run keeps them). `bed`: for a bed's run, its grains, porosity profile and records (bed.h5 instead of series.h5;
  /// records that were add()ed must be the same). A flow without records of any kind has no series.h5. A stopped run is
  /// not finished: std::logic_error.
  void finish(const simulation::RunResult& result, Provenance provenance, const simulation::Bed* bed);

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

/// The folder of a case below a store's root.
std::filesystem::path case_folder(const std::filesystem::path& root, const std::string& case_id);

/// The folder of the very run of the bed that a drive was built on.
std::filesystem::path bed_run_folder(const std::filesystem::path& root, const RunHeader& drive);

/// The runs of a case that have a manifest, newest last.
std::vector<std::string> complete_runs(const std::filesystem::path& case_folder);

/// The newest of them, as a path; empty when there is none.
std::filesystem::path newest_run(const std::filesystem::path& root, const std::string& case_id);

/// The number that a new run gets: that of the newest folder when it has no manifest (to be resumed) and `resume`, else
/// a new one.
std::string next_run(const std::filesystem::path& case_folder, bool resume);

/// Reads a manifest, without the files that were dropped on purpose; throws StoreError::damaged when it is not one, is
/// newer than this program, or is for another case.
Manifest read_manifest(const std::filesystem::path& run_folder);

/// Checks every file's size and SHA-256 against the manifest; returns one sentence per file that differs. Throws like
/// read_manifest().
std::vector<std::string> verify(const std::filesystem::path& run_folder);

// The readers of a complete run compare each file with the manifest before the HDF5 library sees it.

/// Reads the whole series of a complete run; empty where there is none. Throws StoreError.
std::vector<simulation::Record> read_series(const std::filesystem::path& run_folder);

/// The same of the records of the water.
std::vector<simulation::FlowRecord> read_flow_series(const std::filesystem::path& run_folder);

/// Reads a bed's run back, bit for bit what finish() was given. Throws StoreError.
simulation::Bed read_bed(const std::filesystem::path& run_folder);

/// Number of frames of a complete run, and one of them, bit for bit. Throw StoreError.
std::size_t frame_count(const std::filesystem::path& run_folder);
simulation::Frame read_frame(const std::filesystem::path& run_folder, std::size_t index);

/// The same of the frames of the water.
std::size_t flow_frame_count(const std::filesystem::path& run_folder);
simulation::FlowFrame read_flow_frame(const std::filesystem::path& run_folder, std::size_t index);

/// Their times [s], in their order.
std::vector<double> flow_frame_times(const std::filesystem::path& run_folder);

/// The depths [m] that the frames of a complete run were asked for, in their order. Throws StoreError.
std::vector<double> asked_depths(const std::filesystem::path& run_folder);

/// Writes a small text file by the same seal (temporary name, fsync, rename, directory fsync).
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace seapile::store
