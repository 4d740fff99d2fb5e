// Packings of the same case put together: one row for each case instead of one for each run.
#pragma once

#include <string>
#include <vector>

#include "runner/present/statistics.h"
#include "runner/present/table.h"
#include "runner/store/catalogue.h"

namespace seapile::present {

/// The label that packings of the same case differ in.
inline constexpr const char* kSeed = "bed.seed";

/// What becomes of a column when packings are put together.
enum class Role {
  key,      ///< runs that agree in all of these are packings of the same case
  outcome,  ///< runs that are not "completed" are left out
  mean,     ///< becomes three columns: "x.mean", "x.low", "x.high"
  total,    ///< summed over the packings
  common,   ///< kept where all packings agree
  dropped,
};

struct Grouped {
  store::Table table;               ///< keys, "n", then the other columns in their order; a row per case
  std::vector<std::size_t> means;   ///< columns of means, as text() takes them
  std::size_t least = 0, most = 0;  ///< packings of a case, cases without any apart
  std::size_t left_out = 0;         ///< runs that are not completed
  double level = kLevel;
};

/// One row for each case, in the order of first occurrence. `roles`: one per column of `each`. A mean is over all n
/// packings; where one of them lacks the number, it is absent. With n = 1 the mean is the value and has no interval.
Grouped group(const store::Table& each, const std::vector<Role>& roles, double level = kLevel);

/// Whether a query's answer has packings of the same case, or one of each that says which: a label bed.seed.
bool has_replicates(const store::Table& each);

/// A query's answer with its packings put together. Labels that are numbers become numbers.
Grouped group_query(store::Table each, double level = kLevel);

/// How far the numbers carry: what the table's ± is, that there is no interval, what was left out. Whole lines.
std::string remark(const Grouped& grouped, Format format);

/// What a table of one packing ends with.
inline constexpr const char* kOnePacking =
    "one packing: no interval. Another packing of the same preparation moves the mean by a few per cent; "
    "`--seeds N` repeats every case on N packings.";

/// "reynolds 24, tip flat": what a case is called in a legend; what makes packings of it differ is left out.
std::string legend_text(const Labels& labels);

}  // namespace seapile::present
