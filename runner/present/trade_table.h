// Variants with their errors and costs as a table.
#pragma once

#include <string>
#include <vector>

#include "runner/present/replicates.h"
#include "runner/present/trade.h"

namespace seapile::present {

/// Columns: labels, "variant", "runs" (completed) and "asked", "cpu" [s], "cost" (over the reference's), "memory"
/// [MB], "steps", and of each metric "error:METRIC" with its interval [%], "bound:METRIC" [%], "chance:METRIC" and
/// "frontier:METRIC" (1: nothing measured is cheaper and closer); "failure". For an ablation "change:METRIC" stands for
/// "error:METRIC".
Grouped trade_table(const std::vector<TradedGroup>& groups, bool ablation);

/// The same for people: what is not told from chance says so, in whole lines below, as do failures.
std::string trade_text(const std::vector<TradedGroup>& groups, bool ablation);

/// What the reference may be off by itself: its distance to the coarser variant, in one line.
std::string own_error(const std::vector<TradedGroup>& groups);

}  // namespace seapile::present
