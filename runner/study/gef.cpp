// The Geotechnical Exchange Format: a header of lines "#KEYWORD= value, value" up to "#EOH=", then records of numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "runner/study/cpt.h"
#include "runner/study/cpt_columns.h"
#include "runner/study/csv.h"
#include "runner/study/unit.h"

namespace seapile::study {
namespace {

constexpr int kCorrectedDepth = 11;  // quantity
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

std::string upper(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

/// A number as GEF files write it, a plus sign allowed.
std::optional<double> number_of(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  return csv_number<double>(text);
}

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(at, start), text.size());
    parts.emplace_back(trimmed(text.substr(start, end - start)));
    start = end + 1;
  }
  return parts;
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = text.find_first_not_of(" \t\r\n", at)) != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
    words.emplace_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

/// "m (metre)" as "m": some offices explain their units.
std::string unit_of(const std::string& field) {
  return std::string(trimmed(std::string_view(field).substr(0, std::min(field.find('('), field.size()))));
}

struct ColumnInfo {
  std::size_t line = 0;
  std::string unit;
  int quantity = 0;
};

class GefReader {
 public:
  explicit GefReader(base::Problems& problems) : problems_(problems) {}

  Cpt read(std::string_view text) {
    const std::size_t data = read_header(text);
    if (data != std::string_view::npos && check_header()) read_records(text.substr(data), data_line_);
    problems_.finish();
    return std::move(cpt_);
  }

 private:
  void refuse(std::size_t line, const std::string& what, std::string allowed) {
    problems_.refuse(line, what, std::move(allowed));
    good_ = false;
  }

  /// Where the records begin; npos when the header has no end.
  std::size_t read_header(std::string_view text) {
    std::size_t line_number = 1;
    for (std::size_t start = 0; start < text.size(); ++line_number) {
      const std::size_t end = std::min(text.find('\n', start), text.size());
      const std::string_view line = trimmed(text.substr(start, end - start));
      start = std::min(end + 1, text.size());
      const std::size_t equals = std::min(line.find('='), line.size());
      if (!line.starts_with('#')) continue;
      const std::string keyword = upper(trimmed(line.substr(1, equals - 1)));
      if (keyword == "EOH") {
        data_line_ = line_number + 1;
        return start;
      }
      if (equals < line.size()) take(keyword, trimmed(line.substr(equals + 1)), line_number);
    }
    refuse(line_number, "is the end, and the header has none", "a line #EOH=");
    return std::string_view::npos;
  }

  void take(const std::string& keyword, std::string_view value, std::size_t line) {
    const std::vector<std::string> values = split(value, ',');
    if (keyword == "REPORTCODE" || (keyword == "PROCEDURECODE" && upper(values[0]).starts_with("GEF-"))) {
      // Beside a report's code the procedure's names a standard.
      if (!upper(values[0]).starts_with("GEF-CPT"))
        refuse(line, fmt::format("is of a {}", values[0].substr(0, 40)), "GEF-CPT-Report");
    } else if (keyword == "DATAFORMAT" || keyword == "DATATYPE") {
      if (upper(value).find("BINARY") != std::string::npos) refuse(line, "says that the data are binary", "ASCII");
    } else if (keyword == "COLUMN") {
      const auto count = csv_number<std::size_t>(values[0]);
      if (!count || *count == 0) {
        refuse(line, fmt::format("\"{}\" is no number of columns", values[0].substr(0, 40)), "#COLUMN= n");
      } else {
        count_ = *count;
      }
    } else if (keyword == "COLUMNINFO") {
      take_column(values, line);
    } else if (keyword == "COLUMNVOID") {
      const auto column = csv_number<std::size_t>(values[0]);
      const auto number = values.size() > 1 ? number_of(values[1]) : std::nullopt;
      if (!column || !number) {
        refuse(line, "does not say what a missing value is", "#COLUMNVOID= column, value");
      } else {
        voids_[*column] = *number;
      }
    } else if (keyword == "COLUMNSEPARATOR") {
      column_separator_ = separator(value, line);
    } else if (keyword == "RECORDSEPARATOR") {
      record_separator_ = separator(value, line);
    } else if (keyword == "LASTSCAN") {
      last_scan_ = csv_number<std::size_t>(values[0]);
    } else if (keyword == "MEASUREMENTVAR") {
      take_measurement(values, line);
    } else if (keyword == "PROJECTID") {
      cpt_.is_simulated = values[0] == kSimulatedProject;
    }
  }

  void take_column(const std::vector<std::string>& values, std::size_t line) {
    const auto column = csv_number<std::size_t>(values[0]);
    // The name may hold commas; the quantity is the last.
    const auto quantity = csv_number<int>(values.back());
    if (!column || *column == 0 || values.size() < 4 || !quantity) {
      refuse(line, "does not describe a column", "#COLUMNINFO= column, unit, name, quantity");
    } else if (!columns_.try_emplace(*column, ColumnInfo{line, unit_of(values[1]), *quantity}).second) {
      refuse(line, fmt::format("column {} is there twice", *column), "each column once");
    }
  }

  /// A blank between columns and an end of line between records are what is taken without a word.
  char separator(std::string_view value, std::size_t line) {
    if (value.size() > 1) refuse(line, fmt::format("\"{}\" is no separator", value.substr(0, 40)), "one character");
    return value.empty() ? '\0' : value[0];
  }

  void take_measurement(const std::vector<std::string>& values, std::size_t line) {
    constexpr std::string_view kConeArea = "1";
    if (values[0] != kConeArea || values.size() < 3) return;
    const auto number = number_of(values[1]);
    if (!number || *number == 0) return;  // "-" and 0 are written where it is not known
    const UnitResult area = read_quantity(fmt::format("{} {}", number_text(*number), unit_of(values[2])), "m2");
    if (!area.problem.empty() || area.value < 0) {
      refuse(line, fmt::format("the cone's area {} {} is none", values[1], unit_of(values[2])),
             "#MEASUREMENTVAR= 1, 1000, mm2, area of the cone");
    } else {
      cpt_.cone_area = area.value;
    }
  }

  bool check_header() {
    const std::size_t line = data_line_ - 1;
    if (count_ == 0 && good_) refuse(line, "ends a header without #COLUMN=", "#COLUMN= n");
    for (std::size_t i = 1; i <= count_ && i <= columns_.size() + 1; ++i) {
      if (!columns_.contains(i))
        refuse(line, fmt::format("ends a header without #COLUMNINFO= {}", i), "one per column");
    }
    for (const auto& [place, info] : columns_) {
      if (place > count_) refuse(info.line, fmt::format("column {} is one too many", place), fmt::format("{}", count_));
    }
    if (!good_) return false;
    for (const CptColumn& column : kCptColumns) add_source(column.quantity, column.unit, column.values);
    add_source(kCorrectedDepth, "m", nullptr);
    const auto has = [&](int quantity) { return std::ranges::find(found_, quantity) != found_.end(); };
    if (!has(1) && !has(kCorrectedDepth)) refuse(line, "ends a header without a depth", "a column of quantity 1 or 11");
    if (!has(2)) refuse(line, "ends a header without a cone resistance", "a column of quantity 2");
    return good_;
  }

  void add_source(int quantity, std::string_view unit, std::vector<double>& (*values)(Cpt&)) {
    for (const auto& [place, info] : columns_) {
      if (info.quantity != quantity) continue;
      if (std::ranges::find(found_, quantity) != found_.end())
        refuse(info.line, fmt::format("quantity {} is there twice", quantity), "each quantity once");
      found_.push_back(quantity);
      sources_.push_back({values, place - 1, factor(place, unit)});
    }
  }

  double factor(std::size_t place, std::string_view unit) {
    const ColumnInfo& info = columns_.at(place);
    const UnitResult result = read_quantity("1 " + (info.unit.empty() ? std::string("?") : info.unit), unit);
    if (result.problem.empty()) return result.value;
    refuse(info.line, fmt::format("column {} {}", place, result.problem),
           unit == "Pa"  ? "MPa or another unit of stress"
           : unit == "-" ? "% or -"
                         : "m");
    return 1;
  }

  void read_records(std::string_view text, std::size_t line) {
    const char end_of_record = record_separator_ == '\0' ? '\n' : record_separator_;
    for (std::size_t start = 0; start < text.size();) {
      const std::size_t end = std::min(text.find(end_of_record, start), text.size());
      std::string_view record = text.substr(start, end - start);
      // Between two records the lines go on; a record is where its first number is.
      const std::size_t first = std::min(record.find_first_not_of(" \t\r\n"), record.size());
      const std::size_t at = line + static_cast<std::size_t>(std::ranges::count(record.substr(0, first), '\n'));
      line += static_cast<std::size_t>(
          std::ranges::count(text.substr(start, std::min(end + 1, text.size()) - start), '\n'));
      start = end + 1;
      if (first < record.size()) read_record(record.substr(first), at);
    }
    if (scans_ == 0) {
      refuse(data_line_, "is missing: the file has no readings", "at least 1 record");
    } else if (last_scan_ && scans_ < *last_scan_) {
      refuse(line, fmt::format("is the end after {} records", scans_),
             fmt::format("{}, as #LASTSCAN= says", *last_scan_));
    }
    choose_depth();
  }

  void read_record(std::string_view record, std::size_t line) {
    ++scans_;
    const bool blanks = column_separator_ == '\0' || column_separator_ == ' ' || column_separator_ == '\t';
    std::vector<std::string> fields = blanks ? words_of(record) : split(record, column_separator_);
    while (!fields.empty() && !fields.back().empty() && (fields.back().back() == '\n' || fields.back().back() == '\r'))
      fields.back().pop_back();
    if (!fields.empty() && fields.back().empty()) fields.pop_back();  // A separator ends the last, too.
    if (fields.size() != count_) {
      refuse(line, fmt::format("has {} numbers", fields.size()), fmt::format("{}, as #COLUMN= says", count_));
      return;
    }
    for (const Source& source : sources_) {
      const std::string& field = fields[source.place];
      const auto number = number_of(field);
      if (!number) {
        refuse(line, fmt::format("column {} \"{}\" is no finite number", source.place + 1, field.substr(0, 40)),
               "a number");
      }
      const auto none = voids_.find(source.place + 1);
      const bool is_missing = !number || (none != voids_.end() && none->second == *number);
      auto& values = source.values == nullptr ? corrected_depth_ : source.values(cpt_);
      values.push_back(is_missing ? kMissing : *number * source.factor);
      const bool is_depth = source.values == nullptr || source.values == kCptColumns[0].values;
      if (is_depth && values.back() < 0)
        refuse(line, fmt::format("depth {} is above the ground", field), "0 or more, downwards");
    }
  }

  /// The corrected depth, where the file has one that is measured.
  void choose_depth() {
    if (std::ranges::any_of(corrected_depth_, [](double depth) { return std::isfinite(depth); }) || cpt_.depth.empty())
      cpt_.depth = corrected_depth_;
  }

  struct Source {
    std::vector<double>& (*values)(Cpt&);  ///< null: the corrected depth
    std::size_t place;
    double factor;
  };

  LineProblems problems_;
  Cpt cpt_;
  std::map<std::size_t, ColumnInfo> columns_;
  std::map<std::size_t, double> voids_;
  std::vector<Source> sources_;
  std::vector<int> found_;  ///< quantities
  std::vector<double> corrected_depth_;
  std::optional<std::size_t> last_scan_;
  std::size_t count_ = 0, scans_ = 0, data_line_ = 0;
  char column_separator_ = '\0', record_separator_ = '\0';
  bool good_ = true;
};

}  // namespace

Cpt parse_gef(std::string_view text, base::Problems& problems) { return GefReader(problems).read(text); }

}  // namespace seapile::study
