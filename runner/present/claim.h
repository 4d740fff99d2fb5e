// A claim of a study beside what its packings say: a number on one side of a bound, or one case over another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runner/present/statistics.h"
#include "runner/present/table.h"

namespace seapile::present {

/// Which number of a pair is compared with the bound.
enum class Compared { value, ratio, difference };

/// "value", "ratio", "difference".
std::string words(Compared compared);

/// One row of a claim: a case, or two, over packings.
struct Claimed {
  std::size_t place = 1;  ///< of the claim among those of its study, from 1
  std::optional<std::int64_t> number;
  std::string text;
  std::string metric, unit;  ///< unit of estimate, bound and margin: "-" for a ratio
  Compared compared = Compared::value;
  Side side = Side::above;
  double bound = 0;
  double margin = 0;           ///< of a ratio relative: 0.05 is a factor of 1.05 to either side
  bool deterministic = false;  ///< one packing; its value decides
  std::string expect;          ///< words of a verdict; "": any is fine
  Labels common, of, over;     ///< in which both sides agree, and what sets them apart
  /// Of each packing the metric of one side and of the other (absent: there is none), as far as they are finished.
  std::vector<std::pair<std::optional<double>, std::optional<double>>> packings;
};

struct ClaimVerdict {
  std::optional<Decision> decision;  ///< absent: results are missing
  /// Mean, geometric mean of the ratios, or mean of the differences over the packings with both numbers, and the
  /// two-sided interval.
  Interval estimate;
  std::optional<std::size_t> needed;  ///< of an underpowered one: packings that decide with the chance kPower
  std::string trouble;                ///< of a missing one: which number is not there
};

/// Missing where a packing lacks a number, where a number is none, and where a ratio has no positive numbers; else
/// test_bound() on the numbers, or for a ratio on their logarithms. Where the value decides, what lies on the bound is
/// confirmed.
ClaimVerdict judge(const Claimed& claim);

/// "confirmed", "refuted", "not distinguishable", "underpowered", "missing".
std::string words(const ClaimVerdict& verdict);

enum class Standing {
  fine,       ///< as expected, or a finding where nothing was expected
  contrary,   ///< decided, and not as expected
  undecided,  ///< results are missing, or too few for what was expected
};
Standing standing(const Claimed& claim, const ClaimVerdict& verdict);

}  // namespace seapile::present
