// Time counted in steps, whole or halved, so that no rounding accumulates.
#pragma once

#include <cmath>
#include <cstdint>

namespace seapile::base {

/// A step may be halved so often, and no oftener.
inline constexpr int kMostHalvings = 8;
/// Ticks in a whole step: the smallest step is one tick.
inline constexpr int kTicks = 1 << kMostHalvings;

/// Of a run whose steps are whole, time() and size() have the bits of step * dt and dt.
struct Clock {
  std::int64_t step = 0;  ///< whole steps done
  double dt = 0;          ///< of a whole step [s]
  int part = 0;           ///< ticks done since, below kTicks
  int halvings = 0;       ///< of the present step: it is dt/2^halvings

  /// [s]
  double time() const { return (static_cast<double>(step) + static_cast<double>(part) / kTicks) * dt; }
  /// Of the present step [s].
  double size() const { return std::ldexp(dt, -halvings); }
  std::int64_t ticks() const { return step * kTicks + part; }
  /// Ticks in the present step.
  int stride() const { return kTicks >> halvings; }
  void advance() {
    part += stride();
    if (part < kTicks) return;
    part = 0;
    ++step;
  }
  /// Whether `count` steps that have been halved so often end on one another's ends here.
  bool begins(int count, int halved) const {
    return ticks() % (static_cast<std::int64_t>(count) * (kTicks >> halved)) == 0;
  }
};

}  // namespace seapile::base
