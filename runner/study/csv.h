// CSV as a study's files have it: a record per line, fields quoted as RFC 4180 asks, blanks around a field of no
// meaning.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "solver/base/problem.h"

namespace seapile::study {

/// What is wrong with the lines of a file, each `what` beginning with its line; the pointer is left to the caller.
class LineProblems {
 public:
  explicit LineProblems(base::Problems& problems) : problems_(problems) {}

  void refuse(std::size_t line, const std::string& what, std::string allowed, std::string nearest = "");
  /// Says how many problems were left out: a file of another kind is wrong in every line.
  void finish();

 private:
  base::Problems& problems_;
  std::size_t count_ = 0;
};

struct CsvRecord {
  std::size_t line = 0;  ///< from 1
  std::vector<std::string> fields;
};

/// A text without the blanks at its ends.
std::string_view trimmed(std::string_view text);

/// The records of a text whose first line has the number `first_line`; empty lines are left out, lines that cannot be
/// taken apart are refused.
std::vector<CsvRecord> read_csv(std::string_view text, std::size_t first_line, LineProblems& problems);

/// "pile.depth [m]" taken apart; no unit: "".
struct CsvHeading {
  std::string name, unit;
};
CsvHeading csv_heading_of(const std::string& field);

/// One record as a line, its end included.
std::string csv_line(const std::vector<std::string>& fields);

/// The whole field as a number; absent when it is none, or not finite.
template <class Number>
std::optional<Number> csv_number(std::string_view field) {
  Number value{};
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) return {};
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(value)) return {};
  }
  return value;
}

}  // namespace seapile::study
