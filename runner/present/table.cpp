#include "runner/present/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace seapile::present {
namespace {

using store::Cell;
using store::Table;

using Column = ShownColumn;

/// Characters that a terminal shows: UTF-8 code points.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Absence of control characters: a name must not be able to move the cursor.
std::string printable(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
  return text;
}

double largest(const Table& table, std::size_t column) {
  double most = 0;
  for (const auto& row : table.rows) {
    if (const auto* value = std::get_if<double>(&row[column]); value && std::isfinite(*value)) {
      most = std::max(most, std::abs(*value));
    }
  }
  return most;
}

/// Four significant digits of the largest value, the same decimals for every row.
std::string number(double value, double most) {
  if (!std::isfinite(value)) return fmt::format("{}", value);
  if (value == std::floor(value) && std::abs(value) < 1e6 && most == std::floor(most))
    return fmt::format("{:.0f}", value);
  const int digits_before = most > 0 ? static_cast<int>(std::floor(std::log10(most))) + 1 : 1;
  const bool small = value != 0 && std::abs(value) < most * 1e-3;
  if (most >= 1e7 || most < 1e-3 || small) return fmt::format("{:.4g}", value);
  return fmt::format("{:.{}f}", value, std::clamp(4 - digits_before, 0, 6));
}

Column as_text(const Table& table, std::size_t index) {
  Column column{printable(table.columns[index]), table.units[index], {}, false};
  double most = largest(table, index);
  const double scale = prefixed(column.unit, most);
  most *= scale;
  column.numbers = most > 0;
  for (const auto& row : table.rows) {
    if (const auto* value = std::get_if<double>(&row[index])) {
      column.cells.push_back(number(*value * scale, most));
      column.numbers = true;
    } else if (const auto* words = std::get_if<std::string>(&row[index])) {
      column.cells.push_back(printable(*words));
    } else {
      column.cells.emplace_back("-");
    }
  }
  return column;
}

/// Decimals with which a half-width has two significant digits.
int decimals(double half) { return 1 - static_cast<int>(std::floor(std::log10(half))); }

/// A column of means and the two columns of their intervals as one. The half-widths choose the digits: two of the
/// largest one, a third where a smaller one would else be lost.
Column as_means(const Table& table, std::size_t index) {
  std::string name = table.columns[index];
  if (name.ends_with(".mean")) name.resize(name.size() - std::string(".mean").size());
  Column column{printable(name), table.units[index], {}, true};
  const double scale = prefixed(column.unit, largest(table, index));
  const auto value = [&](const auto& row, std::size_t at) {
    const auto* number = std::get_if<double>(&row[at]);
    return number ? *number * scale : std::numeric_limits<double>::quiet_NaN();
  };
  double least = 0, most = 0;
  for (const auto& row : table.rows) {
    const double half = (value(row, index + 2) - value(row, index + 1)) / 2;
    if (!(half > 0)) continue;
    most = std::max(most, half);
    least = least > 0 ? std::min(least, half) : half;
  }
  const int digits = most > 0 ? std::max(0, std::min(decimals(least), decimals(most) + 1)) : 0;
  const auto shown = [&](double x) {
    return digits > 6 ? fmt::format("{:.3g}", x) : fmt::format("{:.{}f}", x, digits);
  };
  const std::size_t half_width = shown(most).size();
  for (const auto& row : table.rows) {
    const double mean = value(row, index), low = value(row, index + 1), high = value(row, index + 2);
    const bool even = std::abs((high - mean) - (mean - low)) <= 1e-6 * (high - low);
    if (std::isnan(mean)) {
      column.cells.emplace_back("-");
    } else if (std::isnan(low)) {
      column.cells.push_back(most > 0 ? shown(mean) : number(mean, largest(table, index) * scale));
    } else if (even) {
      column.cells.push_back(fmt::format("{} ± {:>{}}", shown(mean), shown((high - low) / 2), half_width));
    } else {
      column.cells.push_back(fmt::format("{} ({} to {})", shown(mean), shown(low), shown(high)));
    }
  }
  return column;
}

std::string aligned(const std::string& text, std::size_t columns, bool right) {
  const std::string space(columns - std::min(columns, width(text)), ' ');
  return right ? space + text : text + space;
}

std::string to_text(const Table& table, const std::vector<std::size_t>& means) {
  const std::vector<Column> columns = shown_columns(table, means);
  std::vector<std::size_t> widths;
  for (const Column& column : columns) {
    std::size_t most = std::max(width(column.name), width(column.unit));
    for (const std::string& cell : column.cells) most = std::max(most, width(cell));
    widths.push_back(most);
  }
  std::string text;
  const auto line = [&](auto cell) {
    std::string one;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (i > 0) one += "  ";
      one += aligned(cell(i), widths[i], columns[i].numbers);
    }
    one.erase(one.find_last_not_of(' ') + 1);
    text += one + "\n";
  };
  line([&](std::size_t i) { return columns[i].name; });
  const bool any_unit = std::ranges::any_of(columns, [](const Column& column) { return !column.unit.empty(); });
  if (any_unit) line([&](std::size_t i) { return columns[i].unit; });
  line([&](std::size_t i) { return std::string(widths[i], '-'); });
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    line([&](std::size_t i) { return columns[i].cells[row]; });
  }
  return text;
}

std::string to_csv(const Table& table) {
  std::string text;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    text += (i > 0 ? "," : "") + csv_heading(table.columns[i], table.units[i]);
  }
  text += "\n";
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) text += ",";
      if (const auto* value = std::get_if<double>(&row[i])) {
        text += fmt::format("{}", *value);
      } else if (const auto* words = std::get_if<std::string>(&row[i])) {
        text += csv_field(*words);
      }
    }
    text += "\n";
  }
  return text;
}

using Json = nlohmann::ordered_json;

/// Adds the cells of a row by their columns' names. What is absent or no finite number is null.
void add_row(Json& object, const Table& table, const std::vector<Cell>& row) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    Json& cell = object[table.columns[i]];
    if (const auto* value = std::get_if<double>(&row[i]); value && std::isfinite(*value)) cell = *value;
    if (const auto* words = std::get_if<std::string>(&row[i])) cell = *words;
  }
}

std::string dumped(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_json(const Table& table) {
  Json columns = Json::array(), rows = Json::array();
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    columns.push_back({{"name", table.columns[i]}, {"unit", table.units[i]}});
  }
  for (const auto& row : table.rows) add_row(rows.emplace_back(Json::object()), table, row);
  return dumped({{"schema", "runner/table/1"}, {"columns", columns}, {"rows", rows}}, 1);
}

std::string to_ndjson(const Table& table) {
  std::string text;
  for (const auto& row : table.rows) {
    Json object = {{"schema", "runner/row/1"}};
    add_row(object, table, row);
    text += dumped(object, -1);
  }
  return text;
}

}  // namespace

std::vector<ShownColumn> shown_columns(const Table& table, const std::vector<std::size_t>& means) {
  std::vector<ShownColumn> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const bool has_interval = std::ranges::find(means, i) != means.end();
    columns.push_back(has_interval ? as_means(table, i) : as_text(table, i));
    if (has_interval) i += 2;
  }
  return columns;
}

double prefixed(std::string& unit, double most) {
  if (unit != "Pa" && unit != "N/m" && unit != "J/m" && unit != "Pa/m") return 1;
  if (most < 1e3) return 1;
  unit = (most >= 1e6 ? "M" : "k") + unit;
  return most >= 1e6 ? 1e-6 : 1e-3;
}

std::string text(const Table& table, Format format, const std::vector<std::size_t>& means) {
  switch (format) {
    case Format::table:
      return to_text(table, means);
    case Format::csv:
      return to_csv(table);
    case Format::json:
      return to_json(table);
    case Format::ndjson:
      return to_ndjson(table);
  }
  return "";
}

Table label_table(const std::vector<Labels>& cases) {
  Table table;
  for (const Labels& labels : cases) {
    for (const auto& [path, value] : labels) {
      if (std::ranges::find(table.columns, path) == table.columns.end()) table.columns.push_back(path);
    }
  }
  table.units.resize(table.columns.size());
  table.rows.resize(cases.size(), std::vector<Cell>(table.columns.size()));
  for (std::size_t row = 0; row < cases.size(); ++row) {
    for (const auto& [path, value] : cases[row]) {
      const auto column = std::ranges::find(table.columns, path) - table.columns.begin();
      table.rows[row][static_cast<std::size_t>(column)] = value;
    }
  }
  for (std::size_t i = 0; i < table.columns.size(); ++i) read_quantities(table, i);
  return table;
}

void read_quantities(Table& table, std::size_t column) {
  std::vector<std::pair<std::size_t, double>> numbers;
  std::string unit;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto* words = std::get_if<std::string>(&table.rows[row][column]);
    if (words == nullptr) continue;
    const auto value = quantity(*words);
    if (!value || (!numbers.empty() && value->second != unit)) return;
    unit = value->second;
    numbers.emplace_back(row, value->first);
  }
  if (numbers.empty()) return;
  table.units[column] = unit;
  for (const auto& [row, value] : numbers) table.rows[row][column] = value;
}

void align_right(Table& table, std::size_t column) {
  std::size_t most = width(table.columns[column]);
  const auto texts = [&](auto&& each) {
    for (auto& row : table.rows) {
      if (auto* words = std::get_if<std::string>(&row[column])) each(*words);
    }
  };
  texts([&](std::string& words) { most = std::max(most, width(words)); });
  texts([&](std::string& words) { words = aligned(words, most, true); });
}

std::optional<std::pair<double, std::string>> quantity(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  if (rest == end) return std::pair(value, std::string());
  const std::string unit(rest + 1, end);
  const bool one = unit.find(' ') == std::string::npos || unit == "Pa s";  // The one unit of a field with a space.
  if (*rest != ' ' || unit.empty() || !one) return std::nullopt;
  return std::pair(value, unit);
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_heading(const std::string& name, const std::string& unit) {
  return csv_field(unit.empty() ? name : fmt::format("{}[{}]", name, unit));
}

}  // namespace seapile::present
