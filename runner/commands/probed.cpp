#include "runner/commands/probed.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "runner/commands/packings.h"
#include "runner/commands/scratch_store.h"
#include "runner/execute/campaign.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/history.h"
#include "runner/execute/processes.h"
#include "runner/execute/progress.h"
#include "runner/store/durable.h"
#include "runner/store/layout.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Why a run cannot be computed again on the bits that it was built on; empty: it can.
std::string hindrance(const fs::path& root, const store::RunHeader& header) {
  if (header.bed_id.empty() || store::is_there(store::bed_run_folder(root, header) / store::kManifestFile)) return "";
  return fmt::format("run {} of its bed {} is gone", header.bed_run, execute::short_id(header.bed_id));
}

/// Puts a case into its group; as the one to be computed, where it is cheaper than that one.
void add(const study::Study& study, const execute::Task& task, const fs::path& root, ProbeGroup& group) {
  ++group.cases;
  const fs::path folder = store::case_folder(root, task.id) / task.newest;
  store::Manifest manifest = store::read_manifest(folder);
  const std::string why = hindrance(root, manifest.header);
  const bool first = group.cases == 1;
  if (!why.empty()) {
    if (first) group.hindrance = why;
    return;
  }
  const auto price = [](const store::Manifest& one) {
    return std::tuple(one.provenance.cpu_seconds, one.header.case_id);
  };
  if (!first && group.hindrance.empty() && price(group.cheapest.manifest) <= price(manifest)) return;
  execute::CampaignOptions options;
  options.root = root.string();
  group.hindrance.clear();
  group.task = task;
  group.of_study = study.cases[task.study_case];
  group.request = execute::request_of(study, task, options);
  group.request.bed_run = manifest.header.bed_run;
  group.request.newest.clear();
  group.cheapest = {folder, std::move(manifest)};
}

/// What the records cover, which curves alone do not tell: they are compared where both are. Empty: the same.
std::string other_extent(const store::Manifest& before, const store::Manifest& now) {
  if (before.records != now.records) return fmt::format("{} records and {}", before.records, now.records);
  if (before.flow_records != now.flow_records)
    return fmt::format("{} records of the water and {}", before.flow_records, now.flow_records);
  return "";
}

/// The plan of the processes: every group's case by itself, for a drive's bed is there already.
execute::Plan plan_of(const std::vector<ProbeGroup>& groups, study::Study& study) {
  execute::Plan plan;
  for (const ProbeGroup& group : groups) {
    execute::Task task = group.task;
    task.study_case = study.cases.size();
    task.bed.reset();
    task.memory_mb = group.cheapest.manifest.provenance.peak_memory_mb;
    task.decision = {execute::Action::run, "probe of " + store::moved_text(group.before, group.now), ""};
    if (!group.hindrance.empty()) task.decision = {execute::Action::fresh, group.hindrance, ""};
    task.name = fmt::format("{} {}", group.kind, execute::short_id(task.id));
    study.cases.push_back(group.of_study);
    plan.tasks.push_back(std::move(task));
  }
  return plan;
}

ProbeResult result_of(const ProbeGroup& group, execute::State state, const std::string& why, const fs::path& scratch,
                      double tolerance) {
  using execute::State;
  ProbeResult result{Probed::failed, kNone, "", why, {}};
  if (!group.hindrance.empty()) {
    result.reason = group.hindrance;
    return result;
  }
  if (state == State::stopped) result.probed = Probed::stopped;
  if (state != State::completed && state != State::diverged) return result;
  try {
    const fs::path run = store::newest_run(scratch, group.task.id);
    return judge_probe(group.cheapest, {run, store::read_manifest(run)}, tolerance);
  } catch (const store::StoreError& error) {
    result.reason = error.what();
    return result;
  }
}

}  // namespace

const char* name(Probed probed) {
  static constexpr const char* kNames[] = {"equivalent", "stale", "failed", "stopped"};
  return kNames[static_cast<int>(probed)];
}

std::vector<ProbeGroup> probe_groups(const std::vector<std::string>& studies, const fs::path& root) {
  const execute::Equivalences equivalences = execute::declared_equivalences(root);
  const execute::Disk disk = [&](const std::string& id) { return execute::read_history(root, id); };
  std::map<std::tuple<std::string, std::string, std::string>, ProbeGroup> groups;
  std::set<std::string> seen;
  for (const std::string& file : studies) {
    const study::Study study = read_settled(file, {}, root);
    for (const execute::Task& task : execute::make_plan(study, execute::todays_numerics, disk, equivalences).tasks) {
      if (!task.outdated || !seen.insert(task.id).second) continue;
      const auto& [before, now] = *task.outdated;
      const std::string kind = execute::name(task.kind);
      ProbeGroup& group = groups[{kind, store::numerics_json(before), store::numerics_json(now)}];
      group.kind = kind;
      group.before = before;
      group.now = now;
      add(study, task, root, group);
    }
  }
  std::vector<ProbeGroup> all;
  for (auto& [key, group] : groups) all.push_back(std::move(group));
  return all;
}

ProbeResult judge_probe(const present::FinishedRun& before, const present::FinishedRun& now, double tolerance) {
  ProbeResult result;
  result.comparison = present::compare(before, now);
  result.largest = result.comparison.largest;
  result.largest_of = result.comparison.largest_of;
  result.reason = present::inequality(result.comparison, tolerance);
  if (result.reason.empty()) result.reason = other_extent(before.manifest, now.manifest);
  result.probed = result.reason.empty() ? Probed::equivalent : Probed::stale;
  if (result.probed == Probed::equivalent)
    result.reason = result.comparison.likeness == present::Likeness::identical ? "identical to the last bit"
                                                                               : fmt::format("within {:g}", tolerance);
  return result;
}

Probes probe(const std::vector<ProbeGroup>& groups, const fs::path& root, const execute::Sharing& sharing,
             double tolerance) {
  const ScratchStore scratch(root);
  study::Study study;
  execute::Plan plan = plan_of(groups, study);
  std::map<std::string, execute::Request> requests;
  for (const ProbeGroup& group : groups) {
    execute::Request request = group.request;
    request.root = fs::absolute(scratch.root()).string();
    requests.emplace(group.task.id, request);
  }
  // From here on a signal is an event, and the scratch store is removed all the same.
  execute::Processes processes(execute::kThisProgram, [&](const execute::Task& task) { return requests.at(task.id); });
  for (const ProbeGroup& group : groups) {
    const store::RunHeader& header = group.cheapest.manifest.header;
    if (group.hindrance.empty() && !header.bed_id.empty()) scratch.take_along(store::bed_run_folder(root, header));
  }
  execute::Summary summary;
  {
    execute::Display display(plan, stderr, ::isatty(STDERR_FILENO) == 1);
    execute::Watch watch = display.watch();
    watch.signalled = [](int) { fmt::print(stderr, "stopped: what is not compared yet stays stale\n"); };
    const execute::StoreView store = {[](const std::string&) { return execute::History(); },
                                      [](const std::string&) { return false; }};
    summary = execute::carry_out(plan, study, execute::todays_numerics, sharing, processes, store, watch);
  }
  Probes probes;
  if (summary.signals > 0) probes.stopped = execute::exit_code(summary);
  for (std::size_t i = 0; i < groups.size(); ++i)
    probes.results.push_back(result_of(groups[i], summary.states[i], summary.why[i], scratch.root(), tolerance));
  return probes;
}

}  // namespace seapile::commands
