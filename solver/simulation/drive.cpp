#include "solver/simulation/drive.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "solver/mesh/generate.h"
#include "solver/simulation/basin_state.h"
#include "solver/simulation/frame_plan.h"
#include "solver/simulation/held_back.h"
#include "solver/simulation/objection.h"
#include "solver/simulation/observe.h"
#include "solver/simulation/state.h"
#include "solver/simulation/step.h"
#include "solver/simulation/water_metrics.h"

namespace seapile::simulation {
namespace {

constexpr std::int64_t kStretch = 100;  // steps between two states to which a run could go back

class Drive {
 public:
  Drive(Simulation& sim, const scene::SceneSpec& scene, const scene::RecordSpec& record, const Trying& trying,
        Measuring measuring, const RecordsSoFar& so_far, const RunHooks& hooks)
      : sim_(sim),
        scene_(scene),
        record_(record),
        hooks_(hooks),
        stretch_(trying.stretch > 0 ? trying.stretch : kStretch),
        reject_at_(trying.reject_at),
        end_(end_time(sim, *scene.pile)),
        half_(1e-6 * sim.clock.dt),
        frames_(plan_frames(sim, record, *scene.pile, end_)) {
    now_.measuring = std::move(measuring);
    now_.records = so_far.records;
    now_.flow_records = so_far.flow_records;
    while (now_.next_frame < frames_.size() && frames_[now_.next_frame].end <= sim.clock.time() - half_)
      ++now_.next_frame;
    now_.next_mark = now_.next_frame + now_.measuring.open.size();
  }

  RunResult run() {
    begin_stretch();
    while (result_.outcome == Outcome::completed) {
      if (at_end() || stretch_is_over()) {
        if (Objection why = stretch_objection(sim_, start_energy_, trial_->start()); !why.empty()) {
          reject(std::move(why));
          continue;
        }
        held_.release();
        if (at_end()) break;
        begin_stretch();
        ask();
      } else {
        advance();
      }
    }
    finish();
    return std::move(result_);
  }

 private:
  /// Where the loop stands beside the simulation's state.
  struct Place {
    std::size_t next_frame = 0, next_mark = 0;
    Measuring measuring;
    std::vector<Record> records;
    std::vector<FlowRecord> flow_records;
  };

  bool at_end() const { return sim_.clock.time() >= end_ - half_; }
  int grain_steps() const { return sim_.water ? sim_.water->grain_steps : 1; }

  /// Windows are no part of a state to go back to, so it is taken while none is open, and where a step of the fluid
  /// begins. The places that frames compare with are sealed beside it: a way of the pile is longer than a window, and
  /// frames may be closer than that.
  bool stretch_is_over() const {
    return steps_ >= stretch_ && windows_.empty() && sim_.clock.begins(grain_steps(), sim_.clock.halvings);
  }

  void begin_stretch() {
    trial_.emplace(sim_);
    attempts_ = Attempts(sim_.clock.halvings);
    start_energy_ = energy_level(sim_);
    start_ = {now_.next_frame, now_.next_mark, now_.measuring, {}, {}};
    start_records_ = now_.records.size();
    start_flow_records_ = now_.flow_records.size();
    steps_ = 0;
  }

  /// Seals the state at the stretch's start.
  void seal() {
    if (!hooks_.checkpoint) return;
    std::vector<Array> sealed = trial_->start();
    std::ranges::move(arrays_of(start_.measuring), std::back_inserter(sealed));
    hooks_.checkpoint(sealed);
  }

  /// At a stretch's start: checkpoints, and whether to stop.
  void ask() {
    const bool stop = hooks_.stop && hooks_.stop();
    if (stop || (hooks_.checkpoint_due && hooks_.checkpoint_due())) seal();
    if (!stop) return;
    result_.outcome = Outcome::stopped;
    result_.reason = "stopped on request at t = " + std::to_string(sim_.clock.time()) + " s";
  }

  Objection try_step() {
    try {
      const StepReport report = step(sim_, !windows_.empty());
      Objection why = objection(sim_, report);
      if (why.empty()) gather(sim_, report);
      return why;
    } catch (const mesh::NoMesh& error) {
      return {Cause::mesh, std::string("no new mesh could be made: ") + error.what()};
    }
  }

  void advance() {
    if (!attempts_->rejected() && may_grow(sim_.stepping, sim_.clock, grain_steps()))
      set_halvings(sim_, sim_.clock.halvings - 1);
    open_windows();
    if (Objection why = try_step(); !why.empty()) return reject(std::move(why));
    ++steps_;
    count_accepted(sim_.stepping, sim_.clock);
    if (sim_.clock.step == reject_at_) {
      reject_at_ = -1;
      return go_back();
    }
    for (ForceWindow& window : windows_) window.add(sim_);
    take_frames();
    const bool due =
        std::floor(sim_.pile->travel / record_.travel) > std::floor(sim_.gathering.travel / record_.travel);
    if (!at_end() && !due) return;
    if (Objection why = take_records(); !why.empty()) reject(std::move(why));
  }

  void open_windows() {
    const double time = sim_.clock.time();
    // At the last step that is not after it, so that the pile goes the whole way from there.
    for (; now_.next_mark < frames_.size() && frames_[now_.next_mark].mark < time + sim_.clock.size() - half_;
         ++now_.next_mark)
      now_.measuring.open.push_back(places_of(sim_));
    while (now_.next_frame + windows_.size() < frames_.size() &&
           frames_[now_.next_frame + windows_.size()].begin <= time + half_)
      windows_.emplace_back(frames_[now_.next_frame + windows_.size()].depth);
  }

  void take_frames() {
    while (!windows_.empty() && (at_end() || frames_[now_.next_frame].end <= sim_.clock.time() + half_)) {
      held_.add(hooks_.frame, windows_.front().frame(sim_, record_.spacing, scene_.bed.domain.height));
      if (sim_.water) held_.add(hooks_.flow_frame, frame_of(sim_.water->basin));
      Measuring& measuring = now_.measuring;
      const bool marked = now_.next_mark > now_.next_frame;
      measuring.taken.push_back(measures_of(sim_, windows_.front(), marked ? &measuring.open.front() : nullptr));
      if (marked) measuring.open.erase(measuring.open.begin());
      now_.next_mark = std::max(now_.next_mark, now_.next_frame + 1);
      windows_.erase(windows_.begin());
      ++now_.next_frame;
    }
  }

  Objection take_records() {
    now_.records.push_back(take_record(sim_));
    held_.add(hooks_.record, now_.records.back());
    if (sim_.water) {
      now_.flow_records.push_back(take_flow_record(sim_));
      held_.add(hooks_.flow_record, now_.flow_records.back());
    }
    if (hooks_.progress) hooks_.progress({sim_.clock.time(), std::min(1.0, sim_.clock.time() / end_), depth(sim_)});
    return overlap_objection(sim_, now_.records.back().overlap_max);
  }

  /// Everything returns to the stretch's start.
  void go_back() {
    Stepping known = sim_.stepping;
    trial_->reject(sim_);
    known.calm = sim_.stepping.calm;
    sim_.stepping = known;
    set_halvings(sim_, attempts_->halvings());
    held_.drop();
    windows_.clear();
    steps_ = 0;
    now_.next_frame = start_.next_frame;
    now_.next_mark = start_.next_mark;
    now_.measuring = start_.measuring;
    now_.records.resize(start_records_);
    now_.flow_records.resize(start_flow_records_);
    if (attempts_->remeshed()) remesh_water(sim_);
  }

  void reject(Objection why) {
    ++sim_.stepping.rejected[static_cast<std::size_t>(why.cause)];
    const bool can_remesh = sim_.water && sim_.water->basin.spec.mesh.remesh;
    Remedy remedy = attempts_->after(sim_.clock.halvings, can_remesh);
    const std::string reason = why.why + " (at t = " + std::to_string(sim_.clock.time()) + " s)";
    std::vector<Array> rejected;
    if (remedy != Remedy::halve) rejected = snapshot(sim_);
    try {
      go_back();
    } catch (const mesh::NoMesh&) {  // the new mesh was the last hope
      remedy = Remedy::stop;
    }
    if (remedy != Remedy::stop) return;
    result_.outcome = Outcome::diverged;
    result_.reason = reason;
    const Stepping known = sim_.stepping;
    trial_->reject(sim_);
    rejections_ = known;
    seal();
    if (hooks_.post_mortem) hooks_.post_mortem(rejected, reason);
  }

  void finish() {
    result_.time = sim_.clock.time();
    result_.depth = depth(sim_);
    result_.state_hash = state_hash(sim_);
    std::vector<Metric>& metrics = result_.metrics;
    const auto add = [&](std::vector<Metric> more) { std::ranges::move(more, std::back_inserter(metrics)); };
    metrics = drive_metrics(now_.records, now_.flow_records, *scene_.pile);
    add(metrics_of(now_.measuring.taken));
    if (sim_.water) add(water_metrics(now_.records, now_.flow_records, *sim_.water));
    metrics.push_back({"steps", static_cast<double>(sim_.clock.step), "-", "whole steps done"});
    add(metrics_of(rejections_.value_or(sim_.stepping), sim_.clock.dt));
    std::visit(
        [&](const auto& system) {
          metrics.push_back({"rebuilds", static_cast<double>(system.rebuilds), "-", "neighbour lists made"});
        },
        sim_.contacts);
    for (const auto& e : sim_.profile.entries()) result_.profile.push_back({e.part, e.seconds, e.calls});
  }

  Simulation& sim_;
  const scene::SceneSpec& scene_;
  const scene::RecordSpec& record_;
  const RunHooks& hooks_;
  std::int64_t stretch_, reject_at_;
  double end_, half_;  // [s]; half: what rounding may do
  std::vector<FramePlan> frames_;
  Place now_;
  std::vector<ForceWindow> windows_;  // of the frames whose window is open, from next_frame on
  HeldBack held_;
  RunResult result_;

  // Of the stretch.
  std::optional<Trial> trial_;
  std::optional<Attempts> attempts_;
  EnergyLevel start_energy_;
  Place start_;  // without its records
  std::size_t start_records_ = 0, start_flow_records_ = 0;
  std::int64_t steps_ = 0;
  std::optional<Stepping> rejections_;  // of a run that has diverged
};

}  // namespace

RunResult drive(Simulation& sim, const scene::SceneSpec& scene, const scene::RecordSpec& record, const Trying& trying,
                Measuring measuring, const RecordsSoFar& so_far, const RunHooks& hooks) {
  return Drive(sim, scene, record, trying, std::move(measuring), so_far, hooks).run();
}

}  // namespace seapile::simulation
