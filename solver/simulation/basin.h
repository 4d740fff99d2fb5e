// A basin of water, from its spec to its result: the scene that holds a fluid, its surface and a pile, and no grains.
#pragma once

#include <functional>
#include <vector>

#include "solver/basin/basin_spec.h"
#include "solver/scene/spec.h"
#include "solver/simulation/array.h"
#include "solver/simulation/execution.h"
#include "solver/simulation/flow_frame.h"
#include "solver/simulation/flow_record.h"
#include "solver/simulation/run.h"

namespace seapile::simulation {

/// What a basin's run hands out while it runs, and what it is asked: as RunHooks.
struct BasinHooks {
  std::function<void(const FlowRecord&)> record;
  std::function<void(const FlowFrame&)> frame;
  std::function<void(const Progress&)> progress;
  std::function<bool()> checkpoint_due;
  std::function<void(const std::vector<Array>&)> checkpoint;
  std::function<bool()> stop;
  std::function<void(const std::vector<Array>& rejected, const std::string& reason)> post_mortem;
};

/// Runs a basin. `record` says at which times (`interval`, `times`) records and frames are handed out; the first record
/// and frame are the start, the last the end. `resume_from`: a checkpoint's state, or empty. Records and frames handed
/// out after a resume are those after the checkpoint, bit for bit; `records_so_far` are the records before it (the
/// metrics need them). A run that cannot go on is `diverged`: it hands out its last good state as a frame, and as a
/// checkpoint.
RunResult run_basin(const basin::BasinSpec& basin, const scene::RecordSpec& record, const Execution& execution,
                    const std::vector<Array>& resume_from, const std::vector<FlowRecord>& records_so_far,
                    const BasinHooks& hooks);

}  // namespace seapile::simulation
