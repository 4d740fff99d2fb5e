#pragma once

#include <cstddef>
#include <vector>

namespace seapile::present {

/// Which points of a line to draw, by rising index: all of them, or of every stretch the lowest and the highest, so
/// that no peak is lost and about three points are left for each pixel of a picture.
std::vector<std::size_t> thinned(const std::vector<double>& values);

inline constexpr std::size_t kMostPoints = 2400;

/// The same of a path that may turn back in both directions, as q_c over the depth of a pile that moves up and down:
/// its two ends, and of every stretch the lowest and the highest of x and of y and the first point where one of them is
/// no number, so that a gap stays one. At most `most` >= 7 points.
std::vector<std::size_t> thinned_path(const std::vector<double>& x, const std::vector<double>& y, std::size_t most);

}  // namespace seapile::present
