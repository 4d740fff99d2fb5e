#include "runner/present/replicates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "runner/store/label_text.h"

namespace seapile::present {
namespace {

using store::Cell;
using store::Table;

/// Rows of a table that are packings of the same case.
struct Packings {
  std::vector<Cell> key;
  std::vector<std::size_t> rows;  ///< completed
};

Cell number(double value) { return std::isnan(value) ? Cell{} : Cell{value}; }

/// The column's numbers over some rows; absent when one of them is none.
std::optional<std::vector<double>> numbers(const Table& table, std::size_t column,
                                           const std::vector<std::size_t>& rows) {
  std::vector<double> values;
  for (const std::size_t row : rows) {
    const auto* value = std::get_if<double>(&table.rows[row][column]);
    if (value == nullptr) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

Cell common(const Table& table, std::size_t column, const std::vector<std::size_t>& rows) {
  if (rows.empty()) return {};
  const Cell& first = table.rows[rows[0]][column];
  const bool agree = std::ranges::all_of(rows, [&](std::size_t row) { return table.rows[row][column] == first; });
  return agree ? first : Cell{};
}

std::vector<Packings> packings(const Table& each, const std::vector<Role>& roles, std::size_t& left_out) {
  std::vector<Packings> cases;
  for (std::size_t row = 0; row < each.rows.size(); ++row) {
    std::vector<Cell> key;
    bool completed = true;
    for (std::size_t i = 0; i < roles.size(); ++i) {
      if (roles[i] == Role::key) key.push_back(each.rows[row][i]);
      if (roles[i] == Role::outcome) completed = each.rows[row][i] == Cell{std::string("completed")};
    }
    auto found = std::ranges::find(cases, key, &Packings::key);
    if (found == cases.end()) found = cases.insert(cases.end(), Packings{std::move(key), {}});
    if (completed) {
      found->rows.push_back(row);
    } else {
      ++left_out;
    }
  }
  return cases;
}

/// The columns of the table of cases, and which of them are means.
void add_columns(Grouped& grouped, const Table& each, const std::vector<Role>& roles) {
  Table& table = grouped.table;
  const auto add = [&](const std::string& name, const std::string& unit) {
    table.columns.push_back(name);
    table.units.push_back(unit);
  };
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (roles[i] == Role::key) add(each.columns[i], each.units[i]);
  }
  add("n", "");
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (roles[i] == Role::mean) {
      grouped.means.push_back(table.columns.size());
      for (const char* what : {".mean", ".low", ".high"}) add(each.columns[i] + what, each.units[i]);
    } else if (roles[i] == Role::total || roles[i] == Role::common) {
      add(each.columns[i], each.units[i]);
    }
  }
}

}  // namespace

std::string legend_text(const Labels& labels) {
  std::vector<std::string> words;
  for (const auto& [path, value] : labels) {
    if (path == kSeed) continue;
    words.push_back(store::short_label_text(path, value));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

Grouped group(const Table& each, const std::vector<Role>& roles, double level) {
  Grouped grouped;
  grouped.level = level;
  add_columns(grouped, each, roles);
  const std::vector<Packings> cases = packings(each, roles, grouped.left_out);
  for (const auto& [key, rows] : cases) {
    std::vector<Cell>& line = grouped.table.rows.emplace_back(key);
    line.emplace_back(static_cast<double>(rows.size()));
    for (std::size_t i = 0; i < roles.size(); ++i) {
      if (roles[i] == Role::common) line.push_back(common(each, i, rows));
      if (roles[i] != Role::mean && roles[i] != Role::total) continue;
      const auto values = numbers(each, i, rows).value_or(std::vector<double>{});
      if (roles[i] == Role::total) {
        line.push_back(values.empty() ? Cell{} : Cell{sum(values)});
        continue;
      }
      const Interval mean = mean_interval(values, level);
      for (const double value : {mean.mean, mean.low, mean.high}) line.push_back(number(value));
    }
  }
  for (const Packings& one : cases) {
    const std::size_t n = one.rows.size();
    grouped.most = std::max(grouped.most, n);
    if (n > 0) grouped.least = grouped.least > 0 ? std::min(grouped.least, n) : n;
  }
  return grouped;
}

bool has_replicates(const Table& each) {
  for (std::size_t i = 0; i < each.kinds.size(); ++i) {
    if (each.kinds[i] == store::ColumnKind::label && each.columns[i] == kSeed) return true;
  }
  return false;
}

Grouped group_query(Table each, double level) {
  std::vector<Role> roles;
  for (std::size_t i = 0; i < each.columns.size(); ++i) {
    switch (each.kinds[i]) {
      case store::ColumnKind::identity:
        roles.push_back(Role::dropped);
        break;
      case store::ColumnKind::outcome:
        roles.push_back(Role::outcome);
        break;
      case store::ColumnKind::label:
        roles.push_back(each.columns[i] == kSeed ? Role::dropped : Role::key);
        read_quantities(each, i);
        break;
      case store::ColumnKind::fact:
      case store::ColumnKind::parameter:
        roles.push_back(Role::common);
        break;
      case store::ColumnKind::metric:
        roles.push_back(Role::mean);
        break;
    }
  }
  return group(each, roles, level);
}

std::string remark(const Grouped& grouped, Format format) {
  std::string lines;
  const auto add = [&](const std::string& line) { lines += line + "\n"; };
  if (grouped.most > 1) {
    if (format == Format::table)
      add(fmt::format("± is the {:g} % interval of the mean over n packings (Student's t)", 100 * grouped.level));
    if (grouped.least == 1) add("n = 1 is one packing: no interval");
  } else if (grouped.most == 1) {
    add(kOnePacking);
  }
  if (grouped.left_out > 0) {
    add(fmt::format("{} run{} not completed and left out", grouped.left_out, grouped.left_out == 1 ? " is" : "s are"));
  }
  return lines;
}

}  // namespace seapile::present
