#include "runner/present/thinning.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace seapile::present {
namespace {

constexpr std::size_t kEnds = 2, kOfStretch = 5;  // points of a path

std::vector<std::size_t> all_of(std::size_t count) {
  std::vector<std::size_t> kept(count);
  std::iota(kept.begin(), kept.end(), std::size_t{0});
  return kept;
}

}  // namespace

std::vector<std::size_t> thinned(const std::vector<double>& values) {
  const std::size_t count = values.size();
  if (count <= kMostPoints) return all_of(count);
  std::vector<std::size_t> kept;
  const std::size_t stretch = (2 * count + kMostPoints - 1) / kMostPoints;
  for (std::size_t first = 0; first < count; first += stretch) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = values.begin() + static_cast<std::ptrdiff_t>(std::min(count, first + stretch));
    auto [low, high] = std::minmax_element(begin, end);
    if (high < low) std::swap(low, high);
    for (const auto value : {low, high}) kept.push_back(static_cast<std::size_t>(value - values.begin()));
  }
  return kept;
}

std::vector<std::size_t> thinned_path(const std::vector<double>& x, const std::vector<double>& y, std::size_t most) {
  const std::size_t count = x.size();
  if (count <= most) return all_of(count);
  const std::size_t stretches = (most - kEnds) / kOfStretch;
  std::vector<std::size_t> kept = {0, count - 1};
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t first = s * count / stretches, last = (s + 1) * count / stretches;
    std::vector<std::size_t> there;
    bool gap = false;
    for (std::size_t i = first; i < last; ++i) {
      if (std::isfinite(x[i]) && std::isfinite(y[i])) {
        there.push_back(i);
      } else if (!std::exchange(gap, true)) {
        kept.push_back(i);
      }
    }
    if (there.empty()) continue;
    for (const auto* values : {&x, &y}) {
      const auto by_value = [values](std::size_t i) { return (*values)[i]; };
      const auto [low, high] = std::ranges::minmax_element(there, {}, by_value);
      kept.insert(kept.end(), {*low, *high});
    }
  }
  std::ranges::sort(kept);
  kept.erase(std::ranges::unique(kept).begin(), kept.end());
  return kept;
}

}  // namespace seapile::present
