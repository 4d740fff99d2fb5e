#include "solver/simulation/basin.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "solver/base/profile.h"
#include "solver/basin/basin.h"
#include "solver/basin/step.h"
#include "solver/mesh/generate.h"
#include "solver/simulation/basin_metrics.h"
#include "solver/simulation/basin_state.h"
#include "solver/simulation/flow_state.h"

namespace seapile::simulation {
namespace {

/// The step that ends next to a time.
std::int64_t step_at(double time, double dt) { return std::llround(time / dt); }

/// Steps after which a frame is handed out.
std::set<std::int64_t> frame_steps(const scene::RecordSpec& record, double dt, std::int64_t last) {
  std::set<std::int64_t> steps{0, last};
  for (const double time : record.times)
    if (const std::int64_t step = step_at(time, dt); step < last) steps.insert(step);
  return steps;
}

/// A basin's run from its state to its end.
class Run {
 public:
  Run(basin::Basin basin, const scene::RecordSpec& record, std::vector<FlowRecord> records, const BasinHooks& hooks)
      : basin_(std::move(basin)),
        hooks_(hooks),
        records_(std::move(records)),
        last_(step_at(basin_.spec.time.duration, basin_.spec.time.step)),
        every_(std::max<std::int64_t>(1, step_at(record.interval, basin_.spec.time.step))),
        frames_(frame_steps(record, basin_.spec.time.step, last_)) {}

  RunResult run(base::Profile& profile) {
    if (basin_.step == 0) tell();
    while (basin_.step < last_ && result_.outcome == Outcome::completed) {
      advance(profile);
      if (result_.outcome == Outcome::completed) tell();
      if (result_.outcome == Outcome::completed && basin_.step % every_ == 0 && basin_.step < last_) look();
    }
    result_.time = basin::time_of(basin_);
    result_.metrics = metrics_of(basin_, records_);
    result_.state_hash = hash_of(frame_of(basin_));
    return result_;
  }

 private:
  void advance(base::Profile& profile) {
    std::string why;
    try {
      why = basin::step(basin_, profile);
    } catch (const mesh::NoMesh& error) {
      why = std::string("no new mesh could be made: ") + error.what();
    }
    if (why.empty()) return;
    result_.outcome = Outcome::diverged;
    result_.reason = why + " (after t = " + std::to_string(basin::time_of(basin_)) + " s)";
    if (hooks_.frame && !frames_.contains(basin_.step)) hooks_.frame(frame_of(basin_));
    if (hooks_.checkpoint) hooks_.checkpoint(snapshot(basin_));
  }

  /// Hands out what is due at this step.
  void tell() {
    if (basin_.step % every_ == 0 || basin_.step == last_) {
      records_.push_back(record_of(basin_));
      if (hooks_.record) hooks_.record(records_.back());
    }
    if (frames_.contains(basin_.step) && hooks_.frame) hooks_.frame(frame_of(basin_));
  }

  /// Progress, checkpoints, and whether to stop.
  void look() {
    const double time = basin::time_of(basin_);
    if (hooks_.progress)
      hooks_.progress({time, static_cast<double>(basin_.step) / static_cast<double>(last_), std::nan("")});
    const bool stop = hooks_.stop && hooks_.stop();
    if (hooks_.checkpoint && (stop || (hooks_.checkpoint_due && hooks_.checkpoint_due())))
      hooks_.checkpoint(snapshot(basin_));
    if (!stop) return;
    result_.outcome = Outcome::stopped;
    result_.reason = "stopped on request at t = " + std::to_string(time) + " s";
  }

  basin::Basin basin_;
  const BasinHooks& hooks_;
  std::vector<FlowRecord> records_;
  std::int64_t last_, every_;
  std::set<std::int64_t> frames_;
  RunResult result_;
};

}  // namespace

RunResult run_basin(const basin::BasinSpec& spec, const scene::RecordSpec& record, const Execution& execution,
                    const std::vector<Array>& resume_from, const std::vector<FlowRecord>& records_so_far,
                    const BasinHooks& hooks) {
  base::Profile profile;
  RunResult result;
  try {
    const base::InstructionSet instructions = instructions_of(execution.simd);
    Run run(resume_from.empty() ? basin::filled(spec, instructions) : restored(spec, instructions, resume_from), record,
            records_so_far, hooks);
    result = run.run(profile);
  } catch (const mesh::NoMesh& error) {
    result.outcome = Outcome::diverged;
    result.reason = error.what();
  }
  for (const auto& e : profile.entries()) result.profile.push_back({e.part, e.seconds, e.calls});
  return result;
}

}  // namespace seapile::simulation
