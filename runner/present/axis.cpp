#include "runner/present/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seapile::present {

namespace {
constexpr double kHair = 1e-9;  ///< share of a step by which sums of steps may miss
}

double nice_step(double span, int most) {
  const double least = span / most;
  const double power = std::pow(10, std::floor(std::log10(least) + kHair));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1 - kHair)) return factor * power;
  }
  return 10 * power;
}

std::vector<Tick> ticks(double from, double to, double step) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + kHair)));
  std::vector<Tick> list;
  for (double k = std::ceil(from / step - kHair); k * step <= to + kHair * step; ++k) {
    list.push_back({k * step, fmt::format("{:.{}f}", k == 0 ? 0.0 : k * step, decimals)});
  }
  return list;
}

}  // namespace seapile::present
