#include "runner/study/reference_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "runner/study/csv.h"
#include "runner/study/text_file.h"
#include "runner/study/unit.h"

namespace seapile::study {
namespace {

using base::Problems;

constexpr std::size_t kMostRows = 1000;
constexpr std::string_view kSourceMark = "# source:";

/// A column that says which cases a row is of.
struct PathColumn {
  Path path;
  std::string unit;
};

class FileReader {
 public:
  FileReader(const std::string& metric, Problems& problems) : metric_(metric), problems_(problems) {}

  ReferenceFile read(std::string_view text) {
    const std::size_t first_end = std::min(text.find('\n'), text.size());
    read_source(trimmed(text.substr(0, first_end)));
    const auto records = read_csv(text.substr(std::min(first_end + 1, text.size())), 2, problems_);
    if (records.empty()) {
      refuse(2, "is missing: the file has no header", header_rule());
    } else if (read_header(records.front())) {
      for (std::size_t i = 1; i < records.size() && i <= kMostRows; ++i) read_row(records[i]);
      if (records.size() == 1) refuse(records.front().line, "is the last: the file has no values", "at least 1 row");
      if (records.size() > kMostRows + 1)
        refuse(records[kMostRows + 1].line, "is one row too many", fmt::format("at most {} rows", kMostRows));
    }
    problems_.finish();
    return std::move(file_);
  }

 private:
  void refuse(std::size_t line, const std::string& what, std::string allowed, std::string nearest = "") {
    problems_.refuse(line, what, std::move(allowed), std::move(nearest));
  }

  std::string header_rule() const { return fmt::format("[path [unit],]... {} [unit], tolerance, reason", metric_); }

  void read_source(std::string_view line) {
    if (line.starts_with(kSourceMark)) file_.source = trimmed(line.substr(kSourceMark.size()));
    if (file_.source.empty()) refuse(1, "does not name the source", "# source: who published the values, and where");
  }

  bool read_header(const CsvRecord& header) {
    const auto& fields = header.fields;
    const std::size_t n = fields.size();
    if (n < 3 || fields[n - 2] != "tolerance" || fields[n - 1] != "reason") {
      refuse(header.line, "is not the header", header_rule());
      return false;
    }
    bool good = read_metric(header.line, csv_heading_of(fields[n - 3]));
    for (std::size_t i = 0; i + 3 < n; ++i) good &= read_path(header.line, csv_heading_of(fields[i]));
    return good;
  }

  bool read_metric(std::size_t line, const CsvHeading& heading) {
    file_.unit = heading.unit;
    if (heading.name != metric_) {
      refuse(line, fmt::format("\"{}\" is not the metric of the check", heading.name.substr(0, 60)),
             metric_ + " [unit]");
    } else if (file_.unit.empty()) {
      refuse(line, metric_ + " has no unit", fmt::format("{0} [Pa], or {0} [-] for a plain number", metric_));
    } else if (const UnitResult known = check_unit(file_.unit); !known.problem.empty()) {
      refuse(line, fmt::format("{} {}", metric_, known.problem), "a unit such as Pa, kPa, N/m, m/s, -", known.nearest);
    } else {
      return true;
    }
    return false;
  }

  bool read_path(std::size_t line, const CsvHeading& heading) {
    Problems found;
    const SchemaNode* node = node_at(heading.name, root_place(""), scene_schema(), found);
    for (const auto& problem : found) {
      refuse(line, fmt::format("\"{}\" {}", heading.name.substr(0, 60), problem.what), problem.allowed,
             problem.nearest);
    }
    if (!node) return false;
    const std::string_view unit = node->field.unit;
    const bool plain = unit.empty() || unit == "-";
    if (plain && !heading.unit.empty() && heading.unit != "-") {
      refuse(line, fmt::format("{} has no unit, not {}", heading.name, heading.unit), heading.name);
      return false;
    }
    if (!plain) {
      const std::string allowed = fmt::format("{} [{}]", heading.name, unit);
      const UnitResult in_unit = read_quantity("1 " + heading.unit, unit);
      if (!in_unit.problem.empty()) {
        refuse(line, fmt::format("{} {}", heading.name, in_unit.problem), allowed);
        return false;
      }
    }
    const Path path = split_path(heading.name);
    if (std::ranges::find(paths_, path, &PathColumn::path) != paths_.end()) {
      refuse(line, fmt::format("{} is there twice", heading.name), "each path once");
      return false;
    }
    paths_.push_back({path, plain ? "" : heading.unit});
    return true;
  }

  void read_row(const CsvRecord& record) {
    const std::size_t n = paths_.size() + 3;
    if (record.fields.size() != n) {
      refuse(record.line, fmt::format("has {} fields", record.fields.size()), fmt::format("{}, as the header", n));
      return;
    }
    ReferenceRow row;
    row.line = record.line;
    bool good = true;
    for (std::size_t i = 0; i < paths_.size(); ++i) good &= read_condition(record, i, row.which);
    row.reason = record.fields[n - 1];
    good &= read_number(record, n - 3, metric_, row.value);
    good &= read_number(record, n - 2, "tolerance", row.tolerance);
    if (good && !(row.tolerance > 0)) {
      refuse(record.line, fmt::format("tolerance {} is out of range", record.fields[n - 2]), "more than 0");
      good = false;
    }
    if (row.reason.empty()) {
      refuse(record.line, "has no reason for its tolerance", "a text in the column reason");
      good = false;
    }
    if (!good) return;
    const auto same = std::ranges::find_if(
        file_.rows, [&](const ReferenceRow& other) { return other.which.conditions == row.which.conditions; });
    if (same != file_.rows.end()) {
      refuse(record.line, fmt::format("is of the same cases as line {}", same->line), "each case once");
      return;
    }
    file_.rows.push_back(std::move(row));
  }

  bool read_number(const CsvRecord& record, std::size_t column, const std::string& what, double& quantity) {
    const std::string& field = record.fields[column];
    if (const auto number = csv_number<double>(field)) {
      quantity = *number;
      return true;
    }
    refuse(record.line,
           field.empty() ? fmt::format("has no {}", what)
                         : fmt::format("{} \"{}\" is no finite number", what, field.substr(0, 40)),
           what == "tolerance" ? fmt::format("a number in {}, more than 0", file_.unit)
                               : fmt::format("a number in {}", file_.unit));
    return false;
  }

  /// A cell as the study would write it: then it is the very same double, or name.
  bool read_condition(const CsvRecord& record, std::size_t column, Match& which) {
    const std::string& field = record.fields[column];
    const PathColumn& at = paths_[column];
    if (field.empty()) {
      refuse(record.line, fmt::format("has no {}", join_path(at.path)), "a value in every column");
      return false;
    }
    const PlacePtr place = root_place("");
    Value value = string_value(at.unit.empty() ? field : fmt::format("{} {}", field, at.unit), place);
    const auto number = csv_number<double>(field);
    if (at.unit.empty() && number) value = number_value(*number, place);
    if (field == "true" || field == "false") {
      value.kind = Value::Kind::boolean;
      value.truth = field == "true";
    }
    if (field == "null") value.kind = Value::Kind::null;
    Problems found;
    add_conditions({at.path, value}, which, found);
    for (const auto& problem : found) {
      refuse(record.line, fmt::format("{}: {}", join_path(at.path), problem.what), problem.allowed, problem.nearest);
    }
    return found.empty();
  }

  const std::string& metric_;
  LineProblems problems_;
  ReferenceFile file_;
  std::vector<PathColumn> paths_;
};

}  // namespace

ReferenceFile parse_reference(std::string_view text, const std::string& metric, Problems& problems) {
  return FileReader(metric, problems).read(text);
}

ReferenceFile read_reference(const std::filesystem::path& folder, const std::string& name, const std::string& metric,
                             Problems& problems) {
  std::string trouble;
  std::optional<std::string> text;
  if (const auto path = path_below(folder, name, trouble)) text = read_text(*path, kMostBytes, trouble);
  if (!text) {
    problems.push_back({"", fmt::format("\"{}\" {}", name, trouble), "a CSV file in the study's folder", ""});
    return {};
  }
  Problems in_file;
  ReferenceFile file = parse_reference(*text, metric, in_file);
  for (auto& problem : in_file) {
    problem.what = fmt::format("\"{}\" {}", name, problem.what);
    problems.push_back(std::move(problem));
  }
  return file;
}

}  // namespace seapile::study
