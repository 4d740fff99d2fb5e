// How one number of a study goes with another, over packings: each case a point with its intervals, and the effect of
// an axis on the same beds.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runner/present/replicates.h"
#include "runner/present/statistics.h"
#include "runner/store/catalogue.h"

namespace seapile::present {

struct TrendQuestion {
  std::string of;       ///< metric, the ordinate
  std::string against;  ///< metric or parameter, the abscissa
  std::string effect;   ///< path of an axis whose effect is asked for; "": none
  double level = kLevel;
};

/// The columns that trend() needs of a query, in this order.
std::vector<std::string> trend_columns(const TrendQuestion& question);

/// The packings of one case.
struct TrendCase {
  std::vector<store::Cell> labels;                ///< one per label column
  std::string series;                             ///< what its line is called; cases of a line share it
  Interval x, y;                                  ///< of a parameter: x without an interval
  std::vector<std::pair<double, double>> runs;    ///< x and y of each packing
  std::optional<Interval> ratio;                  ///< y over the reference's, beds paired; absent for the reference
  std::vector<std::pair<double, double>> ratios;  ///< x and ratio of each pair
};

struct Trend {
  TrendQuestion question;
  std::string of_unit, against_unit;
  std::vector<std::string> label_columns, label_units;  ///< the seed apart
  std::vector<TrendCase> cases;                         ///< in the order of the study; those with a completed run
  std::string reference;                                ///< the axis' smallest value, "speed 0.06 m/s"; "": no effect
  std::size_t left_out = 0;                             ///< runs that are not completed or lack one of the numbers
  bool packings = false;                                ///< its runs stand on beds, so another packing is another number
  std::size_t unpaired = 0;                             ///< runs without one at the reference on the same bed
};

/// `each`: the query's answer with trend_columns(). The reference of an effect is the axis' smallest value (of names:
/// the first of the study); pairs agree in every other label and in the bed's case. Throws std::invalid_argument, a
/// sentence for the user: no number where one is needed, an effect that is no axis, nothing to pair.
Trend trend(const store::Table& each, const TrendQuestion& question);

/// Columns: labels, "n", abscissa and ordinate with their intervals, and for an effect "pairs" and "ratio".
Grouped trend_table(const Trend& trend);

/// What the table's numbers are, in whole lines.
std::string trend_remark(const Trend& trend, Format format);

}  // namespace seapile::present
