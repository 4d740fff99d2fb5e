// Frequency and decay of an oscillation from a computed series.
//
//   a(t) = exp(-d t)(A cos w t + B sin w t) + c
//
// by least squares: w and d from a table, with the best A, B and c of each; then all five by Levenberg-Marquardt. All
// samples weigh the same: what a solver adds (its tolerance, the last digits) does not decay with the wave, and weights
// that grow like exp(d t) would listen to it. c takes up what a drift of the mean would make of d.
//
// A wave from rest is no pure mode: the layers at its bottom and surface have to grow first. The fit of the exact
// curve, small_wave.h's amplitude(), over the time of window_of() has the mode's frequency to 0.1 % and its decay to
// 0.3 % up to 7 e-foldings in ten periods, and where kH <= 1.6 up to 20, whether the bottom is slip or not (begun half
// a period after the start: up to 5.7; at the start: up to 3). In deep water that damps more, the part of the curve
// that falls like a power of time is seen, and up to 1.7 % of the decay differs: compare the fits of two curves there.
#pragma once

#include <optional>
#include <span>
#include <utility>

#include "solver/basin/small_wave.h"

namespace seapile::basin {

/// Fewest periods that tell a frequency and a decay apart from a mean.
inline constexpr double kFewestPeriods = 1.5;

/// Fits samples that are spread evenly, or nearly so, at least 3 a period, over at most 20 periods. Absent when there
/// are fewer than 8 samples or fewer periods than kFewestPeriods, or when nothing moves.
std::optional<Mode> fitted(std::span<const double> time, std::span<const double> amplitude);

/// Begin and end [s] of the time over which a wave from rest is compared with its mode: from the end of the first
/// period, ten periods or two e-foldings, whichever is shorter, but at least two periods.
std::pair<double, double> window_of(const Mode& mode);

}  // namespace seapile::basin
