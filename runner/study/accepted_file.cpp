#include "runner/study/accepted_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <tuple>

#include "runner/study/csv.h"
#include "runner/study/json_value.h"
#include "runner/study/text_file.h"
#include "runner/study/unit.h"

namespace seapile::study {
namespace {

const std::vector<std::string> kHeader = {"case", "metric", "value", "unit", "tolerance", "run", "numerics", "note"};
constexpr std::size_t kCaseDigits = 64;

bool is_case(const std::string& text) {
  return text.size() == kCaseDigits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// One row; absent after a report.
std::optional<AcceptedValue> read_row(const CsvRecord& record, LineProblems& problems) {
  const auto& fields = record.fields;
  if (fields.size() != kHeader.size()) {
    problems.refuse(record.line, fmt::format("has {} fields", fields.size()),
                    fmt::format("{}: {}", kHeader.size(), fmt::join(kHeader, ",")));
    return {};
  }
  bool good = true;
  const auto refuse = [&](std::size_t column, const char* what, const char* allowed) {
    problems.refuse(record.line, fmt::format("{} \"{}\" {}", kHeader[column], fields[column].substr(0, 70), what),
                    allowed);
    good = false;
  };
  const auto value = csv_number<double>(fields[2]), tolerance = csv_number<double>(fields[4]);
  if (!is_case(fields[0])) refuse(0, "is no case id", "64 digits of 0-9, a-f");
  if (fields[1].empty()) refuse(1, "is no name", "name of a metric");
  if (!value) refuse(2, "is no finite number", "a number");
  if (const UnitResult known = check_unit(fields[3]); !known.problem.empty())
    refuse(3, "is no unit", "an SI unit, or -");
  if (!tolerance || !(*tolerance >= 0)) refuse(4, "is no relative tolerance", "a number, at least 0");
  if (fields[7].empty()) refuse(7, "says nothing", "why the value is right");
  if (!good) return {};
  return AcceptedValue{fields[0], fields[1], *value, fields[3], *tolerance, fields[5], fields[6], fields[7]};
}

auto key(const AcceptedValue& value) { return std::tie(value.case_id, value.metric); }

}  // namespace

std::filesystem::path accepted_path(const Study& study) {
  return study.file.parent_path() / "accepted" / (study.name + ".csv");
}

std::vector<AcceptedValue> read_accepted(const std::filesystem::path& file) {
  std::vector<AcceptedValue> values;
  std::error_code error;
  if (!std::filesystem::exists(file, error) && !error) return values;
  std::string trouble;
  const auto text = read_text(file, kMostBytes, trouble);
  if (!text) throw BadInput(file.string(), {{"", trouble, "a CSV file of at most 16 MiB", ""}});

  base::Problems found;
  LineProblems problems(found);
  const auto records = read_csv(*text, 1, problems);
  if (records.empty() || records.front().fields != kHeader) {
    problems.refuse(records.empty() ? 1 : records.front().line, "is not the header",
                    fmt::format("{}", fmt::join(kHeader, ",")));
  } else {
    for (std::size_t i = 1; i < records.size(); ++i) {
      auto value = read_row(records[i], problems);
      if (!value) continue;
      if (find_accepted(values, value->case_id, value->metric)) {
        problems.refuse(records[i].line, "is of the same case and metric as a line above", "each case and metric once");
      } else {
        values.push_back(*std::move(value));
      }
    }
  }
  problems.finish();
  if (!found.empty()) throw BadInput(file.string(), std::move(found));
  return values;
}

const AcceptedValue* find_accepted(const std::vector<AcceptedValue>& values, const std::string& case_id,
                                   const std::string& metric) {
  const auto found = std::ranges::find_if(
      values, [&](const AcceptedValue& value) { return value.case_id == case_id && value.metric == metric; });
  return found == values.end() ? nullptr : &*found;
}

void accept(std::vector<AcceptedValue>& values, AcceptedValue value) {
  std::erase_if(values, [&](const AcceptedValue& old) { return key(old) == key(value); });
  values.push_back(std::move(value));
}

std::string accepted_text(std::vector<AcceptedValue> values) {
  std::ranges::sort(values, [](const AcceptedValue& a, const AcceptedValue& b) { return key(a) < key(b); });
  std::string text = csv_line(kHeader);
  for (const AcceptedValue& value : values) {
    text += csv_line({value.case_id, value.metric, number_text(value.value), value.unit, number_text(value.tolerance),
                      value.run, value.numerics, value.note});
  }
  return text;
}

}  // namespace seapile::study
