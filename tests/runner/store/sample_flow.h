// A flow as the solver could have made it, from exact arithmetic only, as sample_run.h has a bed and a drive.
#pragma once

#include "tests/runner/store/sample_run.h"

namespace seapile::store::sample {

inline constexpr std::size_t kFlowFrames = 3;

RunHeader flow_header();
simulation::RunResult flow_result();

/// Another mesh in each frame, and no free surface in every third from the second on.
simulation::FlowFrame flow_frame(std::size_t index);

/// Writes a flow with three frames and no record below a store's root, with a checkpoint after the second frame.
/// Returns the run's folder.
std::filesystem::path write_flow(const std::filesystem::path& root);

/// A basin without a pile: columns that are absent from every record, and from some the height in the middle.
RunHeader basin_header();
simulation::FlowRecord flow_record(std::size_t index);
/// Of a saturated bed: no column is absent.
simulation::FlowRecord saturated_record(std::size_t index);
std::vector<simulation::FlowRecord> flow_records(std::size_t first, std::size_t count);

/// The first difference bit for bit; empty: none.
std::string difference(const std::vector<simulation::FlowRecord>& a, const std::vector<simulation::FlowRecord>& b);
std::string difference(const simulation::FlowFrame& a, const simulation::FlowFrame& b);

}  // namespace seapile::store::sample
