// A basin as a row of its series, a frame, and the state that it can be continued from.
#pragma once

#include <vector>

#include "solver/basin/basin.h"
#include "solver/simulation/array.h"
#include "solver/simulation/flow_frame.h"
#include "solver/simulation/flow_record.h"

namespace seapile::simulation {

FlowRecord record_of(const basin::Basin& basin);
FlowFrame frame_of(const basin::Basin& basin);

/// Everything that the next step reads and that the spec does not say: the mesh as it is and as it was made, the
/// surface, the flow and its past, the matrix of the kept factor.
std::vector<Array> snapshot(const basin::Basin& basin);

/// The basin that a snapshot of the same spec was taken of. Throws std::invalid_argument when an array is missing or
/// does not fit.
basin::Basin restored(const basin::BasinSpec& spec, base::InstructionSet instructions, const std::vector<Array>& state);

}  // namespace seapile::simulation
