#include "runner/commands/edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "runner/execute/campaign.h"
#include "runner/store/finished.h"
#include "runner/study/nearest.h"

namespace seapile::commands {
namespace {

/// What a completed run breaks first; "": nothing.
std::string broken(const study::Study& study, const store::FinishedCase& run) {
  for (std::size_t i = 0; i < study.edge->invariants.size(); ++i) {
    const study::Invariant& invariant = study.edge->invariants[i];
    const simulation::Metric* metric = run.metric(invariant.metric);
    if (!metric)
      throw study::BadInput(
          study.file.string(),
          {{fmt::format("/edge/invariants/{}/metric", i),
            fmt::format("a completed run has no metric \"{}\"", invariant.metric), "a metric that `runner show` lists",
            study::nearest(invariant.metric, run.metric_names())}});
    const double value = metric->value;
    if (invariant.at_most && !(value <= *invariant.at_most))
      return fmt::format("{} is {:.4g}, more than {:g}", invariant.metric, value, *invariant.at_most);
    if (invariant.at_least && !(value >= *invariant.at_least))
      return fmt::format("{} is {:.4g}, less than {:g}", invariant.metric, value, *invariant.at_least);
  }
  return "";
}

/// Whether what a run came to is what today's numerics would have come to, as a plan would say it.
bool counts(const store::Manifest& manifest, const study::Case& one, const execute::Equivalences& equivalences) {
  const store::RunHeader& header = manifest.header;
  if (execute::are_of_today(header.numerics, one.scene)) return true;
  return manifest.result.outcome == simulation::Outcome::completed &&
         execute::declared(equivalences, header.kind, header.numerics, execute::todays_numerics(one.scene)) != nullptr;
}

present::EdgeProbe probe_of(const study::Study& study, const study::Case& one, const std::filesystem::path& root,
                            const execute::Equivalences& equivalences) {
  present::EdgeProbe probe;
  probe.value = one.probe.value();
  const auto folder = store::newest_run(root, one.id);
  if (folder.empty()) return probe;
  const store::FinishedCase run{store::read_manifest(folder), {}};
  // What other numerics came to says nothing of today's, unless a probe has shown that it does.
  if (!counts(run.manifest, one, equivalences)) return probe;
  const simulation::RunResult& result = run.manifest.result;
  probe.finished = result.outcome != simulation::Outcome::stopped;
  if (result.outcome == simulation::Outcome::completed) probe.tripped = broken(study, run);
  if (result.outcome == simulation::Outcome::diverged) probe.tripped = result.reason;
  return probe;
}

/// The labels of the other axes.
present::Labels without_probe(const study::Study& study, present::Labels labels) {
  std::erase_if(labels, [path = study::join_path(study.edge->path)](const auto& l) { return l.first == path; });
  return labels;
}

std::size_t combination_of(const study::Study& study, const present::EdgeSearch& search) {
  return std::ranges::find(study.cases, search.labels,
                           [&](const study::Case& one) { return without_probe(study, one.labels); })
      ->combination;
}

/// The entry of a combination; those up to it come into being.
std::vector<double>& at(std::vector<std::vector<double>>& probes, std::size_t combination) {
  if (combination >= probes.size()) probes.resize(combination + 1);
  return probes[combination];
}

}  // namespace

std::vector<present::EdgeSearch> edge_searches(const study::Study& study, const std::filesystem::path& root) {
  const study::Edge& edge = study.edge.value();
  const execute::Equivalences equivalences = execute::declared_equivalences(root);
  std::vector<present::EdgeSearch> searches;
  const std::string path = study::join_path(edge.path);
  for (const study::Case& one : study.cases) {
    const present::Labels labels = without_probe(study, one.labels);
    auto found = std::ranges::find(searches, labels, &present::EdgeSearch::labels);
    if (found == searches.end()) {
      found = searches.insert(searches.end(), present::EdgeSearch{labels,
                                                                  path,
                                                                  std::string(edge.node->field.unit),
                                                                  edge.good,
                                                                  edge.bad,
                                                                  edge.within,
                                                                  edge.node->kind == study::SchemaNode::Kind::integer,
                                                                  {}});
    }
    found->probes.push_back(probe_of(study, one, root, equivalences));
  }
  return searches;
}

std::vector<std::vector<double>> untried_probes(const study::Study& study,
                                                const std::vector<present::EdgeSearch>& searches) {
  std::vector<std::vector<double>> untried;
  bool any = false;
  for (const present::EdgeSearch& search : searches) {
    for (const present::EdgeProbe& probe : search.probes) {
      if (probe.finished) continue;
      at(untried, combination_of(study, search)).push_back(probe.value);
      any = true;
    }
  }
  if (!any) untried.clear();
  return untried;
}

std::vector<std::vector<double>> next_probes(const study::Study& study,
                                             const std::vector<present::EdgeSearch>& searches) {
  std::vector<std::vector<double>> probes;
  bool any = false;
  for (const present::EdgeSearch& search : searches) {
    auto& values = at(probes, combination_of(study, search));
    for (const present::EdgeProbe& probe : search.probes) values.push_back(probe.value);
    for (const double value : present::judge(search).next) {
      if (std::ranges::find(values, value) != values.end()) continue;
      values.push_back(value);
      any = true;
    }
  }
  if (!any) probes.clear();
  return probes;
}

study::Study searched(const std::string& file, study::Options& options, const std::filesystem::path& root) {
  for (;;) {
    study::Study study = study::read(file, options);
    const auto searches = edge_searches(study, root);
    if (!untried_probes(study, searches).empty()) return study;
    auto probes = next_probes(study, searches);
    if (probes.empty()) return study;
    options.probes = std::move(probes);
  }
}

}  // namespace seapile::commands
