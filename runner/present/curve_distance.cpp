#include "runner/present/curve_distance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <stdexcept>

namespace seapile::present {
namespace {

/// The curve's value at an abscissa that it covers.
double value_at(const Polyline& curve, double x) {
  const auto right = std::ranges::lower_bound(curve.x, x);
  const auto i = static_cast<std::size_t>(right - curve.x.begin());
  if (*right == x) return curve.y[i];  // no rounding at the points themselves
  const double share = (x - curve.x[i - 1]) / (curve.x[i] - curve.x[i - 1]);
  return curve.y[i - 1] + share * (curve.y[i] - curve.y[i - 1]);
}

/// Integral of the square of a function that is straight between the points.
double square_integral(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t i = 1; i < x.size(); ++i)
    sum += (x[i] - x[i - 1]) * (y[i - 1] * y[i - 1] + y[i - 1] * y[i] + y[i] * y[i]) / 3;
  return sum;
}

}  // namespace

bool rises(const std::vector<double>& values) {
  return std::ranges::adjacent_find(values, std::greater_equal<>{}) == values.end();
}

std::optional<CurveDistance> distance(const Polyline& a, const Polyline& b) {
  if (!rises(a.x) || !rises(b.x)) throw std::invalid_argument("a curve goes back");
  if (a.x.empty() || b.x.empty()) return std::nullopt;
  CurveDistance result;
  result.from = std::max(a.x.front(), b.x.front());
  result.to = std::min(a.x.back(), b.x.back());
  if (!(result.from < result.to)) return std::nullopt;

  std::vector<double> x;
  std::ranges::set_union(a.x, b.x, std::back_inserter(x));
  std::erase_if(x, [&](double one) { return one < result.from || one > result.to; });
  std::vector<double> of_a, of_b, between;
  result.at = result.from;
  for (const double one : x) {
    of_a.push_back(value_at(a, one));
    of_b.push_back(value_at(b, one));
    between.push_back(of_b.back() - of_a.back());
    if (!std::isfinite(between.back())) return std::nullopt;
    if (std::abs(between.back()) > result.largest) {
      result.largest = std::abs(between.back());
      result.at = one;
    }
  }
  const double norm = std::sqrt(std::max(square_integral(x, of_a), square_integral(x, of_b)));
  if (norm > 0) result.relative = std::sqrt(square_integral(x, between)) / norm;
  return result;
}

}  // namespace seapile::present
