// A table for people, for spreadsheets, and for programs.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runner/store/catalogue.h"

namespace seapile::present {

enum class Format {
  table,   ///< aligned text; large numbers with a prefix of their unit ("kPa"), four significant digits
  csv,     ///< RFC 4180, units in the header ("depth[m]"), every digit
  json,    ///< "schema": "runner/table/1"
  ndjson,  ///< a JSON object per row and line, each by itself: "schema": "runner/row/1"; units as json's columns say
};

/// `means`: the columns of means, "x.mean", each followed by the two ends of its interval, "x.low" and "x.high". The
/// table for people shows the three as one: "44.3 ± 1.2", or "1.52 (1.41 to 1.65)" where the ends are not as far from
/// the mean, or the value alone where there is no interval.
std::string text(const store::Table& table, Format format, const std::vector<std::size_t>& means = {});

/// A column as people see it: the unit's prefix and the digits chosen for all of its rows together.
struct ShownColumn {
  std::string name, unit;
  std::vector<std::string> cells;
  bool numbers = false;  ///< aligned to the right
};

/// The columns of the table for people, `means` as in text().
std::vector<ShownColumn> shown_columns(const store::Table& table, const std::vector<std::size_t>& means = {});

/// The factor that values of a unit are shown with when the largest is `most`; the unit gets its prefix ("kPa").
double prefixed(std::string& unit, double most);

/// What is said before rows that tell cases apart: one column per label.
using Labels = std::vector<std::pair<std::string, std::string>>;

/// Label columns of several cases: every path that occurs, in the order of first occurrence. A column whose values are
/// all numbers with one unit becomes a column of numbers in that unit.
store::Table label_table(const std::vector<Labels>& cases);

/// Makes a column of texts that are all numbers with one unit a column of numbers in that unit; else does nothing.
void read_quantities(store::Table& table, std::size_t column);

/// Puts blanks before the texts of a column so that they end together: for texts that show numbers.
void align_right(store::Table& table, std::size_t column);

/// "0.06 m/s" as 0.06 and "m/s"; absent when the text does not begin with a number or goes on otherwise.
std::optional<std::pair<double, std::string>> quantity(const std::string& text);

/// One field of a CSV file, quoted where RFC 4180 asks for it.
std::string csv_field(const std::string& text);

/// "depth[m]"; the name alone when there is no unit.
std::string csv_heading(const std::string& name, const std::string& unit);

}  // namespace seapile::present
