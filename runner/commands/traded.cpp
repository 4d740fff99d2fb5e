#include "runner/commands/traded.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "runner/commands/checked.h"
#include "runner/commands/command.h"
#include "runner/execute/campaign.h"
#include "runner/present/replicates.h"
#include "runner/present/trade_table.h"
#include "runner/store/durable.h"
#include "runner/store/finished.h"
#include "runner/study/frozen_file.h"
#include "runner/study/nearest.h"

namespace seapile::commands {
namespace {

using Named = std::vector<std::pair<std::string, double>>;

/// A bin that a run does not reach is left out.
Named finite_metrics(const store::FinishedCase& run) {
  Named metrics;
  for (const std::string& name : run.metric_names())
    if (const double value = run.metric(name)->value; std::isfinite(value)) metrics.emplace_back(name, value);
  return metrics;
}

/// The number, or those of a curve, under each name asked for.
std::vector<std::vector<double>> values_of(const Named& metrics, const std::vector<std::string>& asked) {
  std::vector<std::vector<double>> values(asked.size());
  for (std::size_t m = 0; m < asked.size(); ++m)
    for (const auto& [name, value] : metrics)
      if (store::means(asked[m], name)) values[m].push_back(value);
  return values;
}

double steps_of(const store::FinishedCase& run) {
  const simulation::Metric* steps = run.metric("steps");
  return steps ? steps->value : 0;
}

std::string hash_of(const store::FinishedCase& run) { return fmt::format("{:016x}", run.manifest.result.state_hash); }

present::VariantRun run_of(const store::FinishedCase& run, const std::vector<std::string>& asked) {
  const store::Provenance& made = run.manifest.provenance;
  return {"", values_of(finite_metrics(run), asked), "", made.cpu_seconds, made.peak_memory_mb, steps_of(run)};
}

present::VariantRun run_of(const study::FrozenRun& run, const std::vector<std::string>& asked) {
  return {"", values_of(run.metrics, asked), "", run.cpu_seconds, run.peak_memory_mb, run.steps};
}

/// Whether a reference was frozen with what a scene's numerics are today, or with some that are declared equivalent:
/// its note ends with them.
bool is_of_today(const study::Frozen& frozen, const scene::SceneSpec& scene,
                 const execute::Equivalences& equivalences) {
  const auto today = execute::todays_numerics(scene);
  const auto was_made_with = [&](const auto& numerics) {
    return frozen.made_with.ends_with(", " + numerics_text(numerics));
  };
  return was_made_with(today) || std::ranges::any_of(equivalences, [&](const store::Equivalence& one) {
           return is_about(one, execute::name(execute::kind_of(scene)), one.before, today) && was_made_with(one.before);
         });
}

/// Why there is no result, as briefly as that many runs can share it.
std::string failure_of(const std::filesystem::path& root, const std::string& case_id) {
  const std::filesystem::path run = store::newest_run(root, case_id);
  if (run.empty()) return "never run";
  const auto result = store::read_manifest(run).result;
  return result.outcome == simulation::Outcome::diverged ? "diverged: " + result.reason : "stopped";
}

}  // namespace

namespace {

/// With a frozen reference, or with the store's where it is null.
Traded traded(const study::Study& study, const std::filesystem::path& root, const study::Frozen* frozen) {
  Traded all;
  const execute::Equivalences equivalences = execute::declared_equivalences(root);
  std::vector<present::TradedGroup>& groups = all.groups;
  const std::vector<std::string>& asked = study.trade->metrics;
  std::set<std::string> known;
  std::size_t finished = 0, others = 0, aged = 0;
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
      group = groups.insert(
          groups.end(),
          {labels, asked, study.trade->against, {}, study.trade->coarser, !one.scene.jet && !one.scene.basin});
    auto found = std::ranges::find(group->variants, variant, &present::TradedVariant::name);
    if (found == group->variants.end()) found = group->variants.insert(group->variants.end(), {variant, {}});

    present::VariantRun run;
    const auto result = store::read_finished(root, one.id, true);
    const study::FrozenRun* kept =
        frozen && variant == study.trade->against ? study::find_frozen(*frozen, one.id) : nullptr;
    if (result) {
      ++finished;
      for (const std::string& name : result->metric_names()) known.insert(name);
    }
    if (kept) {
      run = run_of(*kept, asked);
      if (!is_of_today(*frozen, one.scene, equivalences)) ++aged;
      if (result && hash_of(*result) != kept->state_hash) ++others;
    } else if (result) {
      run = run_of(*result, asked);
    } else {
      run.value.resize(asked.size());
      run.failure = failure_of(root, one.id);
    }
    run.packing = seed;
    found->runs.push_back(std::move(run));
  }
  if (frozen)
    all.remarks.push_back(fmt::format("reference: frozen, {} runs, made with {}; own error: {}", frozen->runs.size(),
                                      frozen->made_with, frozen->own_error));
  if (aged > 0)
    all.remarks.push_back(
        fmt::format("{} of the reference's runs were frozen with other versions of the numerics than "
                    "today's: run them again and freeze them anew",
                    aged));
  if (others > 0)
    all.remarks.push_back(
        fmt::format("{} of the reference's runs here end in another state than the frozen ones: other "
                    "numerics or another machine",
                    others));
  base::Problems problems;
  for (const std::string& metric : study.trade->metrics) {
    if (finished == 0 || std::ranges::any_of(known, [&](const auto& name) { return store::means(metric, name); }))
      continue;
    problems.push_back({study.trade->kind == study::TradeKind::frontier ? "/frontier/of" : "/ablate/of",
                        fmt::format("no finished case has a metric \"{}\"", metric),
                        "a metric that `runner show` lists", study::nearest(metric, {known.begin(), known.end()})});
  }
  if (!problems.empty()) throw study::BadInput(study.file.string(), std::move(problems));
  return all;
}

}  // namespace

Traded traded(const study::Study& study, const std::filesystem::path& root) {
  const auto frozen = study::read_frozen(study::frozen_path(study.file, study.name));
  return traded(study, root, frozen ? &*frozen : nullptr);
}

std::filesystem::path freeze(const study::Study& study, const std::filesystem::path& root) {
  if (study.trade->against.empty())
    throw UsageError("--freeze: the study compares with exact values, not with a variant");
  study::Frozen frozen{study.trade->against, "", "", {}};
  for (const study::Case& one : study.cases) {
    const auto is_reference = [&](const auto& label) {
      return label.first == study::kVariant && label.second == frozen.variant;
    };
    if (std::ranges::none_of(one.labels, is_reference)) continue;
    const auto result = store::read_finished(root, one.id, true);
    if (!result) throw UsageError(fmt::format("--freeze: case {} of the reference is not completed", one.id));
    const store::Provenance& made = result->manifest.provenance;
    if (frozen.made_with.empty())
      frozen.made_with =
          fmt::format("{}, {}, {}, commit {}{}, {}", made.compiler, made.flags, made.host_cpu, made.commit,
                      made.dirty ? " with changes" : "", numerics_text(result->manifest.header.numerics));
    study::FrozenRun run{
        one.id, result->manifest.seal, hash_of(*result), made.cpu_seconds, made.peak_memory_mb, steps_of(*result), {}};
    for (const auto& [name, value] : finite_metrics(*result))
      if (std::ranges::any_of(study.trade->metrics, [&](const auto& asked) { return store::means(asked, name); }))
        run.metrics.emplace_back(name, value);
    frozen.runs.push_back(std::move(run));
  }
  frozen.own_error = present::own_error(traded(study, root, nullptr).groups);
  const std::filesystem::path file = study::frozen_path(study.file, study.name);
  store::make_folder(file.parent_path());
  store::write_text(file, study::frozen_text(study.name, frozen));
  return file;
}

}  // namespace seapile::commands
