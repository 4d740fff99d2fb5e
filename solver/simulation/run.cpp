#include "solver/simulation/run.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>

#include "solver/pile/pile.h"
#include "solver/mesh/generate.h"
#include "solver/simulation/basin_state.h"
#include "solver/simulation/build.h"
#include "solver/simulation/observe.h"
#include "solver/simulation/state.h"
#include "solver/simulation/step.h"
#include "solver/simulation/tip_measures.h"
#include "solver/simulation/water_metrics.h"

namespace seapile::simulation {
namespace {

constexpr int kTrialSteps = 100;  // between two states to which a run could go back

/// When the run ends [s]: at its depth or its duration, whichever comes first.
double end_time(const Simulation& sim, const pile::PileSpec& pile) {
  double end = std::numeric_limits<double>::infinity();
  if (pile.duration) end = *pile.duration;
  if (pile.depth) {
    const double way = *pile.depth - (sim.surface - sim.pile->start);
    end = std::min(end, way > 0 ? pile::time_to_reach(pile.driving, way) : 0.0);
  }
  return end;
}

/// The frames still to be taken, in the order of the times at which their depths are first reached.
struct FramePlan {
  double begin;  ///< of the window [s]
  double mark;   ///< when the tip first was kMotionTravel above its place at the end; 0: it never was [s]
  double end;    ///< [s]
  double depth;  ///< asked [m]
};
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

/// One step; why it is not acceptable, or empty.
std::string advance(Simulation& sim, bool keep_impulses) {
  try {
    const StepReport report = step(sim, keep_impulses);
    std::string why = objection(sim, report);
    if (why.empty()) gather(sim, report);
    return why;
  } catch (const mesh::NoMesh& error) {
    return std::string("no new mesh could be made: ") + error.what();
  }
}

}  // namespace

std::vector<NumericsVersion> numerics_versions(const scene::SceneSpec& scene) {
  if (scene.jet) return {{"mesh", 1}, {"fluid", 2}, {"free_surface", 2}};
  if (scene.basin) return {{"mesh", 1}, {"fluid", 2}, {"free_surface", 2}, {"basin", 1}};
  std::vector<NumericsVersion> versions = {{"grains", 3}, {"pile", 1}, {"bed", 1}, {"record", 2}};
  if (scene.fluid)
    versions.insert(versions.end(), {{"mesh", 1}, {"fluid", 2}, {"free_surface", 2}, {"basin", 1}, {"coupling", 4}});
  return versions;
}

std::vector<Part> parts(const scene::SceneSpec& scene) { return scene::decisions(scene); }

RunResult run(const scene::SceneSpec& scene, const scene::RecordSpec& record, const Bed& bed,
              const Execution& execution, const std::vector<Array>& resume_from,
              const RecordsSoFar& so_far, const RunHooks& hooks) {
  if (!scene.pile) throw std::invalid_argument("run: the scene has no pile");
  RunResult result;
  std::vector<Array> state = resume_from;
  Measuring measuring = take_out(state);
  std::optional<Simulation> built;
  try {
    built = build(scene, bed, execution, state);
  } catch (const std::runtime_error& error) {  // it does not settle under water, or has no mesh
    result.outcome = Outcome::diverged;
    result.reason = error.what();
    return result;
  }
  Simulation& sim = *built;
  for (const PlacesBefore& before : measuring.open)
    if (before.grain.size() != sim.grains.count()) throw std::invalid_argument("state: measures/place: of other grains");

  const double end = end_time(sim, *scene.pile);
  const std::vector<FramePlan> frames = plan_frames(sim, record, *scene.pile, end);
  std::size_t next_frame = 0;
  const double now = sim.clock.time(), half = 1e-6 * sim.clock.dt;  // what rounding may do
  while (next_frame < frames.size() && frames[next_frame].end <= now - half) ++next_frame;
  std::size_t next_mark = next_frame + measuring.open.size();

  std::vector<Record> records = so_far.records;
  std::vector<FlowRecord> flow_records = so_far.flow_records;
  std::vector<ForceWindow> windows;  // of the frames whose window is open, from next_frame on
  std::optional<Trial> trial;
  Measuring at_trial;
  const auto seal = [&](std::vector<Array> sealed, const Measuring& measured) {
    if (!hooks.checkpoint) return;
    std::ranges::move(arrays_of(measured), std::back_inserter(sealed));
    hooks.checkpoint(sealed);
  };

  while (result.outcome == Outcome::completed && sim.clock.time() < end - half) {
    // A state to go back to; windows are no part of it, so it is taken while none is open. The places that frames
    // compare with are sealed beside it: a way of the pile is longer than a window, and frames may be closer than that.
    if (!trial || (windows.empty() && sim.clock.step % kTrialSteps == 0)) {
      trial.emplace(sim);
      at_trial = measuring;
    }
    // At the last step that is not after it, so that the pile goes the whole way from there.
    for (; next_mark < frames.size() && frames[next_mark].mark < sim.clock.time() + sim.clock.dt - half; ++next_mark)
      measuring.open.push_back(places_of(sim));
    while (next_frame + windows.size() < frames.size() &&
           frames[next_frame + windows.size()].begin <= sim.clock.time() + half)
      windows.emplace_back(frames[next_frame + windows.size()].depth);

    if (std::string why = advance(sim, !windows.empty()); !why.empty()) {
      result.outcome = Outcome::diverged;
      result.reason = std::move(why) + " (at t = " + std::to_string(sim.clock.time()) + " s)";
      trial->reject(sim);
      seal(trial->start(), at_trial);
      break;
    }
    for (ForceWindow& window : windows) window.add(sim);

    const bool last = sim.clock.time() >= end - half;
    while (!windows.empty() && (last || frames[next_frame].end <= sim.clock.time() + half)) {
      if (hooks.frame) hooks.frame(windows.front().frame(sim, record.spacing, scene.bed.domain.height));
      if (sim.water && hooks.flow_frame) hooks.flow_frame(frame_of(sim.water->basin));
      const bool marked = next_mark > next_frame;
      measuring.taken.push_back(measures_of(sim, windows.front(), marked ? &measuring.open.front() : nullptr));
      if (marked) measuring.open.erase(measuring.open.begin());
      next_mark = std::max(next_mark, next_frame + 1);
      windows.erase(windows.begin());
      ++next_frame;
    }

    if (!last && std::floor(sim.pile->travel / record.travel) <= std::floor(sim.gathering.travel / record.travel))
      continue;
    records.push_back(take_record(sim));
    if (hooks.record) hooks.record(records.back());
    if (sim.water) {
      flow_records.push_back(take_flow_record(sim));
      if (hooks.flow_record) hooks.flow_record(flow_records.back());
    }
    if (hooks.progress) hooks.progress({sim.clock.time(), std::min(1.0, sim.clock.time() / end), depth(sim)});
    if (last || !windows.empty()) continue;
    const bool stop = hooks.stop && hooks.stop();
    if (stop || (hooks.checkpoint_due && hooks.checkpoint_due()))
      seal(snapshot(sim), measuring);
    if (stop) {
      result.outcome = Outcome::stopped;
      result.reason = "stopped on request at t = " + std::to_string(sim.clock.time()) + " s";
    }
  }

  result.time = sim.clock.time();
  result.depth = depth(sim);
  result.state_hash = state_hash(sim);
  result.metrics = drive_metrics(records, flow_records, *scene.pile);
  std::ranges::move(metrics_of(measuring.taken), std::back_inserter(result.metrics));
  if (sim.water)
    for (Metric& metric : water_metrics(records, flow_records, *sim.water)) result.metrics.push_back(std::move(metric));
  result.metrics.push_back({"steps", static_cast<double>(sim.clock.step), "-", "steps done"});
  std::visit(
      [&](const auto& system) {
        result.metrics.push_back({"rebuilds", static_cast<double>(system.rebuilds), "-", "neighbour lists made"});
      },
      sim.contacts);
  for (const auto& e : sim.profile.entries()) result.profile.push_back({e.part, e.seconds, e.calls});
  return result;
}

}  // namespace seapile::simulation
