#include "runner/study/cpt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string>

#include "runner/study/cpt_columns.h"
#include "runner/study/csv.h"
#include "runner/study/json_value.h"
#include "runner/study/nearest.h"
#include "runner/study/study.h"
#include "runner/study/text_file.h"
#include "runner/study/unit.h"

namespace seapile::study {
namespace {

constexpr std::string_view kModelColumn = "model";
constexpr std::string_view kHeaderRule = "depth[m],qc[MPa], and any of fs[kPa], Rf[%], u1[kPa], u2[kPa], u3[kPa]";

/// A column of the file that is read, and the factor from its unit to ours.
struct Source {
  const CptColumn* column;
  std::size_t place;
  double factor;
};

class CsvReader {
 public:
  explicit CsvReader(base::Problems& problems) : problems_(problems) {}

  Cpt read(std::string_view text) {
    const auto records = read_csv(text, 1, problems_);
    if (records.empty()) {
      problems_.refuse(1, "is missing: the file has no header", std::string(kHeaderRule));
    } else if (read_header(records.front())) {
      for (std::size_t i = 1; i < records.size(); ++i) read_row(records[i]);
      if (records.size() == 1)
        problems_.refuse(records.front().line, "is the last: the file has no readings", "at least 1 row");
    }
    problems_.finish();
    return std::move(cpt_);
  }

 private:
  bool read_header(const CsvRecord& header) {
    const auto& fields = header.fields;
    std::vector<std::string> names;
    for (const std::string& field : fields) names.push_back(csv_heading_of(field).name);
    width_ = fields.size();
    model_ = static_cast<std::size_t>(std::ranges::find(names, kModelColumn) - names.begin());
    bool good = true;
    const auto refuse = [&](const std::string& what, const std::string& allowed, const std::string& meant = "") {
      problems_.refuse(header.line, what, allowed, meant);
      good = false;
    };
    for (const CptColumn& column : kCptColumns) {
      const std::string name(column.name);
      const auto count = std::ranges::count(names, name);
      const bool needed = name == "depth" || name == "qc";
      if (count == 0 && needed) refuse("has no column " + name, std::string(kHeaderRule), nearest(name, names));
      if (count > 1) refuse(name + " is there twice", "each column once");
      if (count != 1) continue;
      const auto place = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
      const std::string unit = csv_heading_of(fields[place]).unit, example = name == "depth" ? "m" : "kPa";
      const std::string allowed = column.unit == "-" ? "Rf[%], or Rf[-]" : fmt::format("{}[{}]", name, example);
      if (unit.empty()) {
        refuse(name + " has no unit", allowed);
        continue;
      }
      const UnitResult factor = read_quantity("1 " + unit, column.unit);
      if (!factor.problem.empty()) {
        refuse(name + " " + factor.problem, allowed, check_unit(unit).nearest);
        continue;
      }
      sources_.push_back({&column, place, factor.value});
    }
    return good;
  }

  void read_row(const CsvRecord& record) {
    if (record.fields.size() != width_) {
      problems_.refuse(record.line, fmt::format("has {} fields", record.fields.size()),
                       fmt::format("{}, as the header", width_));
      return;
    }
    for (const Source& source : sources_) {
      const std::string& field = record.fields[source.place];
      const auto number = csv_number<double>(field);
      const bool is_depth = source.column == &kCptColumns[0];
      if (!number && (!field.empty() || is_depth)) {
        problems_.refuse(record.line,
                         field.empty()
                             ? "has no depth"
                             : fmt::format("{} \"{}\" is no finite number", source.column->name, field.substr(0, 40)),
                         is_depth ? "a number" : "a number, or nothing where it is missing");
      } else if (is_depth && *number < 0) {
        problems_.refuse(record.line, fmt::format("depth {} is above the ground", field), "0 or more, downwards");
      }
      source.column->values(cpt_).push_back(number ? *number * source.factor
                                                   : std::numeric_limits<double>::quiet_NaN());
    }
    if (model_ < width_ && record.fields[model_] == kSimulatedModel) cpt_.is_simulated = true;
  }

  LineProblems problems_;
  Cpt cpt_;
  std::vector<Source> sources_;
  std::size_t width_ = 0, model_ = 0;
};

}  // namespace

Cpt parse_cpt_csv(std::string_view text, base::Problems& problems) { return CsvReader(problems).read(text); }

Cpt read_cpt(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  base::Problems problems;
  std::string trouble;
  Cpt cpt;
  if (ending != ".gef" && ending != ".csv") {
    problems.push_back({"", "is of no known kind", "a name that ends in .gef or .csv", ""});
  } else if (const auto text = read_text(file, kMostBytes, trouble)) {
    cpt = ending == ".gef" ? parse_gef(*text, problems) : parse_cpt_csv(*text, problems);
  } else {
    problems.push_back({"", trouble, "", ""});
  }
  if (!problems.empty()) throw BadInput(file.string(), std::move(problems));
  return cpt;
}

}  // namespace seapile::study
