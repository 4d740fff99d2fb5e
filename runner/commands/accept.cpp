#include "runner/commands/accept.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/plan.h"
#include "runner/store/durable.h"
#include "runner/study/csv.h"
#include "runner/study/problem_text.h"

namespace seapile::commands {
namespace {

/// What is to be accepted. Empty when the id is none of a checked case.
std::vector<Watched> chosen(const study::Study& study, const CheckedCases& cases, const std::string& id) {
  if (id == "all") return cases.watched();
  std::vector<Watched> those;
  std::set<std::string> ids;
  for (const study::Case& one : study.cases) {
    if (one.id.starts_with(id)) ids.insert(one.id);
  }
  if (ids.size() > 1) {
    throw UsageError(fmt::format("\"{}\" begins several case ids, among them {} and {}", id,
                                 execute::short_id(*ids.begin()), execute::short_id(*std::next(ids.begin()))));
  }
  std::ranges::copy_if(cases.watched(), std::back_inserter(those),
                       [&](const Watched& watched) { return ids.contains(study.cases[watched.study_case].id); });
  return those;
}

}  // namespace

int accept_values(const study::Study& study, const CheckedCases& cases, const std::string& id,
                  const std::string& note) {
  if (study::trimmed(note).empty() || !study::is_printable(note))
    throw UsageError("--note: is no line of text; allowed: why the value is right");
  const std::vector<Watched> those = chosen(study, cases, id);
  if (those.empty()) {
    fmt::print(stderr, "no checked case of the study has an id that begins with {}\n", id);
    return execute::kNothingMatched;
  }
  const std::filesystem::path file = study::accepted_path(study);
  std::vector<study::AcceptedValue> values = study::read_accepted(file);
  for (const Watched& watched : those) {
    const study::Case& one = study.cases[watched.study_case];
    const simulation::Metric* metric = cases.metric(watched.study_case, watched.metric);
    if (!metric || !std::isfinite(metric->value)) {
      fmt::print(stderr, "case {} has no completed result with {}: nothing was accepted\n", execute::short_id(one.id),
                 watched.metric);
      return execute::kNothingMatched;
    }
    const store::Manifest& manifest = cases.finished(watched.study_case)->manifest;
    study::accept(values, {one.id, watched.metric, metric->value, metric->unit, watched.drift, manifest.run,
                           numerics_text(manifest.header.numerics), std::string(study::trimmed(note))});
  }
  store::make_folder(file.parent_path());
  store::write_text(file, study::accepted_text(values));
  for (const Watched& watched : those) {
    const std::string& id_of_case = study.cases[watched.study_case].id;
    const study::AcceptedValue* value = study::find_accepted(values, id_of_case, watched.metric);
    fmt::print("accepted  {} of case {}: {} {}\n", watched.metric, execute::short_id(id_of_case), value->value,
               value->unit);
  }
  fmt::print("{}\n", file.string());
  return execute::kDone;
}

}  // namespace seapile::commands
