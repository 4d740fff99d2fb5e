// What a valid scene is too small for: it is run all the same, and its answer may be that of its boundary.
#pragma once

#include <string>
#include <vector>

#include "solver/scene/spec.h"

namespace seapile::scene {

/// From the pile's axis to a side wall, in radii of the pile: nearer than this a wall may change the resistance. It is
/// the thesis' distance; at 14 and 28 radii nothing was seen beyond a tenth (docs/saturated.md, "The box").
inline constexpr double kNearWall = 20;

/// One sentence each, beginning with its name.
std::vector<std::string> warnings(const SceneSpec& scene);

}  // namespace seapile::scene
