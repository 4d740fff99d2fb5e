#pragma once

#include <optional>

#include "solver/base/problem.h"
#include "solver/scene/checks.h"
#include "solver/scene/spec.h"

namespace seapile::scene {

/// The way of a pile into its bed.
struct WayIntoBed {
  double surface;   ///< mean height of the bed [m]
  double start;     ///< height of the tip's lowest point at the start, bounded from above [m]
  double up;        ///< highest displacement above the start [m]
  double deepest;   ///< depth below the bed's surface that the tip does not pass [m]
  double duration;  ///< of the run [s]; infinite when it never ends
};

/// As validate() (solver/scene/validate.h) has it of the fluid of a saturated scene. `way`: absent where it is not
/// known; what depends on it is then not checked.
base::Problems validate_fluid(const SceneSpec& scene, const std::optional<WayIntoBed>& way);

}  // namespace seapile::scene
