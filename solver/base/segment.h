#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/vec2.h"

namespace seapile::base {

/// A directed stretch of a body's outline; the body lies to its left.
struct Segment {
  Vec2 from, to;             ///< [m]
  std::int32_t feature = 0;  ///< what it belongs to, as the body's owner numbers it
};

}  // namespace seapile::base
