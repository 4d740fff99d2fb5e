// Two runs beside each other: what was asked, how it was done, what came out, and what explains the difference.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/present/curve_distance.h"
#include "runner/present/table.h"
#include "runner/store/run_folder.h"

namespace seapile::present {

/// A run that has ended, where it lies.
struct FinishedRun {
  std::filesystem::path folder;
  store::Manifest manifest;
};

/// A named thing that is not the same in both runs.
struct Difference {
  std::string name;
  std::string a, b;  ///< "" where a run has nothing of that name
  std::string unit;  ///< "" where there is none
};

struct MetricDistance {
  std::string name, unit;
  double a, b;      ///< NaN where a run lacks it
  double relative;  ///< |b - a| over the larger of both; 0 where both are the same or rounding, NaN where one is none
};

/// One column of the series over depth, travel or time.
struct SeriesDistance {
  std::string column, unit, over, over_unit;
  CurveDistance distance;
};

enum class Likeness {
  identical,  ///< the final state to the last bit, and every metric
  rounding,   ///< every metric and curve within kRounding
  different,
};

/// Relative distance up to which two numbers are the same but for rounding.
inline constexpr double kRounding = 1e-9;

struct RunComparison {
  std::string case_a, run_a, case_b, run_b;
  std::string state_a, state_b;           ///< bits of the final states (store/final_state.h)
  std::vector<Difference> parameters;     ///< what was asked, the record included
  std::vector<Difference> numerics;       ///< versions
  std::vector<Difference> code;           ///< version, commit, changes, compiler, flags, libraries
  std::vector<Difference> environment;    ///< processor, threads, instructions
  std::vector<MetricDistance> metrics;    ///< of both, in the order of A's
  std::vector<SeriesDistance> curves;     ///< of the columns that both have
  std::vector<std::string> differ_alone;  ///< sentences: kind, outcome, another run of the bed
  double largest = 0;                     ///< relative distance of the metrics and curves that both have
  std::string largest_of;                 ///< the metric or column
  std::size_t unshared = 0;               ///< metrics that only one of them has as a number
  std::vector<std::string> uncompared;    ///< columns that only one of them has, or that have no distance
  Likeness likeness = Likeness::different;
};

/// Reads the series of both. Throws store::StoreError.
RunComparison compare(const FinishedRun& a, const FinishedRun& b);

/// Whether both are packings of one scene: nothing that was asked differs but the seed.
bool are_packings(const RunComparison& comparison);

/// Why two runs cannot be taken for equal within a tolerance (0: to the last bit), in a clause; empty when they can.
/// What one of them lacks makes them unequal, and so does that there is nothing to compare.
std::string inequality(const RunComparison& comparison, double tolerance);

/// "other parameters (pile.tip), other numerics (grains 3 -> 4)"; "nothing known" when all that is known is the same.
std::string explanation(const RunComparison& comparison);

/// One line: how alike they are, by how much they differ, and what explains it.
std::string verdict(const RunComparison& comparison);

/// Every difference and every metric and curve in a row: "section", "name", "a", "b", "unit", "difference" (relative),
/// "largest" and where it is ("at"). The last row is the verdict.
store::Table comparison_table(const RunComparison& comparison);

/// The same for people, section by section; ends with the verdict.
std::string comparison_text(const RunComparison& comparison);

}  // namespace seapile::present
