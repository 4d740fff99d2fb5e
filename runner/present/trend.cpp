#include "runner/present/trend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "runner/present/table.h"

namespace seapile::present {
namespace {

using store::Cell;
using store::ColumnKind;
using store::Table;

/// A case's density may be asked for in many ways; what it came to is the abscissa, so lines are not told apart by it.
constexpr const char* kPreparation = "bed.preparation.";

/// One completed run with both numbers.
struct Run {
  std::vector<Cell> labels;  ///< the seed apart
  double x = 0, y = 0;
  Cell bed, effect;
};

/// The runs of a query's answer, and where its columns are.
struct Runs {
  std::vector<std::size_t> label_columns;
  std::vector<Run> runs;
  std::size_t left_out = 0;
};

/// The first of a question's own columns, which stand at the end of the answer.
std::size_t first_asked(const Table& each, const TrendQuestion& question) {
  return each.columns.size() - trend_columns(question).size();
}

Runs runs_of(const Table& each, const TrendQuestion& question) {
  Runs result;
  for (std::size_t i = 0; i < each.columns.size(); ++i) {
    if (each.kinds[i] == ColumnKind::label && each.columns[i] != kSeed) result.label_columns.push_back(i);
  }
  const auto outcome =
      static_cast<std::size_t>(std::ranges::find(each.kinds, ColumnKind::outcome) - each.kinds.begin());
  const std::size_t x = first_asked(each, question), y = x + 1, bed = x + 2, effect = x + 3;
  for (const auto& row : each.rows) {
    for (const std::size_t column : {x, y}) {
      if (std::holds_alternative<std::string>(row[column])) {
        throw std::invalid_argument(fmt::format("{} is no number", each.columns[column]));
      }
    }
    const auto *abscissa = std::get_if<double>(&row[x]), *ordinate = std::get_if<double>(&row[y]);
    if (row[outcome] != Cell{std::string("completed")} || abscissa == nullptr || ordinate == nullptr) {
      ++result.left_out;
      continue;
    }
    Run run{{}, *abscissa, *ordinate, row[bed], question.effect.empty() ? Cell{} : row[effect]};
    for (const std::size_t column : result.label_columns) run.labels.push_back(row[column]);
    result.runs.push_back(std::move(run));
  }
  if (result.runs.empty()) {
    throw std::invalid_argument(fmt::format("no completed run has both {} and {}", question.of, question.against));
  }
  return result;
}

std::string label_text(const std::string& path, const Cell& value, const std::string& unit) {
  const auto last = path.find_last_of('.');
  const auto* number = std::get_if<double>(&value);
  const auto* words = std::get_if<std::string>(&value);
  const std::string text = number  ? fmt::format("{:g}{}{}", *number, unit.empty() ? "" : " ", unit)
                           : words ? *words
                                   : "-";
  return fmt::format("{} {}", last == std::string::npos ? path : path.substr(last + 1), text);
}

std::string series_of(const Trend& trend, const std::vector<Cell>& labels) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::string& path = trend.label_columns[i];
    if (path == trend.question.against || path.starts_with(kPreparation)) continue;
    words.push_back(label_text(path, labels[i], trend.label_units[i]));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

/// The label column of the effect's axis among the labels.
std::size_t axis_of(const Trend& trend) {
  const auto found = std::ranges::find(trend.label_columns, trend.question.effect);
  if (found == trend.label_columns.end()) {
    throw std::invalid_argument(fmt::format("{} is no axis of the study; its axes are {}", trend.question.effect,
                                            fmt::join(trend.label_columns, ", ")));
  }
  return static_cast<std::size_t>(found - trend.label_columns.begin());
}

/// The run on the same bed that differs in the axis alone and has the reference's value there; null: none.
const Run* partner(const Run& run, const std::vector<Run>& runs, std::size_t axis, const Cell& reference) {
  const auto matches = [&](const Run& other) {
    if (other.effect != reference || other.bed != run.bed) return false;
    for (std::size_t i = 0; i < run.labels.size(); ++i) {
      if (i != axis && run.labels[i] != other.labels[i]) return false;
    }
    return true;
  };
  const auto found = std::ranges::find_if(runs, matches);
  return found == runs.end() ? nullptr : &*found;
}

/// Pairs the runs of each case with those at the axis' smallest value.
void add_effect(Trend& trend, const std::vector<Run>& runs, const std::vector<std::vector<const Run*>>& members) {
  const std::size_t axis = axis_of(trend);
  const bool numbers =
      std::ranges::all_of(runs, [](const Run& run) { return std::holds_alternative<double>(run.effect); });
  const Run* lowest = &runs[0];
  for (const Run& run : runs) {
    if (numbers && std::get<double>(run.effect) < std::get<double>(lowest->effect)) lowest = &run;
  }
  const Cell reference = lowest->effect;
  trend.reference = label_text(trend.question.effect, lowest->labels[axis], trend.label_units[axis]);
  std::size_t pairs = 0;
  for (std::size_t k = 0; k < trend.cases.size(); ++k) {
    if (members[k][0]->effect == reference) continue;
    std::vector<double> at_reference, here;
    for (const Run* run : members[k]) {
      const Run* other = partner(*run, runs, axis, reference);
      if (other == nullptr) {
        ++trend.unpaired;
        continue;
      }
      if (!(run->y > 0 && other->y > 0)) {
        throw std::invalid_argument(fmt::format("{} is not positive in every run: it has no ratio", trend.question.of));
      }
      at_reference.push_back(other->y);
      here.push_back(run->y);
      trend.cases[k].ratios.emplace_back(run->x, run->y / other->y);
    }
    trend.cases[k].ratio = paired_ratio(at_reference, here, trend.question.level);
    pairs += here.size();
  }
  if (pairs == 0) {
    throw std::invalid_argument(
        fmt::format("no two runs differ in {} alone and stand on the same bed: its effect cannot be paired",
                    trend.question.effect));
  }
}

}  // namespace

std::vector<std::string> trend_columns(const TrendQuestion& question) {
  std::vector<std::string> columns = {question.against, question.of, "bed:case"};
  if (!question.effect.empty()) columns.push_back(question.effect);
  return columns;
}

Trend trend(const Table& given, const TrendQuestion& question) {
  Table each = given;
  Trend trend;
  trend.question = question;
  for (std::size_t i = 0; i < each.columns.size(); ++i) {
    if (each.kinds[i] == ColumnKind::label) read_quantities(each, i);
  }
  const Runs found = runs_of(each, question);
  trend.left_out = found.left_out;
  trend.packings = std::ranges::any_of(found.runs, [](const Run& run) { return run.bed != Cell{}; });
  for (const std::size_t column : found.label_columns) {
    trend.label_columns.push_back(each.columns[column]);
    trend.label_units.push_back(each.units[column]);
  }
  const std::size_t last = first_asked(each, question);
  trend.against_unit = each.units[last];
  trend.of_unit = each.units[last + 1];
  if (each.kinds[last + 1] != ColumnKind::metric) {
    throw std::invalid_argument(fmt::format("{} is no metric", question.of));
  }
  const bool measured = each.kinds[last] == ColumnKind::metric;

  std::vector<std::vector<const Run*>> members;
  for (const Run& run : found.runs) {
    const auto same = std::ranges::find(trend.cases, run.labels, &TrendCase::labels);
    const auto k = static_cast<std::size_t>(same - trend.cases.begin());
    if (same == trend.cases.end()) {
      trend.cases.emplace_back().labels = run.labels;
      members.emplace_back();
    }
    members[k].push_back(&run);
  }
  for (std::size_t k = 0; k < trend.cases.size(); ++k) {
    TrendCase& one = trend.cases[k];
    std::vector<double> x, y;
    for (const Run* run : members[k]) {
      x.push_back(run->x);
      y.push_back(run->y);
      one.runs.emplace_back(run->x, run->y);
    }
    one.series = series_of(trend, one.labels);
    one.x = mean_interval(x, question.level);
    // What was asked for is known; it has no scatter of its own.
    if (!measured) one.x.low = one.x.high = std::numeric_limits<double>::quiet_NaN();
    one.y = mean_interval(y, question.level);
  }
  if (!question.effect.empty()) add_effect(trend, found.runs, members);
  return trend;
}

Grouped trend_table(const Trend& trend) {
  Grouped grouped;
  grouped.level = trend.question.level;
  grouped.left_out = trend.left_out;
  Table& table = grouped.table;
  table.columns = trend.label_columns;
  table.units = trend.label_units;
  const auto add = [&](const std::string& name, const std::string& unit) {
    table.columns.push_back(name);
    table.units.push_back(unit);
  };
  const auto add_mean = [&](const std::string& name, const std::string& unit) {
    grouped.means.push_back(table.columns.size());
    for (const char* what : {".mean", ".low", ".high"}) add(name + what, unit);
  };
  add("n", "");
  add_mean(trend.question.against, trend.against_unit);
  add_mean(trend.question.of, trend.of_unit);
  if (!trend.question.effect.empty()) {
    add("pairs", "");
    add_mean("ratio", "");
  }
  for (const TrendCase& one : trend.cases) {
    auto& row = table.rows.emplace_back(one.labels);
    const auto put = [&](const Interval& interval) {
      for (const double value : {interval.mean, interval.low, interval.high}) {
        row.push_back(std::isnan(value) ? Cell{} : Cell{value});
      }
    };
    const std::size_t n = one.runs.size();
    grouped.most = std::max(grouped.most, n);
    grouped.least = grouped.least > 0 ? std::min(grouped.least, n) : n;
    row.emplace_back(static_cast<double>(n));
    put(one.x);
    put(one.y);
    if (trend.question.effect.empty()) continue;
    row.push_back(one.ratio ? Cell{static_cast<double>(one.ratio->n)} : Cell{});
    put(one.ratio.value_or(Interval{}));
  }
  return grouped;
}

std::string trend_remark(const Trend& trend, Format format) {
  std::string lines = remark(trend_table(trend), format);
  if (const auto at = lines.find(kOnePacking); !trend.packings && at != std::string::npos)
    lines.erase(at, std::string_view(kOnePacking).size() + 1);
  if (trend.reference.empty()) return lines;
  if (format == Format::table) {
    lines += fmt::format("ratio: geometric mean over pairs on the same bed, {} over its value at {}\n",
                         trend.question.of, trend.reference);
  }
  if (trend.unpaired > 0) {
    lines += fmt::format("{} run{} no partner at {} on the same bed\n", trend.unpaired,
                         trend.unpaired == 1 ? " has" : "s have", trend.reference);
  }
  return lines;
}

}  // namespace seapile::present
