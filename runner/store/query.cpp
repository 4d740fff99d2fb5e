#include "runner/store/query.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "runner/store/condition.h"
#include "runner/store/ingest.h"
#include "runner/store/parameters.h"

namespace seapile::store {

namespace {

/// How many metrics a table shows when none are asked for: the solver lists its headline ones first.
constexpr std::size_t kDefaultMetrics = 6;

constexpr const char* kBedCase = "bed:case";

using Texts = std::vector<std::string>;

Texts texts(SQLite::Database& sqlite, const std::string& question) {
  Texts all;
  SQLite::Statement statement(sqlite, question);
  while (statement.executeStep()) all.push_back(statement.getColumn(0).getString());
  return all;
}

bool exists(SQLite::Database& sqlite, const std::string& question, const std::string& name) {
  SQLite::Statement statement(sqlite, question);
  statement.bind(1, name);
  return statement.executeStep();
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

[[noreturn]] void refuse_unknown(const std::string& what, const std::string& name, const Texts& known) {
  const auto nearest = std::ranges::min_element(known, {}, [&](const auto& k) { return edit_distance(name, k); });
  throw std::invalid_argument(fmt::format("there is no {} \"{}\"{}", what, name,
                                          nearest == known.end() ? "" : "; the nearest is \"" + *nearest + "\""));
}

enum class Subject { run_column, parameter, metric, bed_metric };

/// The metric's own name: "solid_fraction" of "bed:solid_fraction".
std::string metric_name(const std::string& name) {
  return name.starts_with(kOfBed) ? name.substr(kOfBed.size()) : name;
}

/// The metrics of beds, for a drive's run d of a case with bed_id: of the very run that it was built on.
constexpr const char* kMetricsOfBed =
    "FROM metric m JOIN run b ON b.run_id = m.run_id JOIN kase c ON c.bed_id = b.case_id "
    "JOIN run d ON d.case_id = c.case_id AND CAST(d.bed_run AS INTEGER) = b.number ";

/// What a name stands for. Throws std::invalid_argument naming the nearest known one.
Subject subject_of(SQLite::Database& sqlite, const std::string& name) {
  if (name == "outcome" || name == "kind" || name == kBedCase) return Subject::run_column;
  const std::string of_beds = "FROM metric JOIN run USING (run_id) JOIN kase USING (case_id) WHERE kind = 'bed'";
  if (name.starts_with(kOfBed) && exists(sqlite, "SELECT 1 " + of_beds + " AND name = ? LIMIT 1", metric_name(name))) {
    return Subject::bed_metric;
  }
  // A part by itself has no row, but its members have.
  if (exists(sqlite, "SELECT 1 FROM param WHERE path = ?1 OR substr(path, 1, length(?1) + 1) = ?1 || '.' LIMIT 1",
             name))
    return Subject::parameter;
  if (exists(sqlite, "SELECT 1 FROM metric WHERE name = ? LIMIT 1", name)) return Subject::metric;
  Texts known = texts(sqlite,
                      "SELECT DISTINCT path FROM param UNION SELECT DISTINCT name FROM metric "
                      "UNION SELECT DISTINCT 'bed:' || name " +
                          of_beds);
  known.insert(known.end(), {"outcome", "kind", kBedCase});
  refuse_unknown("parameter or metric", name, known);
}

/// A piece of a WHERE clause. Names and values are bound; the text holds none of either.
struct Clause {
  std::string text;
  std::vector<Cell> values;
};

Clause clause_of(SQLite::Database& sqlite, const Condition& condition) {
  const std::string op = sql(condition.op);
  const auto* number = std::get_if<double>(&condition.value);
  const auto* text = std::get_if<std::string>(&condition.value);
  const Subject subject = subject_of(sqlite, condition.path);
  if (subject == Subject::run_column) {
    if (text == nullptr) throw std::invalid_argument(condition.path + " is a text");
    const std::string column = condition.path == "kind"     ? "k.kind "
                               : condition.path == kBedCase ? fmt::format("substr(k.bed_id, 1, {}) ", kShownDigits)
                                                            : "r.outcome ";
    return {column + op + " ?", {*text}};
  }
  const bool is_metric = subject != Subject::parameter;
  const std::string rows = subject == Subject::metric ? "r.run_id IN (SELECT run_id FROM metric WHERE name = ? AND "
                           : subject == Subject::bed_metric
                               ? fmt::format("r.run_id IN (SELECT d.run_id {}WHERE m.name = ? AND ", kMetricsOfBed)
                               : "r.case_id IN (SELECT case_id FROM param WHERE path = ? AND ";
  const std::string name = subject == Subject::bed_metric ? metric_name(condition.path) : condition.path;
  if (number != nullptr) return {rows + (is_metric ? "value " : "num ") + op + " ?)", {name, *number}};
  if (text == nullptr) {
    const std::string negated = condition.op == Condition::Op::equal ? "NOT " : "";
    if (is_metric) return {negated + rows + "value IS NOT NULL)", {name}};
    return {negated + "(" + rows + "(num IS NOT NULL OR txt IS NOT NULL)) OR r.case_id IN (SELECT case_id FROM param " +
                "WHERE substr(path, 1, length(?) + 1) = ? || '.'))",
            {name, name, name}};
  }
  const bool has_text =
      !is_metric && exists(sqlite, "SELECT 1 FROM param WHERE path = ? AND txt IS NOT NULL LIMIT 1", condition.path);
  if (!has_text) throw std::invalid_argument(condition.path + " is a number, in SI units; \"" + *text + "\" is none");
  return {rows + "txt " + op + " ?)", {name, *text}};
}

void put_value(SQLite::Statement& statement, int index, const Cell& value) {
  if (const auto* number = std::get_if<double>(&value)) statement.bind(index, *number);
  if (const auto* text = std::get_if<std::string>(&value)) statement.bind(index, *text);
}

Cell cell(const SQLite::Column& column) {
  if (column.isNull()) return std::monostate{};
  if (column.isText()) return column.getString();
  return column.getDouble();
}

/// A column of a parameter, of a metric, or of what every run has.
class ExtraColumn {
 public:
  ExtraColumn(SQLite::Database& sqlite, const std::string& name) : name_(name), subject_(subject_of(sqlite, name)) {
    if (subject_ == Subject::metric) value_.emplace(sqlite, "SELECT value FROM metric WHERE run_id = ?1 AND name = ?2");
    if (subject_ == Subject::bed_metric) {
      value_.emplace(sqlite, fmt::format("SELECT m.value {}WHERE d.run_id = ?1 AND m.name = ?2", kMetricsOfBed));
    }
    if (subject_ == Subject::parameter) {
      value_.emplace(sqlite, "SELECT coalesce(num, txt) FROM param WHERE case_id = ?1 AND path = ?2");
    }
  }

  const std::string& name() const { return name_; }
  Subject subject() const { return subject_; }
  bool is_metric() const { return subject_ == Subject::metric || subject_ == Subject::bed_metric; }

  Cell of(const ListedRun& run) {
    if (name_ == kBedCase) return run.bed_id.empty() ? Cell{} : Cell{run.bed_id.substr(0, kShownDigits)};
    if (subject_ == Subject::run_column) return name_ == "kind" ? run.kind : run.outcome;
    value_->reset();
    if (is_metric()) {
      value_->bind(1, run.run_id);
    } else {
      value_->bind(1, run.case_id);
    }
    value_->bind(2, is_metric() ? metric_name(name_) : name_);
    return value_->executeStep() ? cell(value_->getColumn(0)) : Cell{};
  }

 private:
  std::string name_;
  Subject subject_;
  std::optional<SQLite::Statement> value_;
};

std::string unit_of(SQLite::Database& sqlite, const ExtraColumn& column) {
  if (column.is_metric()) {
    SQLite::Statement unit(sqlite,
                           "SELECT unit FROM metric JOIN run USING (run_id) JOIN kase USING (case_id) "
                           "WHERE name = ?1 AND (NOT ?2 OR kind = 'bed') ORDER BY run_id DESC LIMIT 1");
    unit.bind(1, metric_name(column.name()));
    unit.bind(2, column.subject() == Subject::bed_metric ? 1 : 0);
    return unit.executeStep() ? unit.getColumn(0).getString() : "";
  }
  const auto found = parameter_units().find(column.name());
  return found == parameter_units().end() ? "" : found->second;
}

/// The first metrics of the listed runs, in the order in which the runs themselves list them.
Texts default_metrics(SQLite::Database& sqlite, const std::vector<ListedRun>& runs) {
  Texts names;
  SQLite::Statement list(sqlite, "SELECT name FROM metric WHERE run_id = ? ORDER BY ordinal");
  for (auto run = runs.begin(); run != runs.end() && names.size() < kDefaultMetrics; ++run) {
    list.reset();
    list.bind(1, run->run_id);
    while (names.size() < kDefaultMetrics && list.executeStep()) {
      const std::string name = list.getColumn(0).getString();
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

/// The labels' paths, each once, in the order in which they come.
Texts label_columns(const std::vector<ListedRun>& runs) {
  Texts paths;
  for (const ListedRun& run : runs) {
    for (const auto& [path, value] : run.labels) {
      if (std::ranges::find(paths, path) == paths.end()) paths.push_back(path);
    }
  }
  return paths;
}

/// Gives runs the labels that their cases have in any study; the first study by name wins.
void add_all_labels(SQLite::Database& sqlite, std::vector<ListedRun>& runs) {
  SQLite::Statement rows(sqlite,
                         "SELECT labels FROM study_case JOIN study USING (study_id) WHERE case_id = ? ORDER BY name");
  for (ListedRun& run : runs) {
    rows.reset();
    rows.bind(1, run.case_id);
    while (rows.executeStep()) {
      for (auto& label : labels_from(rows.getColumn(0).getString())) {
        const bool is_new = std::ranges::find(run.labels, label.first, &Labels::value_type::first) == run.labels.end();
        if (is_new) run.labels.push_back(label);
      }
    }
  }
}

}  // namespace

std::vector<ListedRun> list_runs(SQLite::Database& sqlite, const std::string& study, const Texts& where) {
  const bool all = study.empty();
  if (!all && !exists(sqlite, "SELECT 1 FROM study WHERE name = ?", study)) {
    refuse_unknown("study", study, texts(sqlite, "SELECT name FROM study ORDER BY name"));
  }
  std::string text = "SELECT r.run_id, r.case_id, r.number, k.kind, r.outcome, r.folder, k.bed_id, " +
                     std::string(all ? "NULL" : "sc.labels") + " FROM run r JOIN kase k ON k.case_id = r.case_id ";
  std::vector<Cell> values;
  if (!all) {
    text += "JOIN study_case sc ON sc.case_id = r.case_id JOIN study s ON s.study_id = sc.study_id AND s.name = ? ";
    values.emplace_back(study);
  }
  text += "WHERE r.number = (SELECT max(number) FROM run WHERE case_id = r.case_id)";
  for (const std::string& condition : where) {
    const Clause clause = clause_of(sqlite, parse_condition(condition));
    text += " AND " + clause.text;
    values.insert(values.end(), clause.values.begin(), clause.values.end());
  }
  text += all ? " ORDER BY r.case_id" : " ORDER BY sc.ordinal";

  SQLite::Statement statement(sqlite, text);
  for (std::size_t i = 0; i < values.size(); ++i) put_value(statement, static_cast<int>(i) + 1, values[i]);
  std::vector<ListedRun> runs;
  while (statement.executeStep()) {
    runs.push_back(
        {statement.getColumn(0).getInt64(), statement.getColumn(1).getString(), statement.getColumn(2).getInt64(),
         statement.getColumn(3).getString(), statement.getColumn(4).getString(), statement.getColumn(5).getString(),
         statement.getColumn(6).getString(), all ? Labels{} : labels_from(statement.getColumn(7).getString())});
  }
  if (all) add_all_labels(sqlite, runs);
  return runs;
}

Table query_table(SQLite::Database& sqlite, const std::string& study, const Texts& where, const Texts& extra) {
  // One transaction, so that a writer in between is seen by all of the table or by none of it.
  SQLite::Transaction transaction(sqlite);
  const std::vector<ListedRun> runs = list_runs(sqlite, study, where);
  const Texts labels = label_columns(runs);
  std::vector<ExtraColumn> columns;
  for (const std::string& name : extra.empty() ? default_metrics(sqlite, runs) : extra) {
    columns.emplace_back(sqlite, name);
  }

  Table table;
  const auto add = [&](const std::string& name, const std::string& unit, ColumnKind kind) {
    table.columns.push_back(name);
    table.units.push_back(unit);
    table.kinds.push_back(kind);
  };
  for (const char* name : {"case", "run", "kind"}) add(name, "", ColumnKind::identity);
  add("outcome", "", ColumnKind::outcome);
  for (const std::string& path : labels) add(path, "", ColumnKind::label);
  for (const ExtraColumn& column : columns) {
    add(column.name(), unit_of(sqlite, column),
        column.is_metric()                       ? ColumnKind::metric
        : column.subject() == Subject::parameter ? ColumnKind::parameter
                                                 : ColumnKind::fact);
  }
  for (const ListedRun& run : runs) {
    auto& row = table.rows.emplace_back();
    row = {run.case_id.substr(0, kShownDigits), fmt::format("{:04}", run.number), run.kind, run.outcome};
    for (const std::string& path : labels) {
      const auto found = std::ranges::find(run.labels, path, &Labels::value_type::first);
      row.push_back(found == run.labels.end() ? Cell{} : Cell{found->second});
    }
    for (ExtraColumn& column : columns) row.push_back(column.of(run));
  }
  return table;
}

}  // namespace seapile::store
