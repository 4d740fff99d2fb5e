// Where a trend passes a value.
#pragma once

#include <string>
#include <vector>

#include "runner/present/trend.h"

namespace seapile::present {

/// A place where one line of a trend passes the value: between two neighbouring cases, linear between them.
struct Crossing {
  std::string series;
  double x = 0;             ///< abscissa of the crossing
  double low = 0, high = 0;  ///< abscissae of the neighbours
};

/// All crossings, by series in the order of the trend and by rising abscissa. A case exactly at the value counts once.
std::vector<Crossing> crossings(const Trend& trend, double value);

/// One line per crossing, or one that says that there is none.
std::string crossing_text(const Trend& trend, double value);

}  // namespace seapile::present
