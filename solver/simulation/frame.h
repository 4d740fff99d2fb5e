#pragma once

#include <vector>

#include "solver/simulation/array.h"

namespace seapile::simulation {

/// The simulation at one chosen depth. Grain arrays have one row per grain in the order of the grains' ids, so that row
/// k is the same grain in every frame of a run; contact arrays one row per contact; cell arrays one row per cell of a
/// regular grid, x fastest.
struct Frame {
  double time = 0;   ///< [s]
  double depth = 0;  ///< d [m]
  double asked = 0;  ///< the depth that was asked for [m]

  /// "grains/id", "grains/position" (2), "grains/radius", "grains/velocity" (2), "grains/spin", "grains/displacement" (2)
  std::vector<Array> grains;
  /// "contacts/grain" (2: ids; second -1 left wall, -2 right wall, -3 base, -4 pile tip, -5 pile sleeve),
  /// "contacts/position" (2), "contacts/normal" (2, from the first to the second), "contacts/force" (2: normal,
  /// tangential; means over the record's window)
  std::vector<Array> contacts;

  struct Grid {
    double x0 = 0, y0 = 0, spacing = 0;  ///< lower left corner of the first cell, edge of a cell [m]
    int nx = 0, ny = 0;                  ///< cells
  } grid;
  /// "cells/porosity", "cells/stress" (3: xx, yy, xy; compression positive), "cells/principal_stress" (2: major, minor),
  /// "cells/principal_direction" (of the major stress, angle from x in rad)
  std::vector<Array> cells;
};

}  // namespace seapile::simulation
