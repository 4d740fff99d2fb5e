// A jet from a die, from its spec to its result: the scene that holds a fluid and its free surface, and nothing else.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/fluid/jet_spec.h"
#include "solver/simulation/array.h"
#include "solver/simulation/execution.h"
#include "solver/simulation/flow_frame.h"
#include "solver/simulation/run.h"

namespace seapile::simulation {

/// What a jet's run hands out while it runs, and what it is asked.
struct JetHooks {
  std::function<void(const FlowFrame&)> frame;  ///< the jet at its end
  std::function<void(const Progress&)> progress;
  std::function<bool()> checkpoint_due;
  std::function<void(const std::vector<Array>&)> checkpoint;
  std::function<bool()> stop;
  std::function<void(const std::vector<Array>& rejected, const std::string& reason)> post_mortem;
};

/// Runs a jet. `resume_from`: a checkpoint's state, or empty. A steady jet has no checkpoints. One in time that cannot
/// go on is `diverged`: it hands out its last good state as a checkpoint, then the rejected one.
RunResult run_jet(const fluid::JetSpec& jet, const Execution& execution, const std::vector<Array>& resume_from,
                  const JetHooks& hooks);

}  // namespace seapile::simulation
