#include "runner/study/check.h"

#include <fmt/format.h>

#include "runner/study/check_grammar.h"
#include "runner/study/reference_file.h"
#include "runner/study/study.h"

namespace seapile::study {
namespace {

/// A value of a check before its cases are known.
struct Row {
  Match which;
  Reference reference;
};

std::vector<Row> rows_of(const CheckText& text, const std::filesystem::path& folder, Check& check,
                         base::Problems& problems) {
  if (text.file.empty()) {
    check.source = text.source;
    return {{{}, {text.value, text.tolerance, text.at_least, text.at_most, text.unit, "", "", {}}}};
  }
  base::Problems in_file;
  ReferenceFile file = read_reference(folder, text.file, text.metric, in_file);
  for (auto& problem : in_file) {
    problem.pointer = check.pointer + "/reference";
    problems.push_back(std::move(problem));
  }
  check.source = fmt::format("{} ({})", file.source, text.file);
  std::vector<Row> rows;
  for (ReferenceRow& row : file.rows) {
    rows.push_back({std::move(row.which),
                    {row.value,
                     row.tolerance,
                     {},
                     {},
                     file.unit,
                     row.reason,
                     fmt::format("\"{}\" line {}", text.file, row.line),
                     {}}});
  }
  return rows;
}

/// Where nothing matches: the row of a file, else the condition, which is what limits the cases of a value in the
/// study.
base::Problem no_case(const CheckText& text, const Check& check, const Reference& reference) {
  const std::string place = text.which ? pointer(text.which->place) : check.pointer;
  return {text.file.empty() ? place : check.pointer + "/reference",
          reference.place.empty() ? "matches no case" : reference.place + ": matches no case", "values that a case has",
          ""};
}

}  // namespace

std::vector<Check> find_checks(const std::vector<CheckText>& texts, const std::filesystem::path& folder,
                               const std::vector<Case>& cases, bool all_match, base::Problems& problems) {
  std::vector<ResolvedScene> scenes;
  for (const Case& one : cases) {
    if (!texts.empty()) scenes.push_back(resolve_used(one.scene));
  }
  std::vector<Check> checks;
  for (const CheckText& text : texts) {
    Check check{pointer(text.place), text.metric, "", text.drift, {}};
    for (Row& row : rows_of(text, folder, check, problems)) {
      for (std::size_t i = 0; i < scenes.size(); ++i) {
        const bool matches = holds(row.which, scenes[i]) && (!text.which || holds(*text.which, scenes[i]));
        if (matches) row.reference.cases.push_back(i);
      }
      if (!row.reference.cases.empty()) {
        check.references.push_back(std::move(row.reference));
      } else if (all_match) {
        problems.push_back(no_case(text, check, row.reference));
      }
    }
    checks.push_back(std::move(check));
  }
  return checks;
}

}  // namespace seapile::study
