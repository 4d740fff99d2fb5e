#include "bench/scaling_case.h"

#include <malloc.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <future>
#include <stdexcept>

namespace seapile::bench {
namespace {

const simulation::Array& array_of(const std::vector<simulation::Array>& state, const std::string& name) {
  for (const simulation::Array& array : state)
    if (array.info.name == name) return array;
  throw std::runtime_error("the checkpoint has no " + name);
}

scene::RecordSpec without_frames() {
  scene::RecordSpec record;
  record.frames = {};
  return record;
}

}  // namespace

scene::SceneSpec scaled_scene(std::int64_t grains, double speed) {
  scene::SceneSpec scene;
  const double scale = std::sqrt(static_cast<double>(grains) / static_cast<double>(scene.bed.grains.count));
  scene.bed.grains.count = grains;
  scene.bed.domain.width *= scale;
  scene.bed.domain.height *= scale;
  scene.bed.preparation.longest *= std::max(1.0, scale);
  scene.pile.emplace();
  scene.pile->driving = pile::ConstantDriving{speed};
  return scene;
}

ScalingState prepare(std::int64_t grains, const ScalingOptions& options, int threads) {
  ScalingState start;
  start.scene = scaled_scene(grains, options.speed);
  // Reached by the stop below, which leaves a checkpoint.
  start.scene.pile->depth = 2 * options.depth;
  const simulation::Execution execution{threads, options.simd, {1}};  // asked after each step whether to stop
  start.settling = measured([&] { start.bed = simulation::prepare_bed(start.scene.bed, {}, execution, {}); });

  simulation::RunHooks hooks;
  hooks.record = [&](const simulation::Record& r) { start.records.push_back(r); };
  hooks.stop = [&] { return !start.records.empty() && start.records.back().depth >= options.depth; };
  hooks.checkpoint = [&](const std::vector<simulation::Array>& state) { start.state = state; };
  simulation::RunResult result;
  start.driving =
      measured([&] { result = simulation::run(start.scene, without_frames(), start.bed, execution, {}, {}, hooks); });
  if (result.outcome != simulation::Outcome::stopped || start.state.empty())
    throw std::runtime_error("the pile has not reached the depth of the state: " + result.reason);
  start.scene.pile->depth.reset();
  start.scene.pile->duration = start.records.back().time + options.time;
  return start;
}

ScalingRun run_once(const ScalingState& start, const ScalingOptions& options, int threads) {
  ScalingRun measured_run;
  const double clock = clock_rate(), step = start.scene.contact.step;
  double first_cpu = 0, first_wall = 0, first_time = 0, last_cpu = 0, last_wall = 0, last_time = 0;
  simulation::RunHooks hooks;
  // Records are held back until their steps are accepted; progress is told with each.
  hooks.progress = [&](const simulation::Progress& p) {
    last_cpu = cpu_seconds(), last_wall = wall_seconds(), last_time = p.time;
    if (first_time == 0) first_cpu = last_cpu, first_wall = last_wall, first_time = last_time;
  };
  hooks.record = [&](const simulation::Record& r) {
    if (r.time > first_time) measured_run.contact_substeps += contact_substeps(r, start.scene.contact);
  };
  const simulation::RunResult result = simulation::run(
      start.scene, without_frames(), start.bed, {threads, options.simd}, start.state, {start.records, {}}, hooks);
  if (result.outcome != simulation::Outcome::completed)
    throw std::runtime_error("a measured run failed: " + result.reason);

  measured_run.cost = {clock, last_cpu - first_cpu, last_wall - first_wall};
  measured_run.substeps =
      std::round((last_time - first_time) / step) * static_cast<double>(start.scene.contact.substeps);
  // The profile is of the whole run; the two or three steps before the first record are taken off in proportion.
  const double share = (last_time - first_time) / (last_time - start.records.back().time);
  for (const auto& [part, seconds] : seconds_of(result.profile)) measured_run.seconds[part] = share * seconds;
  const auto& counts = std::get<std::vector<std::int64_t>>(array_of(start.state, "blocks/bodies_count").values);
  measured_run.rebuilds = metric(result.metrics, "rebuilds") - static_cast<double>(counts.at(1));
  measured_run.state_hash = result.state_hash;
  return measured_run;
}

ScalingRun run_at_once(const ScalingState& start, const ScalingOptions& options, int at_once, int threads) {
  std::vector<std::future<ScalingRun>> running;
  for (int k = 1; k < at_once; ++k)
    running.push_back(std::async(std::launch::async, run_once, std::cref(start), std::cref(options), threads));
  ScalingRun longest = run_once(start, options, threads);
  for (std::future<ScalingRun>& one : running) {
    const ScalingRun run = one.get();
    if (run.state_hash != longest.state_hash) throw std::runtime_error("two runs of the same case differ");
    if (run.cost.wall > longest.cost.wall) longest = run;
  }
  longest.cost.cpu /= at_once;  // it is that of the process
  return longest;
}

ScalingRun median_of(const std::vector<ScalingRun>& runs) {
  const auto middle = [&](auto&& value) {
    std::vector<double> values;
    for (const ScalingRun& r : runs) values.push_back(value(r));
    return median(values);
  };
  ScalingRun of = runs.at(0);
  of.cost.cpu = middle([](const ScalingRun& r) { return r.cost.cpu; });
  of.cost.wall = middle([](const ScalingRun& r) { return r.cost.wall; });
  for (auto& [part, seconds] : of.seconds) seconds = middle([&](const ScalingRun& r) { return r.seconds.at(part); });
  return of;
}

double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmHWM:") {
      double kilobytes = 0;
      status >> kilobytes;
      return 1024 * kilobytes;
    }
  return 0;
}

void forget_peak_memory() {
  malloc_trim(0);  // what an earlier case has left
  std::ofstream("/proc/self/clear_refs") << "5";
}

}  // namespace seapile::bench
