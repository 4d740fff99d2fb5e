#pragma once

#include <span>
#include <vector>

#include "solver/simulation/flow_record.h"
#include "solver/simulation/record.h"
#include "solver/simulation/run.h"
#include "solver/simulation/water.h"

namespace seapile::simulation {

/// What the water of a drive is known by, from the records of both phases (as many of one as of the other) and its end.
std::vector<Metric> water_metrics(std::span<const Record> records, std::span<const FlowRecord> flow_records,
                                  const Water& water);

/// The balance of the grains' energy over the records, as a share of the pile's work: what `flow_records`, empty when
/// the scene is dry, say that the fluid has done is in it [-].
double energy_error(std::span<const Record> records, std::span<const FlowRecord> flow_records);

}  // namespace seapile::simulation
