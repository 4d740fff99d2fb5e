// What the store holds of a study's claims.
#pragma once

#include <vector>

#include "runner/commands/checked.h"
#include "runner/present/claim.h"

namespace seapile::commands {

/// A row for each case or pair of cases of each claim. Throws study::BadInput when a bound is in units of something
/// else.
std::vector<present::Claimed> claimed(const study::Study& study, const CheckedCases& cases);

}  // namespace seapile::commands
