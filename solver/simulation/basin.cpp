#include "solver/simulation/basin.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "solver/base/profile.h"
#include "solver/basin/basin.h"
#include "solver/basin/remesh.h"
#include "solver/basin/step.h"
#include "solver/mesh/generate.h"
#include "solver/simulation/basin_metrics.h"
#include "solver/simulation/basin_state.h"
#include "solver/simulation/flow_state.h"
#include "solver/simulation/held_back.h"
#include "solver/simulation/objection.h"

namespace seapile::simulation {
namespace {

constexpr std::int64_t kStretch = 20;  // steps between two states to which a run could go back
constexpr const char* kStepping = "basin/rejected";

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
  Run(basin::Basin basin, const Stepping& stepping, const scene::RecordSpec& record, std::vector<FlowRecord> records,
      const Trying& trying, const BasinHooks& hooks)
      : basin_(std::move(basin)),
        stepping_(stepping),
        hooks_(hooks),
        stretch_(trying.stretch > 0 ? trying.stretch : kStretch),
        reject_at_(trying.reject_at),
        records_(std::move(records)),
        last_(step_at(basin_.spec.time.duration, basin_.spec.time.step)),
        every_(std::max<std::int64_t>(1, step_at(record.interval, basin_.spec.time.step))),
        frames_(frame_steps(record, basin_.spec.time.step, last_)) {}

  RunResult run(base::Profile& profile) {
    if (basin_.clock.ticks() == 0) tell();  // the start is no step's, and is never taken back
    held_.release();
    begin_stretch();
    while (result_.outcome == Outcome::completed) {
      if (!at_end() && steps_ < stretch_) {
        advance(profile);
        continue;
      }
      held_.release();
      if (at_end()) break;
      begin_stretch();
      ask();
    }
    result_.time = basin::time_of(basin_);
    result_.metrics = metrics_of(basin_, records_);
    std::ranges::move(metrics_of(stepping_, basin_.clock.dt), std::back_inserter(result_.metrics));
    result_.state_hash = hash_of(frame_of(basin_));
    return std::move(result_);
  }

 private:
  bool at_end() const { return basin_.clock.step >= last_; }

  void begin_stretch() {
    start_ = state();
    start_stepping_ = stepping_;
    start_records_ = records_.size();
    attempts_ = Attempts(basin_.clock.halvings);
    steps_ = 0;
  }

  /// Everything that the run can be continued from.
  std::vector<Array> state() const {
    std::vector<Array> all = snapshot(basin_);
    if (stepping_ != Stepping{}) all.push_back(as_array(stepping_, kStepping));
    return all;
  }

  Objection try_step(base::Profile& profile) {
    try {
      Objection why = basin::step(basin_, profile);
      return why.empty() ? objection(basin_) : why;
    } catch (const mesh::NoMesh& error) {
      return {Cause::mesh, std::string("no new mesh could be made: ") + error.what()};
    }
  }

  void resize(int halvings) {
    if (halvings == basin_.clock.halvings) return;
    stepping_.calm = 0;
    stepping_.smallest = std::max(stepping_.smallest, halvings);
    set_halvings(basin_, halvings);
  }

  void advance(base::Profile& profile) {
    if (!attempts_.rejected() && may_grow(stepping_, basin_.clock, 1)) resize(basin_.clock.halvings - 1);
    if (Objection why = try_step(profile); !why.empty()) return reject(why);
    ++steps_;
    count_accepted(stepping_, basin_.clock);
    if (basin_.clock.step == reject_at_) {
      reject_at_ = -1;
      return go_back();
    }
    tell();
  }

  /// Everything returns to the stretch's start.
  void go_back() {
    basin_ = restored(basin_.spec, basin_.solver.instructions, start_);
    stepping_.calm = start_stepping_.calm;
    resize(attempts_.halvings());
    held_.drop();
    records_.resize(start_records_);
    steps_ = 0;
    if (attempts_.remeshed()) basin::remesh(basin_);
  }

  void reject(const Objection& why) {
    ++stepping_.rejected[static_cast<std::size_t>(why.cause)];
    Remedy remedy = attempts_.after(basin_.clock.halvings, basin_.spec.mesh.remesh.has_value());
    const std::string reason = why.why + " (after t = " + std::to_string(basin::time_of(basin_)) + " s)";
    std::vector<Array> rejected;
    if (remedy != Remedy::halve) rejected = snapshot(basin_);
    try {
      go_back();
    } catch (const mesh::NoMesh&) {  // the new mesh was the last hope
      remedy = Remedy::stop;
    }
    if (remedy != Remedy::stop) return;
    result_.outcome = Outcome::diverged;
    result_.reason = reason;
    basin_ = restored(basin_.spec, basin_.solver.instructions, start_);
    if (hooks_.frame && !is_framed()) hooks_.frame(frame_of(basin_));
    if (hooks_.checkpoint) hooks_.checkpoint(start_);
    if (hooks_.post_mortem) hooks_.post_mortem(rejected, reason);
  }

  bool is_framed() const { return basin_.clock.part == 0 && frames_.contains(basin_.clock.step); }

  /// Hands out what is due at this step.
  void tell() {
    if (basin_.clock.part != 0) return;
    if (basin_.clock.step % every_ == 0 || at_end()) {
      records_.push_back(record_of(basin_));
      held_.add(hooks_.record, records_.back());
      if (hooks_.progress && basin_.clock.step > 0 && !at_end())
        hooks_.progress({basin::time_of(basin_), static_cast<double>(basin_.clock.step) / static_cast<double>(last_),
                         std::nan("")});
    }
    if (is_framed()) held_.add(hooks_.frame, frame_of(basin_));
  }

  /// At a stretch's start: checkpoints, and whether to stop.
  void ask() {
    const bool stop = hooks_.stop && hooks_.stop();
    if (hooks_.checkpoint && (stop || (hooks_.checkpoint_due && hooks_.checkpoint_due()))) hooks_.checkpoint(start_);
    if (!stop) return;
    result_.outcome = Outcome::stopped;
    result_.reason = "stopped on request at t = " + std::to_string(basin::time_of(basin_)) + " s";
  }

  basin::Basin basin_;
  Stepping stepping_;
  const BasinHooks& hooks_;
  std::int64_t stretch_, reject_at_;
  std::vector<FlowRecord> records_;
  std::int64_t last_, every_;
  std::set<std::int64_t> frames_;
  HeldBack held_;
  RunResult result_;

  // Of the stretch.
  std::vector<Array> start_;
  Stepping start_stepping_;
  std::size_t start_records_ = 0;
  Attempts attempts_{0};
  std::int64_t steps_ = 0;
};

}  // namespace

RunResult run_basin(const basin::BasinSpec& spec, const scene::RecordSpec& record, const Execution& execution,
                    const std::vector<Array>& resume_from, const std::vector<FlowRecord>& records_so_far,
                    const BasinHooks& hooks) {
  base::Profile profile;
  RunResult result;
  try {
    const base::InstructionSet instructions = instructions_of(execution.simd);
    Run run(resume_from.empty() ? basin::filled(spec, instructions) : restored(spec, instructions, resume_from),
            stepping_of(resume_from, kStepping), record, records_so_far, execution.trying, hooks);
    result = run.run(profile);
  } catch (const mesh::NoMesh& error) {
    result.outcome = Outcome::diverged;
    result.reason = error.what();
  }
  for (const auto& e : profile.entries()) result.profile.push_back({e.part, e.seconds, e.calls});
  return result;
}

}  // namespace seapile::simulation
