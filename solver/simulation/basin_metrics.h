#pragma once

#include <vector>

#include "solver/basin/basin.h"
#include "solver/simulation/flow_record.h"
#include "solver/simulation/run.h"

namespace seapile::simulation {

/// What a basin's run is known by, from its records and its end.
std::vector<Metric> metrics_of(const basin::Basin& basin, const std::vector<FlowRecord>& records);

}  // namespace seapile::simulation
