// The water of a saturated simulation as the state that it can be continued from.
#pragma once

#include <vector>

#include "solver/simulation/array.h"
#include "solver/simulation/water.h"

namespace seapile::simulation {

/// Everything that the next step reads and that the scene does not say; every name begins with "water/".
std::vector<Array> snapshot(const Water& water);

/// Whether an array of a state is the water's.
bool is_of_water(const Array& array);

/// Puts a snapshot back into the water of the same scene. Throws std::invalid_argument when an array is missing or does
/// not fit; the water is then unchanged.
void restore(Water& water, const std::vector<Array>& state);

}  // namespace seapile::simulation
