#include "runner/present/thinning.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace seapile::present {

std::vector<std::size_t> thinned(const std::vector<double>& values) {
  const std::size_t count = values.size();
  std::vector<std::size_t> kept;
  if (count <= kMostPoints) {
    kept.resize(count);
    std::iota(kept.begin(), kept.end(), std::size_t{0});
    return kept;
  }
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

}  // namespace seapile::present
