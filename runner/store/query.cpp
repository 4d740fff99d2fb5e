#include "runner/store/query.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "runner/store/clause.h"
#include "runner/store/ingest.h"

namespace seapile::store {

namespace {

using Texts = std::vector<std::string>;

/// How many metrics a table shows when none are asked for: the solver lists its headline ones first.
constexpr std::size_t kDefaultMetrics = 6;

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
  ExtraColumn(SQLite::Database& sqlite, const Name& name) : name_(name) {
    if (const std::string question = question_of(name.subject); !question.empty()) value_.emplace(sqlite, question);
  }

  const Name& name() const { return name_; }

  ColumnKind kind() const {
    if (name_.is_metric()) return ColumnKind::metric;
    return name_.subject == Subject::parameter ? ColumnKind::parameter : ColumnKind::fact;
  }

  Cell of(const ListedRun& run) {
    if (name_.subject == Subject::bed_case) {
      return run.bed_id.empty() ? Cell{} : Cell{run.bed_id.substr(0, kShownDigits)};
    }
    if (!value_) return name_.subject == Subject::kind ? run.kind : run.outcome;
    value_->reset();
    if (name_.is_metric()) {
      value_->bind(1, run.run_id);
    } else {
      value_->bind(1, run.case_id);
    }
    if (name_.subject != Subject::study) value_->bind(2, name_.metric());
    return value_->executeStep() ? cell(value_->getColumn(0)) : Cell{};
  }

 private:
  /// For one run; "" where the listing knows the answer.
  static std::string question_of(Subject subject) {
    switch (subject) {
      case Subject::metric:
        return "SELECT value FROM metric WHERE run_id = ?1 AND name = ?2";
      case Subject::bed_metric:
        return fmt::format("SELECT m.value {}WHERE d.run_id = ?1 AND m.name = ?2", kMetricsOfBed);
      case Subject::parameter:
        return "SELECT coalesce(num, txt) FROM param WHERE case_id = ?1 AND path = ?2";
      case Subject::study:
        return "SELECT group_concat(name, ' ') FROM (SELECT s.name FROM study_case sc JOIN study s "
               "ON s.study_id = sc.study_id WHERE sc.case_id = ?1 ORDER BY s.name)";
      default:
        return "";
    }
  }

  Name name_;
  std::optional<SQLite::Statement> value_;
};

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

std::vector<ListedRun> list_runs(SQLite::Database& sqlite, const Names& names, const std::string& study,
                                 const Expression& where) {
  const bool all = study.empty();
  if (!all) {
    const Texts known = study_names(sqlite);
    if (std::ranges::find(known, study) == known.end()) refuse_unknown("study", study, known);
  }
  std::string text = "SELECT r.run_id, r.case_id, r.number, k.kind, r.outcome, r.folder, k.bed_id, " +
                     std::string(all ? "NULL" : "sc.labels") + " FROM run r JOIN kase k ON k.case_id = r.case_id ";
  std::vector<Cell> values;
  if (!all) {
    text += "JOIN study_case sc ON sc.case_id = r.case_id JOIN study s ON s.study_id = sc.study_id AND s.name = ? ";
    values.emplace_back(study);
  }
  const Clause clause = clause_of(sqlite, names, study, where);
  text += "WHERE r.newest = 1 AND " + clause.text;
  values.insert(values.end(), clause.values.begin(), clause.values.end());
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

Table query_table(SQLite::Database& sqlite, const std::string& study, const Expression& where, const Texts& extra) {
  // One transaction, so that a writer in between is seen by all of the table or by none of it.
  SQLite::Transaction transaction(sqlite);
  const Names names(sqlite);
  const std::vector<ListedRun> runs = list_runs(sqlite, names, study, where);
  const Texts labels = label_columns(runs);
  std::vector<ExtraColumn> columns;
  for (const std::string& name : extra.empty() ? default_metrics(sqlite, runs) : extra) {
    columns.emplace_back(sqlite, names.find(name, study));
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
  for (const ExtraColumn& column : columns) add(column.name().text, names.unit(column.name()), column.kind());
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
