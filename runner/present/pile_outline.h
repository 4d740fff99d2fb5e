#pragma once

#include <vector>

#include "solver/base/vec2.h"
#include "solver/pile/pile.h"

namespace seapile::present {

/// From the left sleeve's top over the tip to the right one's, with the tip's lowest point at the height `apex` and the
/// tops above `top` [m].
std::vector<base::Vec2> pile_outline(const pile::PileSpec& pile, double apex, double top);

}  // namespace seapile::present
