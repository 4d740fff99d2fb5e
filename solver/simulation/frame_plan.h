// When a drive ends, and when its frames are taken.
#pragma once

#include <vector>

#include "solver/scene/spec.h"
#include "solver/simulation/simulation.h"

namespace seapile::simulation {

/// When the run ends [s]: at its depth or its duration, whichever comes first.
double end_time(const Simulation& sim, const pile::PileSpec& pile);

/// A frame still to be taken.
struct FramePlan {
  double begin;  ///< of the window [s]
  double mark;   ///< when the tip first was kMotionTravel above its place at the end; 0: it never was [s]
  double end;    ///< [s]
  double depth;  ///< asked [m]
};

/// In the order of the times at which their depths are first reached. `end`: of the run [s].
std::vector<FramePlan> plan_frames(const Simulation& sim, const scene::RecordSpec& record, const pile::PileSpec& pile,
                                   double end);

}  // namespace seapile::simulation
