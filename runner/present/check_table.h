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

/// Those of one kind, in their order.
std::vector<Comparison> of_kind(const std::vector<Comparison>& comparisons, Against against);

/// Every source once, in the order of first occurrence: the numbers in the column "source" of shown_checks().
std::vector<std::string> sources_of(const std::vector<Comparison>& comparisons);

/// A row for people of each comparison, all of one kind, digits as their tolerances ask.
store::Table shown_checks(const std::vector<Comparison>& comparisons, Against against);

/// The tables for people, digits as the tolerances ask, and below the first the sources of published values.
std::string check_text(const std::vector<Comparison>& comparisons);

/// What there is to say beside the tables, in whole lines: each failure, and how far the numbers carry.
/// `packings`: there are grains, so another packing is another number.
std::string check_remark(const std::vector<Comparison>& comparisons, bool packings);

}  // namespace seapile::present
