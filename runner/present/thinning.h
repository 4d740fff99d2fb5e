#pragma once

#include <cstddef>
#include <vector>

namespace seapile::present {

/// Which points of a line to draw, by rising index: all of them, or of every stretch the lowest and the highest, so
/// that no peak is lost and about three points are left for each pixel of a picture.
std::vector<std::size_t> thinned(const std::vector<double>& values);

inline constexpr std::size_t kMostPoints = 2400;

}  // namespace seapile::present
