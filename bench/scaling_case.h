// One bed of the scaling benchmark with the pile in it, and measured runs from that state.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "solver/simulation/run.h"

namespace seapile::bench {

struct ScalingOptions {
  std::vector<std::int64_t> grains = {10'000, 100'000};
  std::vector<int> threads = {1, 2};
  int repeat = 3;
  double speed = 0.4;   ///< of the pile [m/s]
  double depth = 0.25;  ///< of the state from which all runs start [m]: the cone is in
  double time = 0.25;   ///< simulated by each measured run [s]
  simulation::Simd simd = simulation::Simd::best;
};

/// The thesis' scene with another number of grains: the box, and with it the bed, keep their shape. The pile stays as
/// it is.
scene::SceneSpec scaled_scene(std::int64_t grains, double speed);

/// The state from which the measured runs start.
struct ScalingState {
  scene::SceneSpec scene;
  simulation::Bed bed;
  std::vector<simulation::Array> state;     ///< a checkpoint
  std::vector<simulation::Record> records;  ///< up to it
  Cost settling{}, driving{};               ///< what it took
};

/// Settles a bed by the product's rule and drives the pile to the depth of the state.
ScalingState prepare(std::int64_t grains, const ScalingOptions& options, int threads);

/// A measured run: from its first record on, so that building and reading back the state are left out.
struct ScalingRun {
  Cost cost{};
  double substeps = 0, contact_substeps = 0;
  std::map<std::string, double> seconds;  ///< of each part
  double rebuilds = 0;  ///< neighbour lists made; one of the whole run, before the first record included
  std::uint64_t state_hash = 0;
};
ScalingRun run_once(const ScalingState& start, const ScalingOptions& options, int threads);

/// The same run so many times at once, which know nothing of each other: the one that took longest, with its share of
/// the CPU time.
ScalingRun run_at_once(const ScalingState& start, const ScalingOptions& options, int at_once, int threads);

/// Median of each number; clock, work and hash are those of the first.
ScalingRun median_of(const std::vector<ScalingRun>& runs);

/// Largest resident memory since the last call of forget_peak_memory() [B].
double peak_memory();
void forget_peak_memory();

}  // namespace seapile::bench
