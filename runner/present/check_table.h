// Comparisons as tables: for people one of published values, one of bounds and one of drift, for programs one of all.
#pragma once

#include <string>
#include <vector>

#include "runner/present/comparison.h"
#include "runner/present/table.h"

namespace seapile::present {

/// Every comparison in a row. Columns: "against" ("published", "bounds" or "accepted"), "metric", "case" (of one
/// packing), the labels, "n", "value", "low", "high", "unit", "reference", "difference", "tolerance", "at_least",
/// "at_most", "verdict", "source", "reason"; numbers in the row's own unit.
store::Table check_table(const std::vector<Comparison>& comparisons);

/// The tables for people, digits as the tolerances ask, and below the first the sources of published values.
std::string check_text(const std::vector<Comparison>& comparisons);

/// What there is to say beside the tables, in whole lines: each failure, and how far the numbers carry.
/// `packings`: there are grains, so another packing is another number.
std::string check_remark(const std::vector<Comparison>& comparisons, bool packings);

}  // namespace seapile::present
