// What a level of fidelity fills in where the study says nothing.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runner/study/assignment.h"

namespace seapile::study {

/// "thesis", "draft", "standard", "reference".
std::vector<std::string> fidelity_names();

/// For scenes of every kind; of a scene of water alone only what begins with its own part has a place.
std::vector<Assignment> filled_by_fidelity(std::size_t level, const PlacePtr& place);

}  // namespace seapile::study
