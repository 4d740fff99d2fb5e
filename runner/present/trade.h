// What ways to compute the same scene cost, and how far they are from one of them.
//
// Of a metric x with packings s: the relative difference of each packing, d_s = (x_s - r_s) / mean(r), with Student's t
// on it; pairs stand on the same bed where bed and seed are the same, and what packings have in common cancels. Of a
// curve, bins b: the error E = |mean_s d_s| / |mean_s r_s| in the Euclidean norm over bins. Whether E is more than the
// packings' chance is tested by the signs: under "no difference" each packing's d_s is as likely as -d_s, so of all 2^n
// choices of signs the share whose E is at least as large is the probability of what was seen. Exact, without a
// distribution assumed.
//
// Water has no packings: the difference of two runs is the error, and its bound adds what separates the reference from
// a coarser variant, as far as that is known.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runner/present/statistics.h"
#include "runner/present/table.h"

namespace seapile::present {

/// One run of a variant.
struct VariantRun {
  std::string packing;                     ///< what pairs it with the run of the other variant
  std::vector<std::vector<double>> value;  ///< by metric: its number, or those of a curve; empty: it has none
  std::string failure;                     ///< why there is no result; "": there is one
  double cpu_seconds = 0, peak_memory_mb = 0, steps = 0;
};

struct TradedVariant {
  std::string name;
  std::vector<VariantRun> runs;
};

/// Variants that are compared with one of them.
struct TradedGroup {
  Labels labels;                     ///< of the axes beside
  std::vector<std::string> metrics;  ///< as asked for: "a*" is a curve
  std::string against;               ///< name of the variant; "": the metrics are errors already
  std::vector<TradedVariant> variants;
  /// Name of the variant whose distance from `against` is that one's own error at most; "": nothing is known of it.
  std::string coarser = {};
  bool by_chance = true;  ///< runs scatter as packings do; otherwise one run of a variant is its answer
};

/// How far a variant is in one metric.
struct TradeError {
  std::size_t n = 0;  ///< pairs
  /// Relative difference, signed, with its 95 % interval; of a curve its norm, and an interval from what chance adds:
  /// [max(0, E - q), E + q], q the 95 % quantile of the norm that the scatter of the pairs gives.
  Interval error;
  /// 95 % bound of its size: the larger end of the interval; NaN without an interval, but where there is no chance.
  double bound = std::numeric_limits<double>::quiet_NaN();
  double chance = std::numeric_limits<double>::quiet_NaN();  ///< of as much without any difference [-]
};

struct TradeLevel {
  std::string name;
  std::size_t completed = 0, asked = 0;  ///< runs
  double cpu_seconds = 0;                ///< median over its runs; NaN: none is completed
  double cost = 0;                       ///< median of the pairs' CPU time over the reference's [-]
  double peak_memory_mb = 0, steps = 0;  ///< largest; median
  std::vector<TradeError> errors;        ///< by metric
  std::vector<std::string> failures;     ///< each kind once
  std::vector<bool> on_frontier;         ///< by metric: nothing measured is cheaper and has a smaller bound
};

/// Judges all variants of a group, in their order; that with which they are compared has no errors.
std::vector<TradeLevel> judge(const TradedGroup& group);

/// Share of the 2^n choices of signs of `pairs` for which the norm of the mean is at least that of the pairs as they
/// are; pairs x bins. Beyond 20 pairs NaN.
double sign_flip_chance(const std::vector<std::vector<double>>& pairs);

}  // namespace seapile::present
