// What the water does to the pile.
//
//   F = -(what the momentum equations of the water on the pile lack) + integral of (1 - phi) p n
//
// The first term is the traction on the water's share of the face, exact for the scheme (fluid/residual.h). The grains
// hand the pressure's force on their own share on to the pile (docs/formulation.md 5), so that the pore pressure acts
// on the whole face, as a piezocone measures it.
#pragma once

#include <array>
#include <optional>

#include "solver/basin/basin.h"

namespace seapile::basin {

/// Sets the forces of the water on tip and sleeve; the step has just been solved with `scheme`.
void feel_pile(Basin& basin, const fluid::TimeScheme& scheme);

/// Pressures at the pile without the hydrostatic one, where a piezocone measures them [Pa].
struct PorePressure {
  double face = 0;      ///< u1: mean over the tip's face
  double shoulder = 0;  ///< u2: behind the tip, mean of both sides
  std::optional<double>
      sleeve;  ///< u3: on the sleeve, a pile's width above the shoulder; absent: that is out of the water
};
PorePressure pore_pressure(const Basin& basin);

}  // namespace seapile::basin
