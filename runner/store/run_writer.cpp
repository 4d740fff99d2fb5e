#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "runner/store/bed_file.h"
#include "runner/store/durable.h"
#include "runner/store/flow_file.h"
#include "runner/store/frames_file.h"
#include "runner/store/layout.h"
#include "runner/store/manifest.h"
#include "runner/store/recovery.h"
#include "runner/store/run_folder.h"
#include "runner/store/seal.h"
#include "runner/store/series.h"
#include "runner/store/sha256.h"
#include "runner/store/well_formed.h"

namespace seapile::store {

namespace {

using Path = std::filesystem::path;
using simulation::FlowRecord;
using simulation::Record;

// Everything that a run can consist of, once it is complete.
constexpr std::array kMerged = {"bed.h5",      "contacts.vtkhdf", "contacts.xdmf", "fields.vtkhdf",
                                "fields.xdmf", "flow.vtkhdf",     "flow.xdmf",     "grains.vtkhdf",
                                "grains.xdmf", "post_mortem.h5",  "series.h5",     "surface.h5"};
// What a run seals while it runs.
constexpr std::array kRunning = {"checkpoint", "segment"};

/// SHA-256 of everything that the two halves of a resumed run must agree in, versions of the numerics included.
std::string fingerprint_of(const RunHeader& header) {
  nlohmann::json numerics = nlohmann::json::array();
  for (const auto& [module, version] : header.numerics) numerics.push_back({module, version});
  return sha256(nlohmann::json{header.kind, header.case_id, header.scene_json, header.bed_id, header.bed_run,
                               header.record_json, numerics}
                    .dump());
}

/// What a killed writer was about to seal, and what a run that was killed while it finished had merged already: it is
/// merged anew, perhaps into fewer files.
void remove_leftovers(const Path& run_folder) {
  for (const Path& folder : {run_folder, run_folder / "segment", run_folder / "checkpoint"}) {
    for (const Path& file : entries(folder)) {
      if (is_temporary(file)) discard(file);
    }
  }
  for (const char* file : kMerged) discard(run_folder / file);
}

bool same_bits(const Record& a, const Record& b) { return std::memcmp(&a, &b, sizeof(Record)) == 0; }

/// The sealed files of a run. What others keep in its folder, such as the log, goes on changing after the manifest.
std::vector<FileEntry> list_files(const Path& folder, bool with_running) {
  std::vector<std::string> paths;
  for (const char* file : kMerged) {
    if (is_there(folder / file)) paths.emplace_back(file);
  }
  for (const char* running : kRunning) {
    if (!with_running) continue;
    for (const Path& file : entries(folder / running)) paths.push_back(running + ("/" + file.filename().string()));
  }
  std::ranges::sort(paths);
  std::vector<FileEntry> files;
  for (const std::string& path : paths) {
    files.push_back({path, std::filesystem::file_size(folder / path), sha256_of_file(folder / path)});
  }
  return files;
}

}  // namespace

struct RunWriter::Impl {
  Path folder;
  RunHeader header;
  Stamp stamp;
  std::int64_t generation = 0;  ///< of the newest checkpoint
  std::vector<Path> segments;
  std::vector<std::string> digests;  ///< SHA-256 of the segments
  Resumable resumable;
  Segment pending;  ///< since the last segment

  void open();
  void seal_segment();
  template <class R>
  std::vector<R> all_records() const;
  FrameSource all_frames() const { return all_of_a_kind(&segment_frame_count, &segment_frame); }
  FlowFrameSource all_flow_frames() const { return all_of_a_kind(&segment_flow_frame_count, &segment_flow_frame); }
  /// `count_in` and `load` know the frames of one segment.
  template <class F>
  OnDemand<F> all_of_a_kind(std::size_t (*count_in)(const Path&, const Stamp&),
                            F (*load)(const Path&, const Stamp&, std::size_t)) const;
};

void RunWriter::Impl::open() {
  for (const char* running : kRunning) make_folder(folder / running);
  if (is_there(folder / kManifestFile)) throw std::logic_error(folder.string() + " is complete already");
  remove_leftovers(folder);
  Recovered recovered = recover(folder, stamp);
  generation = recovered.checkpoint.generation;
  segments = std::move(recovered.segments);
  digests = std::move(recovered.checkpoint.segments);
  resumable.state = std::move(recovered.checkpoint.state);
  resumable.records = all_records<Record>();
  resumable.frames = all_frames().count;
  resumable.flow_records = all_records<FlowRecord>();
  resumable.flow_frames = all_flow_frames().count;
}

void RunWriter::Impl::seal_segment() {
  const Path file = segment_file(folder, static_cast<std::int64_t>(segments.size()) + 1);
  write_segment(file, stamp, pending);
  segments.push_back(file);
  digests.push_back(sha256_of_file(file));
  pending = {};
}

template <class R>
std::vector<R> RunWriter::Impl::all_records() const {
  std::vector<R> all;
  for (const Path& segment : segments) {
    const std::vector<R> some = segment_records<R>(segment, stamp);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

template <class F>
OnDemand<F> RunWriter::Impl::all_of_a_kind(std::size_t (*count_in)(const Path&, const Stamp&),
                                           F (*load)(const Path&, const Stamp&, std::size_t)) const {
  std::vector<std::pair<Path, std::size_t>> places;  // The segment of a frame, and its place there.
  for (const Path& segment : segments) {
    const std::size_t count = count_in(segment, stamp);
    for (std::size_t i = 0; i < count; ++i) places.emplace_back(segment, i);
  }
  const std::size_t count = places.size();
  return {count, [places = std::move(places), load, this](std::size_t k) {
            return load(places.at(k).first, stamp, places.at(k).second);
          }};
}

RunWriter::RunWriter(Path folder, RunHeader header) : impl_(std::make_shared<Impl>()) {
  impl_->stamp = {header.case_id, run_name(folder), fingerprint_of(header)};
  impl_->folder = std::move(folder);
  impl_->header = std::move(header);
  impl_->open();
}

const Resumable& RunWriter::resumable() const { return impl_->resumable; }

void RunWriter::add(const Record& record) { impl_->pending.records.push_back(record); }

void RunWriter::add(const FlowRecord& record) { impl_->pending.flow_records.push_back(record); }

void RunWriter::add(const simulation::Frame& frame) {
  require_well_formed(frame);
  impl_->pending.frames.push_back(frame);
}

void RunWriter::add(const simulation::FlowFrame& frame) {
  require_well_formed(frame);
  impl_->pending.flow_frames.push_back(frame);
}

void RunWriter::checkpoint(const std::vector<simulation::Array>& state) {
  // Only the checkpoint makes its segment count: killed in between, the run goes on from the one before.
  impl_->seal_segment();
  const std::int64_t generation = impl_->generation + 1;
  write_checkpoint(checkpoint_file(impl_->folder, generation), impl_->stamp, {generation, impl_->digests, state});
  impl_->generation = generation;
}

void RunWriter::post_mortem(const std::vector<simulation::Array>& rejected, const std::string& reason) {
  write_post_mortem(impl_->folder / "post_mortem.h5", {impl_->stamp.case_id, impl_->stamp.run}, rejected, reason);
}

void RunWriter::finish(const simulation::RunResult& result, Provenance provenance, const simulation::Bed* bed) {
  if (result.outcome == simulation::Outcome::stopped) throw std::logic_error("a stopped run is not finished");
  Impl& run = *impl_;
  if (!run.pending.empty()) run.seal_segment();

  const Stamp stamp{run.stamp.case_id, run.stamp.run};
  const auto records = run.all_records<Record>();
  const auto flow_records = run.all_records<FlowRecord>();
  if (bed != nullptr) {
    if (!records.empty() && !std::ranges::equal(records, bed->records, same_bits)) {
      throw std::logic_error("the records of a bed's run are not those of the bed");
    }
    write_bed(run.folder / "bed.h5", stamp, *bed);
  } else if (run.header.kind != "flow" || !records.empty() || !flow_records.empty()) {
    seal(run.folder / "series.h5", hdf5::Storage::packed, [&](hdf5::FileWriter& writer) {
      write_stamp(writer, "series", stamp);
      if (run.header.kind != "flow" || !records.empty()) write_series(writer, records);
      if (!flow_records.empty()) write_series(writer, flow_records);
    });
  }
  const FrameSource frames = run.all_frames();
  write_frames(run.folder, stamp, frames);
  const FlowFrameSource flow_frames = run.all_flow_frames();
  write_flow_frames(run.folder, stamp, flow_frames);

  // The segments hold what led to a divergence; of a completed run everything is in the files just sealed.
  const bool keep_running = result.outcome == simulation::Outcome::diverged;
  Manifest manifest{kSchema,
                    stamp.run,
                    run.header,
                    bed != nullptr ? bed->records.size() : records.size(),
                    frames.count,
                    flow_records.size(),
                    flow_frames.count,
                    result,
                    std::move(provenance),
                    list_files(run.folder, keep_running),
                    ""};
  write_text(run.folder / kManifestFile, manifest_text(manifest));
  if (keep_running) return;

  // The run is complete: what cannot be removed is only in the way.
  std::error_code ignored;
  for (const char* running : kRunning) std::filesystem::remove_all(run.folder / running, ignored);
}

}  // namespace seapile::store
