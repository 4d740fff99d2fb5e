// What a run hands out: records along the way, frames at chosen depths, metrics at the end.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "solver/grains/fields_on_grid.h"
#include "solver/simulation/frame.h"
#include "solver/simulation/record.h"
#include "solver/simulation/run.h"
#include "solver/simulation/simulation.h"
#include "solver/simulation/step.h"
#include "solver/simulation/tip_measures.h"

namespace seapile::simulation {

/// Depth d of the tip below the initial bed surface [m].
double depth(const Simulation& simulation);

/// Adds a step to what the coming record will say.
void gather(Simulation& simulation, const StepReport& report);

/// Closes the record of the steps since the last one and begins the next.
Record take_record(Simulation& simulation);

/// Contact forces summed over the steps of a window; a frame shows their means.
class ForceWindow {
 public:
  explicit ForceWindow(double asked_depth) : asked_(asked_depth) {}
  /// Adds the impulses of the last step, which kept them.
  void add(const Simulation& simulation);
  double asked() const { return asked_; }
  /// The frame at the window's end.
  Frame frame(const Simulation& simulation, double spacing, double height) const;
  /// The means so far, by rising (first, second).
  std::vector<grains::ContactForce> forces() const;

 private:
  struct Sum {
    double normal = 0, tangential = 0;        // [N s/m]
    double nx = 0, ny = 0, x = 0, y = 0;      // of the last step in which it touched
  };
  double asked_;
  double time_ = 0;  // [s]
  std::map<std::pair<std::int32_t, std::int32_t>, Sum> sum_;
};

/// Where grains and tip are now, for a frame to compare with.
PlacesBefore places_of(const Simulation& simulation);

/// What the frame at the end of `window` says of the grains under the tip. `before`: null when nothing is known of it.
TipMeasures measures_of(const Simulation& simulation, const ForceWindow& window, const PlacesBefore* before);

/// Headline, fluctuation, depth bins and extremes of a drive's records (docs/formulation.md 3). `flow_records`: of the
/// fluid, as many; empty when the scene is dry.
std::vector<Metric> drive_metrics(std::span<const Record> records, std::span<const FlowRecord> flow_records,
                                  const pile::PileSpec& pile);

}  // namespace seapile::simulation
