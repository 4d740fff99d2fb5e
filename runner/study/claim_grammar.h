// One entry of a study's "checks" that is a claim, taken apart.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runner/study/assignment.h"
#include "runner/study/claim.h"

namespace seapile::study {

struct ClaimText {
  PlacePtr place;
  Claim claim;  ///< without its rows
  std::optional<Match> of, over;
  std::optional<Match> which;  ///< limits the cases of both
};

/// Whether an entry is meant as a claim: it says something that only claims have.
bool is_claim(const Value& entry);

/// The entries that are claims and free of problems.
std::vector<ClaimText> read_claims(const std::vector<Value>& list, base::Problems& problems);

}  // namespace seapile::study
