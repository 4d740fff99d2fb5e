#include "solver/simulation/frame_plan.h"

#include <algorithm>
#include <limits>

#include "solver/pile/pile.h"
#include "solver/simulation/tip_measures.h"

namespace seapile::simulation {

double end_time(const Simulation& sim, const pile::PileSpec& pile) {
  double end = std::numeric_limits<double>::infinity();
  if (pile.duration) end = *pile.duration;
  if (pile.depth) {
    const double way = *pile.depth - (sim.surface - sim.pile->start);
    end = std::min(end, way > 0 ? pile::time_to_reach(pile.driving, way) : 0.0);
  }
  return end;
}

std::vector<FramePlan> plan_frames(const Simulation& sim, const scene::RecordSpec& record, const pile::PileSpec& pile,
                                   double end) {
  std::vector<FramePlan> plan;
  const double above = sim.surface - sim.pile->start;
  for (const double depth : record.frames) {
    const double reached = depth <= above ? 0 : pile::time_to_reach(pile.driving, depth - above);
    // The frame at the depth where the run ends is taken with its last step.
    const double at = std::min(reached, reached < end + sim.clock.dt ? end : reached);
    if (!(at <= end)) continue;
    const double window = std::max(record.window, sim.clock.dt);
    const double way = pile::path(pile.driving, at) - kMotionTravel;
    plan.push_back({std::max(0.0, at - window), way > 0 ? pile::time_to_reach(pile.driving, way) : 0, at, depth});
  }
  std::stable_sort(plan.begin(), plan.end(), [](const FramePlan& a, const FramePlan& b) { return a.end < b.end; });
  return plan;
}

}  // namespace seapile::simulation
