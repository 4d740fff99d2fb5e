#include "runner/store/clause.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace seapile::store {

namespace {

using Op = Condition::Op;

bool has_text(SQLite::Database& sqlite, const std::string& path) {
  SQLite::Statement statement(sqlite, "SELECT 1 FROM param WHERE path = ? AND txt IS NOT NULL LIMIT 1");
  statement.bind(1, path);
  return statement.executeStep();
}

/// A condition that is tested as it is found by.
Clause plain(const std::string& text, std::vector<Cell> values) { return {text, text, std::move(values)}; }

/// On what every run has: a text, = or !=.
Clause of_run(SQLite::Database& sqlite, const Name& name, const Condition& condition) {
  // The first digits of a case id may look like a number: "4120392".
  const bool is_digits = name.subject == Subject::bed_case && std::holds_alternative<double>(condition.value);
  const auto* text = is_digits ? &condition.written : std::get_if<std::string>(&condition.value);
  if (text == nullptr) throw std::invalid_argument(name.text + " is a text");
  const bool equal = condition.op == Op::equal;
  const std::string in = equal ? "r.case_id IN (" : "r.case_id NOT IN (";
  switch (name.subject) {
    case Subject::kind:
      return {fmt::format("k.kind {} ?", sql(condition.op)), fmt::format("+k.kind {} ?", sql(condition.op)), {*text}};
    case Subject::study: {
      const auto known = study_names(sqlite);
      if (std::ranges::find(known, *text) == known.end()) refuse_unknown("study", *text, known);
      return plain(
          in + "SELECT sc.case_id FROM study s JOIN study_case sc ON sc.study_id = s.study_id WHERE s.name = ?)",
          {*text});
    }
    case Subject::bed_case:
      // Behind the last hex digit comes "g".
      if (text->empty()) throw std::invalid_argument(name.text + " is a case id, or how one begins");
      return plain((equal ? "" : "k.bed_id IS NOT NULL AND ") + in +
                       "SELECT case_id FROM kase WHERE bed_id >= ? AND bed_id < ? || 'g')",
                   {*text, *text});
    default:
      return {
          fmt::format("r.outcome {} ?", sql(condition.op)), fmt::format("+r.outcome {} ?", sql(condition.op)), {*text}};
  }
}

Clause of_metric(const Name& name, const Condition& condition) {
  const bool own = name.subject == Subject::metric;
  const std::string rows =
      own ? "r.run_id IN (SELECT run_id FROM metric WHERE name = ? AND value "
          : fmt::format("r.run_id IN (SELECT d.run_id {}WHERE m.name = ? AND m.value ", kMetricsOfBed);
  const std::string row = own ? "EXISTS (SELECT 1 FROM metric WHERE run_id = r.run_id AND name = ? AND value " : rows;
  if (const auto* number = std::get_if<double>(&condition.value)) {
    const std::string end = std::string(sql(condition.op)) + " ?)";
    return {rows + end, row + end, {name.metric(), *number}, own && condition.op != Op::not_equal};
  }
  if (const auto* text = std::get_if<std::string>(&condition.value)) {
    throw std::invalid_argument(name.text + " is a number, in SI units; \"" + *text + "\" is none");
  }
  const std::string negation = condition.op == Op::equal ? "NOT " : "";
  return {negation + rows + "IS NOT NULL)", negation + row + "IS NOT NULL)", {name.metric()}};
}

Clause of_parameter(SQLite::Database& sqlite, const Name& name, const Condition& condition) {
  const auto compare = [&](const char* column, const Cell& value) -> Clause {
    const std::string end = fmt::format("path = ? AND {} {} ?)", column, sql(condition.op));
    return {"r.case_id IN (SELECT case_id FROM param WHERE " + end,
            "EXISTS (SELECT 1 FROM param WHERE case_id = r.case_id AND " + end,
            {name.text, value}};
  };
  if (const auto* number = std::get_if<double>(&condition.value)) return compare("num", *number);
  if (const auto* text = std::get_if<std::string>(&condition.value)) {
    const bool ordered = condition.op != Op::equal && condition.op != Op::not_equal;
    if (ordered || !has_text(sqlite, name.text)) {
      throw std::invalid_argument(name.text + " is a " +
                                  (has_text(sqlite, name.text) ? "text" : "number, in SI units") + "; \"" + *text +
                                  (ordered ? "\" has no order" : "\" is none"));
    }
    return compare("txt", *text);
  }
  // Asked of each run by itself: a part has many members, and all runs may have it.
  return plain(
      std::string(condition.op == Op::equal ? "NOT " : "") +
          "(EXISTS (SELECT 1 FROM param WHERE case_id = r.case_id AND path = ? AND (num IS NOT NULL OR txt IS NOT "
          "NULL)) OR EXISTS (SELECT 1 FROM param WHERE case_id = r.case_id AND path > ? || '.' AND path < ? || '/'))",
      {name.text, name.text, name.text});
}

Clause of_condition(SQLite::Database& sqlite, const Names& names, const std::string& study,
                    const Condition& condition) {
  const Name name = names.find(condition.path, study);
  if (name.is_metric()) return of_metric(name, condition);
  if (name.subject == Subject::parameter) return of_parameter(sqlite, name, condition);
  return of_run(sqlite, name, condition);
}

}  // namespace

Clause clause_of(SQLite::Database& sqlite, const Names& names, const std::string& study, const Expression& expression) {
  if (expression.kind == Expression::Kind::condition) {
    return of_condition(sqlite, names, study, expression.condition);
  }
  std::vector<Clause> parts;
  for (const Expression& part : expression.parts) parts.push_back(clause_of(sqlite, names, study, part));
  if (parts.empty()) return plain("TRUE", {});

  // Of several that all have to hold, a narrow one finds the runs and the others are asked of those.
  const bool all = expression.kind == Expression::Kind::all;
  const auto finder = all ? std::ranges::find_if(parts, &Clause::is_narrow) : parts.end();
  Clause clause;
  clause.is_narrow = finder != parts.end();
  const char* between = expression.kind == Expression::Kind::any ? " OR " : " AND ";
  for (auto part = parts.begin(); part != parts.end(); ++part) {
    const bool tests = finder != parts.end() && part != finder;
    const std::string joint = clause.text.empty() ? "(" : between + std::string("(");
    clause.text += joint + (tests ? part->test : part->text) + ")";
    clause.test += joint + part->test + ")";
    clause.values.insert(clause.values.end(), part->values.begin(), part->values.end());
  }
  if (expression.kind == Expression::Kind::negation) {
    clause.text = "NOT (" + clause.text + ")";
    clause.test = "NOT (" + clause.test + ")";
  }
  return clause;
}

}  // namespace seapile::store
