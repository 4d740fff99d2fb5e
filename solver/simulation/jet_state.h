// A jet as named arrays: the frame that is kept of it, and the state that it can be continued from.
#pragma once

#include <vector>

#include "solver/fluid/jet_in_time.h"
#include "solver/simulation/array.h"
#include "solver/simulation/flow_frame.h"
#include "solver/simulation/flow_state.h"

namespace seapile::simulation {

FlowFrame frame_of(const fluid::Jet& jet, double time);

/// Everything that the next step reads and that the spec does not say; the matrix of the kept factor with it.
std::vector<Array> snapshot(const fluid::JetInTime& run);

/// Puts a snapshot of the same jet back. Throws std::invalid_argument when an array is missing or does not fit.
void restore(fluid::JetInTime& run, const std::vector<Array>& state);

}  // namespace seapile::simulation
