#include "runner/commands/traded.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "runner/present/replicates.h"
#include "runner/store/finished.h"
#include "runner/study/nearest.h"

namespace seapile::commands {
namespace {

/// The number, or those of a curve, that a run has under the name; a bin that a run does not reach is left out.
std::vector<double> values_of(const store::FinishedCase& run, const std::string& asked) {
  std::vector<double> values;
  for (const std::string& name : run.metric_names())
    if (store::means(asked, name) && std::isfinite(run.metric(name)->value)) values.push_back(run.metric(name)->value);
  return values;
}

/// Why there is no result, as briefly as that many runs can share it.
std::string failure_of(const std::filesystem::path& root, const std::string& case_id) {
  const std::filesystem::path run = store::newest_run(root, case_id);
  if (run.empty()) return "never run";
  const auto result = store::read_manifest(run).result;
  return result.outcome == simulation::Outcome::diverged ? "diverged: " + result.reason : "stopped";
}

}  // namespace

std::vector<present::TradedGroup> traded(const study::Study& study, const std::filesystem::path& root) {
  std::vector<present::TradedGroup> groups;
  std::set<std::string> known;
  std::size_t finished = 0;
  for (const study::Case& one : study.cases) {
    present::Labels labels = one.labels;
    std::string variant, seed;
    for (const auto& [path, value] : labels) {
      if (path == study::kVariant) variant = value;
      if (path == present::kSeed) seed = value;
    }
    std::erase_if(labels,
                  [](const auto& label) { return label.first == study::kVariant || label.first == present::kSeed; });
    auto group = std::ranges::find(groups, labels, &present::TradedGroup::labels);
    if (group == groups.end())
      group = groups.insert(groups.end(), {labels, study.trade->metrics, study.trade->against, {}});
    auto found = std::ranges::find(group->variants, variant, &present::TradedVariant::name);
    if (found == group->variants.end()) found = group->variants.insert(group->variants.end(), {variant, {}});

    present::VariantRun run;
    run.packing = seed;
    run.value.resize(study.trade->metrics.size());
    if (const auto result = store::read_finished(root, one.id, true)) {
      ++finished;
      for (const std::string& name : result->metric_names()) known.insert(name);
      for (std::size_t m = 0; m < run.value.size(); ++m) run.value[m] = values_of(*result, study.trade->metrics[m]);
      run.cpu_seconds = result->manifest.provenance.cpu_seconds;
      run.peak_memory_mb = result->manifest.provenance.peak_memory_mb;
      if (const simulation::Metric* steps = result->metric("steps")) run.steps = steps->value;
    } else {
      run.failure = failure_of(root, one.id);
    }
    found->runs.push_back(std::move(run));
  }
  base::Problems problems;
  for (const std::string& metric : study.trade->metrics) {
    if (finished == 0 || std::ranges::any_of(known, [&](const auto& name) { return store::means(metric, name); }))
      continue;
    problems.push_back({study.trade->kind == study::TradeKind::frontier ? "/frontier/of" : "/ablate/of",
                        fmt::format("no finished case has a metric \"{}\"", metric),
                        "a metric that `runner show` lists", study::nearest(metric, {known.begin(), known.end()})});
  }
  if (!problems.empty()) throw study::BadInput(study.file.string(), std::move(problems));
  return groups;
}

}  // namespace seapile::commands
