// A frame that is put together by hand, grain by grain.
#pragma once

#include "runner/present/frame_figure.h"

namespace seapile::present {

/// A box of 4 m by 4 m, the bed's surface at 2 m, a flat pile of half-width 0.1 m driven 0.5 m deep at 0.1 m/s.
FrameOfRun empty_run();

void add_grain(FrameOfRun& run, std::int64_t id, base::Vec2 centre, double radius, base::Vec2 velocity = {},
               base::Vec2 displacement = {});
/// `second`: another grain's id, or what a frame calls walls and pile.
void add_contact(FrameOfRun& run, std::int64_t first, std::int64_t second, base::Vec2 point, double normal_force);
/// Cells of 0.1 m, 40 by 40, without stress but for one.
void set_stress(FrameOfRun& run, int column, int row, double major, double minor, double direction);

}  // namespace seapile::present
