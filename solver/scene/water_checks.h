// What the checks of basins and of saturated beds share. `pointer`: of the part that is checked, "/basin/surface".
#pragma once

#include <string>

#include "solver/base/problem.h"
#include "solver/basin/basin_spec.h"
#include "solver/pile/pile_spec.h"

namespace seapile::scene {

/// Water at rest, and what of it lies below what the surface has to stay above: the bottom, or the pile's shoulder.
struct WaterBox {
  double width;  ///< [m]
  double depth;  ///< [m]
  double floor;  ///< 0, or the height of the pile's shoulder at the start [m]
};

/// `columns`: of the mesh, across the water.
void check_surface(const basin::SurfaceSpec& surface, const WaterBox& water, double columns, const std::string& pointer,
                   base::Problems& problems);

/// Sizes of elements in a box whose shorter side is `side` [m]; both stand at `pointer`.
void check_sizes(double size, double pile_size, double side, const std::string& pointer, base::Problems& problems);

/// Of a mesh with a pile in it; the motion stands at `pointer`.
void check_follows_pile(const basin::MotionMethod& motion, const std::string& pointer, base::Problems& problems);

/// Between which depths the lowest point of a pile's tip stays [m], so that its shoulder is under water and the mesh
/// has room below it. Empty (least >= most) when the water does not cover the tip.
struct TipRange {
  double least, most;
};
TipRange tip_range(double radius, const pile::Tip& tip, double depth);

}  // namespace seapile::scene
