// Which program made a result: what a repetition has to agree in, and what a comparison tells.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "runner/store/run_folder.h"

namespace seapile::store {

/// Name and value of version, commit, uncommitted changes ("dirty": "yes" or "no"), compiler, flags, build type and
/// libraries.
std::vector<std::pair<std::string, std::string>> build_values(const Provenance& made);

}  // namespace seapile::store
