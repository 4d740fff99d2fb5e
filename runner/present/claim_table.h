// Claims with their verdicts as tables.
#pragma once

#include <string>
#include <vector>

#include "runner/present/claim.h"
#include "runner/present/table.h"

namespace seapile::present {

/// A table of checks with the claims below: "against" is "claim", "value" the estimate, "reason" the text; columns of
/// their own are "number", "cases" (in which both sides agree), "of", "over", "as", "margin", "needed" and "expect".
/// The same table where there are no claims.
store::Table with_claims(store::Table checks, const std::vector<Claimed>& claims);

/// A row for people of each case or pair of cases of each claim.
store::Table shown_claims(const std::vector<Claimed>& claims);

/// What each claim says, and of which metric: "claim 12: the flat tip meets more (ratio of tip_resistance_mean)".
std::vector<std::string> claim_sentences(const std::vector<Claimed>& claims);

/// The table for people, and below it what each claim says; "" without claims.
std::string claim_text(const std::vector<Claimed>& claims);

/// What there is to say beside the table, in whole lines: verdicts that were not expected, what an underpowered claim
/// takes, what is missing, and what the verdicts rest on.
std::string claim_remark(const std::vector<Claimed>& claims);

}  // namespace seapile::present
