#include "runner/commands/claimed.h"

#include <fmt/format.h>

#include "runner/study/unit.h"

namespace seapile::commands {
namespace {

present::Compared compared(study::Compared compared) {
  switch (compared) {
    case study::Compared::ratio:
      return present::Compared::ratio;
    case study::Compared::difference:
      return present::Compared::difference;
    case study::Compared::value:
      break;
  }
  return present::Compared::value;
}

/// The claim without its cases, its numbers in the metric's unit.
present::Claimed head(const study::Claim& claim, std::size_t place, const CheckedCases& cases,
                      base::Problems& problems) {
  present::Claimed head;
  head.place = place;
  head.number = claim.number;
  head.text = claim.text;
  head.metric = claim.metric;
  head.compared = compared(claim.compared);
  head.side = claim.at_least ? present::Side::above : present::Side::below;
  head.deterministic = claim.deterministic;
  head.expect = claim.expect;
  const bool ratio = claim.compared == study::Compared::ratio;
  head.unit = ratio ? "-" : cases.unit(claim);
  const auto in_unit = [&](double number) {
    if (ratio) return number;
    const study::UnitResult converted = study::convert({number, claim.unit}, head.unit);
    if (!converted.problem.empty() && (problems.empty() || !problems.back().pointer.starts_with(claim.pointer + "/")))
      problems.push_back({claim.pointer + (claim.at_least ? "/at_least" : "/at_most"), converted.problem,
                          fmt::format("a unit of {}, which is in {}", claim.metric, head.unit), ""});
    return converted.value;
  };
  head.bound = in_unit(claim.bound);
  head.margin = in_unit(claim.margin);
  return head;
}

}  // namespace

std::vector<present::Claimed> claimed(const study::Study& study, const CheckedCases& cases) {
  std::vector<present::Claimed> rows;
  base::Problems problems;
  for (std::size_t k = 0; k < study.claims.size(); ++k) {
    const study::Claim& claim = study.claims[k];
    const auto value = [&](std::size_t i) -> std::optional<double> {
      const simulation::Metric* metric = cases.metric(i, claim.metric);
      return metric ? std::optional(metric->value) : std::nullopt;
    };
    const present::Claimed all = head(claim, k + 1, cases, problems);
    for (const study::ClaimRow& of_study : claim.rows) {
      present::Claimed& row = rows.emplace_back(all);
      row.common = of_study.common;
      row.of = of_study.of;
      row.over = of_study.over;
      for (const study::ClaimPair& pair : of_study.packings)
        row.packings.emplace_back(value(pair.of), pair.over ? value(*pair.over) : std::nullopt);
    }
  }
  if (!problems.empty()) throw study::BadInput(study.file.string(), std::move(problems));
  return rows;
}

}  // namespace seapile::commands
