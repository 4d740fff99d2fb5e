// What a run seals while it runs: at each checkpoint the records and frames since the one before, and the state.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/store/stamp.h"
#include "solver/simulation/flow_frame.h"
#include "solver/simulation/flow_record.h"
#include "solver/simulation/frame.h"
#include "solver/simulation/record.h"

namespace seapile::store {

/// What a run hands out between two checkpoints.
struct Segment {
  std::vector<simulation::Record> records;
  std::vector<simulation::Frame> frames;
  std::vector<simulation::FlowRecord> flow_records;
  std::vector<simulation::FlowFrame> flow_frames;
  bool empty() const { return records.empty() && frames.empty() && flow_records.empty() && flow_frames.empty(); }
};

void write_segment(const std::filesystem::path& file, const Stamp& stamp, const Segment& segment);

/// Of Record or FlowRecord.
template <class R>
std::vector<R> segment_records(const std::filesystem::path& file, const Stamp& stamp);
std::size_t segment_frame_count(const std::filesystem::path& file, const Stamp& stamp);
simulation::Frame segment_frame(const std::filesystem::path& file, const Stamp& stamp, std::size_t index);
std::size_t segment_flow_frame_count(const std::filesystem::path& file, const Stamp& stamp);
simulation::FlowFrame segment_flow_frame(const std::filesystem::path& file, const Stamp& stamp, std::size_t index);

struct Checkpoint {
  std::int64_t generation = 0;        ///< 1 for the first of a run
  std::vector<std::string> segments;  ///< SHA-256 of the segments 1..generation, without which it is of no use
  std::vector<simulation::Array> state;
};

void write_checkpoint(const std::filesystem::path& file, const Stamp& stamp, const Checkpoint& checkpoint);
/// The state that a diverged run could not accept, and why (one sentence).
void write_post_mortem(const std::filesystem::path& file, const Stamp& stamp,
                       const std::vector<simulation::Array>& rejected, const std::string& reason);

Checkpoint read_checkpoint(const std::filesystem::path& file, const Stamp& stamp);

}  // namespace seapile::store
