// How far two curves are from each other over what both cover.
#pragma once

#include <optional>
#include <vector>

namespace seapile::present {

/// Points joined by straight lines, by rising abscissa.
struct Polyline {
  std::vector<double> x, y;
};

struct CurveDistance {
  double from = 0, to = 0;  ///< the abscissae that both curves cover
  double relative = 0;      ///< L2 norm of the difference over the larger of the two norms [-]; 0: no difference
  double largest = 0;       ///< largest |b - a|, in the ordinate's unit
  double at = 0;            ///< where that is
};

/// Distance of the curves over their common abscissae, by the trapezoidal rule on the points of both. Absent when they
/// have no stretch in common, or a value there that is no number. Throws std::invalid_argument where an abscissa does
/// not rise.
std::optional<CurveDistance> distance(const Polyline& a, const Polyline& b);

/// Whether every value is larger than the one before.
bool rises(const std::vector<double>& values);

}  // namespace seapile::present
