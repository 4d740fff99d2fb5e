#pragma once

#include "solver/simulation/flow_frame.h"
#include "solver/simulation/frame.h"

namespace seapile::store {

/// Throws std::logic_error when a frame is not what frame.h promises: its arrays' names and their rows.
void require_well_formed(const simulation::Frame& frame);

/// Throws std::logic_error when a frame is not what flow_frame.h promises: its arrays' names and their rows, one
/// triangle at least, and rows of vertices that there are.
void require_well_formed(const simulation::FlowFrame& frame);

}  // namespace seapile::store
