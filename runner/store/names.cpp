#include "runner/store/names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "runner/store/catalogue.h"
#include "runner/store/parameters.h"

namespace seapile::store {

namespace {

using Texts = std::vector<std::string>;

constexpr const char* kBedCase = "bed:case";

Texts texts(SQLite::Database& sqlite, const std::string& question) {
  Texts all;
  SQLite::Statement statement(sqlite, question);
  while (statement.executeStep()) all.push_back(statement.getColumn(0).getString());
  return all;
}

/// Every value of an index's first column once, from one to the next: SELECT DISTINCT would read all rows. `where` is
/// that of the index.
void add_distinct(SQLite::Database& sqlite, const char* column, const char* table, const char* where,
                  std::set<std::string>& into) {
  SQLite::Statement next(
      sqlite, fmt::format("SELECT {0} FROM {1} WHERE {0} > ? AND {2} ORDER BY {0} LIMIT 1", column, table, where));
  std::string last;
  next.bind(1, last);
  while (next.executeStep()) {
    last = next.getColumn(0).getString();
    into.insert(last);
    next.reset();
    next.bind(1, last);
  }
}

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

/// The end of a path that has so many dots; all of it where it has fewer.
std::string ending(const std::string& path, std::ptrdiff_t dots) {
  auto at = path.rfind('.');
  for (; at != path.npos && at > 0 && dots > 0; --dots) at = path.rfind('.', at - 1);
  return at == path.npos ? path : path.substr(at + 1);
}

/// Whether a case of the study has the parameter, or a part of that path.
bool has(SQLite::Database& sqlite, const std::string& study, const std::string& path) {
  SQLite::Statement statement(
      sqlite,
      "SELECT 1 FROM study s JOIN study_case sc ON sc.study_id = s.study_id WHERE s.name = ?1 AND "
      "(EXISTS (SELECT 1 FROM param WHERE case_id = sc.case_id AND path = ?2) OR "
      "EXISTS (SELECT 1 FROM param WHERE case_id = sc.case_id AND path > ?2 || '.' AND path < ?2 || '/')) LIMIT 1");
  statement.bind(1, study);
  statement.bind(2, path);
  return statement.executeStep();
}

}  // namespace

std::string Name::metric() const { return subject == Subject::bed_metric ? text.substr(kOfBed.size()) : text; }

void refuse_unknown(const std::string& what, const std::string& name, const Texts& known) {
  const auto nearest = std::ranges::min_element(known, {}, [&](const auto& k) {
    return std::min(edit_distance(name, k), edit_distance(name, ending(k, std::ranges::count(name, '.'))));
  });
  throw std::invalid_argument(fmt::format("there is no {} \"{}\"{}", what, name,
                                          nearest == known.end() ? "" : "; the nearest is \"" + *nearest + "\""));
}

Texts study_names(SQLite::Database& sqlite) { return texts(sqlite, "SELECT name FROM study ORDER BY name"); }

Names::Names(SQLite::Database& sqlite) : sqlite_(sqlite) {
  for (const char* where : {"num IS NOT NULL", "txt IS NOT NULL", "num IS NULL AND txt IS NULL"}) {
    add_distinct(sqlite, "path", "param", where, places_);
  }
  add_distinct(sqlite, "name", "metric", "TRUE", metrics_);
  // A part by itself has no row, but its members have.
  const std::vector<std::string> paths(places_.begin(), places_.end());
  for (const std::string& path : paths) {
    for (auto dot = path.find('.'); dot != path.npos; dot = path.find('.', dot + 1)) {
      places_.insert(path.substr(0, dot));
    }
  }
}

/// Looked for among the beds: of a drive's metric, all runs would be looked at in vain.
bool Names::is_of_beds(const std::string& metric) const {
  SQLite::Statement statement(sqlite_,
                              "SELECT 1 FROM kase k CROSS JOIN run r ON r.case_id = k.case_id "
                              "CROSS JOIN metric m ON m.run_id = r.run_id AND m.name = ? WHERE k.kind = 'bed' LIMIT 1");
  statement.bind(1, metric);
  return statement.executeStep();
}

Name Names::find(const std::string& text, const std::string& study) const {
  if (text == "outcome") return {Subject::outcome, text};
  if (text == "kind") return {Subject::kind, text};
  if (text == "study") return {Subject::study, text};
  if (text == kBedCase) return {Subject::bed_case, text};
  if (text.starts_with(kOfBed)) {
    const Name name{Subject::bed_metric, text};
    if (metrics_.contains(name.metric()) && is_of_beds(name.metric())) return name;
  }
  if (places_.contains(text)) return {Subject::parameter, text};
  if (metrics_.contains(text)) return {Subject::metric, text};

  Texts found;
  std::ranges::copy_if(places_, std::back_inserter(found),
                       [&](const std::string& path) { return path.ends_with("." + text); });
  if (found.size() > 1 && !study.empty()) {
    Texts of_study;
    std::ranges::copy_if(found, std::back_inserter(of_study),
                         [&](const std::string& path) { return has(sqlite_, study, path); });
    if (!of_study.empty()) found = of_study;
  }
  if (found.size() == 1) return {Subject::parameter, found[0]};
  if (!found.empty()) {
    throw std::invalid_argument(
        fmt::format("\"{}\" may be any of {}: write more of the path", text, fmt::join(found, ", ")));
  }
  Texts known(places_.begin(), places_.end());
  for (const std::string& metric : metrics_) {
    known.push_back(metric);
    if (is_of_beds(metric)) known.push_back(std::string(kOfBed) + metric);
  }
  known.insert(known.end(), {"outcome", "kind", "study", kBedCase});
  refuse_unknown("parameter or metric", text, known);
}

std::string Names::unit(const Name& name) const {
  if (name.subject == Subject::parameter) {
    const auto found = parameter_units().find(name.text);
    return found == parameter_units().end() ? "" : found->second;
  }
  if (!name.is_metric()) return "";
  SQLite::Statement unit(
      sqlite_, name.subject == Subject::metric
                   ? "SELECT unit FROM metric WHERE name = ? ORDER BY value DESC, run_id DESC LIMIT 1"
                   : "SELECT m.unit FROM kase k CROSS JOIN run r ON r.case_id = k.case_id "
                     "CROSS JOIN metric m ON m.run_id = r.run_id AND m.name = ? WHERE k.kind = 'bed' LIMIT 1");
  unit.bind(1, name.metric());
  return unit.executeStep() ? unit.getColumn(0).getString() : "";
}

}  // namespace seapile::store
