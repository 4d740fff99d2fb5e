#include "runner/commands/packings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runner/present/replicates.h"
#include "runner/store/finished.h"
#include "runner/study/nearest.h"

namespace seapile::commands {
namespace {

using Finished = std::vector<store::FinishedCase>;  // packings of one case, in their order

/// `without`: a case that lacks the metric; another one may have it, where the name is right.
base::Problem no_metric(const std::string& rule, const std::vector<Finished>& cases, const std::string& without) {
  std::vector<std::string> names;
  for (const Finished& packings : cases) {
    for (std::string& name : packings.front().metric_names()) names.push_back(std::move(name));
  }
  const bool known = std::ranges::any_of(names, [&](const std::string& name) { return store::means(rule, name); });
  if (!known) {
    return {"/replicates/metric", fmt::format("no finished case has a metric \"{}\"", rule),
            "a metric that `runner show` lists", study::nearest(rule, names)};
  }
  return {"/replicates/metric",
          fmt::format("\"{}\" is no number in every packing{}{}", rule, without.empty() ? "" : " of ", without),
          "a metric that every case has", ""};
}

/// The metrics that the rule means and that are numbers in every packing: a bin that a drive does not reach is none.
std::vector<std::vector<double>> values_of(const std::string& rule, const Finished& packings) {
  std::vector<std::vector<double>> all;
  for (const std::string& name : packings.front().metric_names()) {
    if (!store::means(rule, name)) continue;
    std::vector<double> values;
    for (const store::FinishedCase& one : packings) {
      const simulation::Metric* metric = one.metric(name);
      if (metric && std::isfinite(metric->value)) values.push_back(metric->value);
    }
    if (values.size() == packings.size()) all.push_back(std::move(values));
  }
  return all;
}

std::string line_of(const present::Labels& labels) {
  std::string line;
  for (const auto& [path, value] : labels) line += fmt::format("{}{}={}", line.empty() ? "" : ", ", path, value);
  return line;
}

}  // namespace

present::PackingsAsked packings_asked(const study::PackingRule& rule) {
  return {rule.metric, rule.half_width, static_cast<std::size_t>(rule.at_most)};
}

std::optional<present::PackingRound> packing_round(const study::Study& study, const std::filesystem::path& root) {
  const study::PackingRule& rule = study.packing_rule.value();
  std::vector<present::Labels> cases;
  std::vector<Finished> finished;
  for (const study::Case& one : study.cases) {
    present::Labels labels = one.labels;
    std::erase_if(labels, [](const auto& label) { return label.first == present::kSeed; });
    auto read = store::read_finished(root, one.id, rule.metric.starts_with(store::kOfBed));
    if (!read) return {};
    const auto at = static_cast<std::size_t>(std::ranges::find(cases, labels) - cases.begin());
    if (at == cases.size()) {
      cases.push_back(std::move(labels));
      finished.emplace_back();
    }
    finished[at].push_back(*std::move(read));
  }
  std::vector<present::PackingsOfCase> packings;
  base::Problems problems;
  std::size_t most = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    most = std::max(most, finished[i].size());
    packings.push_back({cases[i], values_of(rule.metric, finished[i])});
    if (packings.back().values.empty() && problems.empty())
      problems.push_back(no_metric(rule.metric, finished, line_of(cases[i])));
  }
  if (!problems.empty()) throw study::BadInput(study.file.string(), std::move(problems));
  return present::next_round(packings, most, packings_asked(rule));
}

study::Study read_settled(const std::filesystem::path& file, study::Options options,
                          const std::filesystem::path& root) {
  for (;;) {
    study::Study study = study::read(file, options);
    if (!study.packing_rule) return study;
    const auto round = packing_round(study, root);
    if (!round || round->next == round->packings) return study;
    options.packings = static_cast<std::int64_t>(round->next);
  }
}

}  // namespace seapile::commands
