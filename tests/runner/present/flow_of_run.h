// A frame of the water that is put together by hand.
#pragma once

#include "runner/present/flow_figure.h"

namespace seapile::present {

/// A jet from x = -1 to 2 and from y = 0 to 1, cut into 6 by 2 squares, each of them into two triangles by its diagonal
/// from lower left to upper right. The free surface begins at the lip, x = 0. Velocity (1 + y, 0), thus linear speeds.
FlowOfRun straight_jet();

/// A basin from x = -1.5 to 1.5 and from y = 0 to 1, cut in the same way, at t = 2.5 s, its whole top free.
FlowOfRun small_basin();

/// Moves every vertex.
void move(FlowOfRun& run, base::Vec2 (*place)(base::Vec2 place));

/// Gives every vertex another velocity.
void set_velocity(FlowOfRun& run, base::Vec2 (*velocity)(base::Vec2 place));

}  // namespace seapile::present
