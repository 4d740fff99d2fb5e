#include "runner/study/measured_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "runner/study/csv.h"
#include "runner/study/study.h"
#include "runner/study/text_file.h"

namespace seapile::study {
namespace {

/// "cpu[s]" as "cpu".
std::string without_unit(const std::string& heading) { return heading.substr(0, heading.find('[')); }

}  // namespace

std::filesystem::path measured_path(const std::filesystem::path& study_file, const std::string& name) {
  return study_file.parent_path() / "measured" / (name + ".csv");
}

std::vector<MeasuredRow> read_measured(const std::filesystem::path& file) {
  base::Problems problems;
  std::string trouble;
  const auto bytes = read_text(file, kMostBytes, trouble);
  if (!bytes) throw BadInput(file.string(), {{"", trouble, "what `runner trade STUDY --format csv` wrote", ""}});
  LineProblems lines(problems);
  const std::vector<CsvRecord> records = read_csv(*bytes, 1, lines);
  std::vector<MeasuredRow> rows;
  std::vector<std::string> columns;
  if (!records.empty())
    for (const std::string& field : records.front().fields) columns.push_back(without_unit(field));
  const auto variant = std::ranges::find(columns, "variant") - columns.begin();
  if (records.empty() || static_cast<std::size_t>(variant) == columns.size())
    lines.refuse(1, "has no column \"variant\"", "what `runner trade STUDY --format csv` wrote");
  for (std::size_t r = 1; r < records.size() && problems.empty(); ++r) {
    const auto& fields = records[r].fields;
    if (fields.size() != columns.size()) {
      lines.refuse(records[r].line, fmt::format("has {} fields", fields.size()), fmt::format("{}", columns.size()));
      continue;
    }
    MeasuredRow& row = rows.emplace_back(MeasuredRow{fields[static_cast<std::size_t>(variant)], {}});
    for (std::size_t c = 0; c < fields.size(); ++c)
      if (const auto number = csv_number<double>(fields[c])) row.number[columns[c]] = *number;
  }
  lines.finish();
  if (!problems.empty()) throw BadInput(file.string(), std::move(problems));
  return rows;
}

}  // namespace seapile::study
