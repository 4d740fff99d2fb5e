#include "runner/commands/checked.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runner/study/nearest.h"
#include "runner/study/unit.h"

namespace seapile::commands {

namespace {

/// What each check and each claim needs.
std::vector<Asked> asked_by(const std::vector<study::Check>& checks) {
  std::vector<Asked> all;
  for (const study::Check& check : checks) {
    Asked& asked = all.emplace_back(Asked{check.pointer, check.metric, {}});
    for (const study::Reference& reference : check.references)
      asked.cases.insert(asked.cases.end(), reference.cases.begin(), reference.cases.end());
  }
  return all;
}

std::vector<Asked> asked_by(const std::vector<study::Claim>& claims) {
  std::vector<Asked> all;
  for (const study::Claim& claim : claims) {
    Asked& asked = all.emplace_back(Asked{claim.pointer, claim.metric, {}});
    for (const study::ClaimRow& row : claim.rows) {
      for (const study::ClaimPair& pair : row.packings) {
        asked.cases.push_back(pair.of);
        if (pair.over) asked.cases.push_back(*pair.over);
      }
    }
  }
  return all;
}

}  // namespace

CheckedCases::CheckedCases(const study::Study& study, const std::filesystem::path& root)
    : study_(study), checks_(asked_by(study.checks)), claims_(asked_by(study.claims)) {
  const auto of_bed = [](const Asked& asked) { return asked.metric.starts_with(store::kOfBed); };
  const bool with_bed = std::ranges::any_of(checks_, of_bed) || std::ranges::any_of(claims_, of_bed);
  for (const auto* all : {&checks_, &claims_}) {
    for (const Asked& asked : *all) {
      for (const std::size_t i : asked.cases) {
        if (!cases_.contains(i)) cases_[i] = store::read_finished(root, study.cases[i].id, with_bed);
      }
    }
  }
  std::map<std::pair<std::string, std::size_t>, std::size_t> places;
  for (std::size_t k = 0; k < checks_.size(); ++k) {
    for (const std::size_t i : checks_[k].cases) {
      const double drift = study.checks[k].drift;
      const auto [place, first] = places.try_emplace({checks_[k].metric, i}, watched_.size());
      if (first) watched_.push_back({checks_[k].metric, i, drift});
      watched_[place->second].drift = std::min(watched_[place->second].drift, drift);
    }
  }
  refuse_unknown_metrics();
}

/// A name that no finished case knows is misspelt; one that only some know is of newer or older runs.
void CheckedCases::refuse_unknown_metrics() const {
  base::Problems problems;
  for (const auto* all : {&checks_, &claims_}) {
    for (const Asked& asked : *all) {
      std::vector<std::string> names;
      for (const std::size_t i : asked.cases) {
        if (!finished(i)) continue;
        for (const std::string& name : finished(i)->metric_names()) {
          if (std::ranges::find(names, name) == names.end()) names.push_back(name);
        }
      }
      if (names.empty() || std::ranges::find(names, asked.metric) != names.end()) continue;
      problems.push_back({asked.pointer + "/metric", fmt::format("no finished case has a metric \"{}\"", asked.metric),
                          "a metric that `runner show` lists", study::nearest(asked.metric, names)});
    }
  }
  if (!problems.empty()) throw study::BadInput(study_.file.string(), std::move(problems));
}

const store::FinishedCase* CheckedCases::finished(std::size_t study_case) const {
  const auto found = cases_.find(study_case);
  return found == cases_.end() || !found->second ? nullptr : &*found->second;
}

const simulation::Metric* CheckedCases::metric(std::size_t study_case, const std::string& name) const {
  const store::FinishedCase* one = finished(study_case);
  return one ? one->metric(name) : nullptr;
}

/// The unit that the store has the metric in; before any case is finished that of the study is as good.
std::string CheckedCases::unit(const Asked& asked, const std::string& as_written) const {
  for (const std::size_t i : asked.cases) {
    if (const simulation::Metric* found = metric(i, asked.metric)) return found->unit;
  }
  return as_written;
}

std::string CheckedCases::unit(const study::Claim& claim) const {
  const auto asked = std::ranges::find(claims_, claim.pointer, &Asked::pointer);
  return asked == claims_.end() ? claim.unit : unit(*asked, claim.unit);
}

present::Measured CheckedCases::measured(std::size_t study_case, const std::string& name) const {
  const study::Case& one = study_.cases[study_case];
  const simulation::Metric* found = metric(study_case, name);
  return {one.id, one.labels, found ? std::optional(found->value) : std::nullopt};
}

std::vector<present::Comparison> CheckedCases::with_published() const {
  std::vector<present::Comparison> comparisons;
  base::Problems problems;
  for (std::size_t k = 0; k < checks_.size(); ++k) {
    const study::Check& check = study_.checks[k];
    const std::string in = unit(checks_[k], check.references.empty() ? "" : check.references.front().unit);
    for (const study::Reference& reference : check.references) {
      std::string misfit;
      const auto in_unit = [&](double number) {
        const study::UnitResult converted = study::convert({number, reference.unit}, in);
        misfit = converted.problem;
        return converted.value;
      };
      present::Comparison one;
      const bool bounds = reference.at_least || reference.at_most;
      if (bounds) {
        one.against = present::Against::bounds;
        if (reference.at_least) one.at_least = in_unit(*reference.at_least);
        if (reference.at_most) one.at_most = in_unit(*reference.at_most);
      } else {
        one.reference = in_unit(reference.value);
        one.tolerance = in_unit(reference.tolerance);
      }
      if (!misfit.empty()) {
        const char* key = reference.at_most ? "/at_most" : reference.at_least ? "/at_least" : "/value";
        problems.push_back({check.pointer + (reference.place.empty() ? key : "/reference"),
                            fmt::format("{}{}{}", reference.place, reference.place.empty() ? "" : ": ", misfit),
                            fmt::format("a unit of {}, which is in {}", check.metric, in), ""});
        continue;
      }
      std::vector<present::Measured> cases;
      for (const std::size_t i : reference.cases) cases.push_back(measured(i, check.metric));
      one.metric = check.metric;
      one.unit = in;
      one.source = check.source;
      one.reason = reference.reason;
      for (auto& comparison : present::over_packings(one, cases)) comparisons.push_back(std::move(comparison));
    }
  }
  if (!problems.empty()) throw study::BadInput(study_.file.string(), std::move(problems));
  return comparisons;
}

std::vector<present::Comparison> CheckedCases::with_accepted(const std::vector<study::AcceptedValue>& accepted) const {
  std::vector<present::Comparison> comparisons;
  base::Problems problems;
  for (const Watched& watched : watched_) {
    const present::Measured one = measured(watched.study_case, watched.metric);
    const simulation::Metric* found = metric(watched.study_case, watched.metric);
    present::Comparison comparison;
    comparison.against = present::Against::accepted;
    comparison.metric = watched.metric;
    comparison.unit = found ? found->unit : "";
    comparison.case_ids = {one.case_id};
    comparison.labels = one.labels;
    if (one.value) comparison.values = {*one.value};
    if (const auto* known = study::find_accepted(accepted, one.case_id, watched.metric)) {
      if (!found) comparison.unit = known->unit;
      const study::UnitResult value = study::convert({known->value, known->unit}, comparison.unit);
      if (!value.problem.empty()) {
        problems.push_back({fmt::format("{} of case {}", watched.metric, one.case_id), value.problem,
                            fmt::format("a value in {}: accept it again", comparison.unit), ""});
      }
      comparison.reference = value.value;
      comparison.tolerance = known->tolerance * std::abs(value.value);
      comparison.source = fmt::format("run {} with {}", known->run, known->numerics);
      comparison.reason = known->note;
    }
    comparisons.push_back(std::move(comparison));
  }
  if (!problems.empty()) throw study::BadInput(study::accepted_path(study_).string(), std::move(problems));
  return comparisons;
}

std::string numerics_text(const std::vector<simulation::NumericsVersion>& numerics) {
  std::string text;
  for (const auto& [module, version] : numerics)
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", module, version);
  return text;
}

}  // namespace seapile::commands
