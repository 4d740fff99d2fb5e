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

/// The first difference bit for bit; empty: none.
std::string difference(const simulation::FlowFrame& a, const simulation::FlowFrame& b);

}  // namespace seapile::store::sample
