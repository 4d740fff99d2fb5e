// Checks and claims as JUnit XML, which continuous integration reads.
#pragma once

#include <string>
#include <vector>

#include "runner/present/claim.h"
#include "runner/present/comparison.h"

namespace seapile::present {

/// One test suite, named after the study, with a test case for each comparison and each row of a claim: failed where
/// the check failed or the claim came out otherwise than expected, skipped where results are missing, too few or not
/// accepted yet. A character that XML cannot hold stands as U+FFFD.
std::string junit_text(const std::string& study, const std::vector<Comparison>& comparisons,
                       const std::vector<Claimed>& claims);

}  // namespace seapile::present
