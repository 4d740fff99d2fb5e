#include "runner/present/trade_table.h"

#include <fmt/format.h>

#include <cmath>

namespace seapile::present {
namespace {

using store::Cell;

constexpr double kPercent = 100;

Cell number(double value) {
  Cell cell;
  if (!std::isnan(value)) cell = value;
  return cell;
}

std::string place_of(const TradedGroup& group, const std::string& variant) {
  std::string place;
  for (const auto& [path, value] : group.labels) place += fmt::format("{}={}, ", path, value);
  return place + variant;
}

std::string list_of(const std::vector<std::string>& items) {
  std::string list;
  for (const std::string& item : items) list += (list.empty() ? "" : "; ") + item;
  return list;
}

/// Of fewer pairs no choice of signs is as rare as one in twenty, whatever they say.
constexpr std::size_t kLeastPairs = 6;

/// Whether a difference as large is no rarer than one in twenty without any.
bool is_chance(const TradeError& error) { return error.n >= kLeastPairs && error.chance > kAlpha; }

/// The levels of each group.
using Judged = std::vector<std::vector<TradeLevel>>;

Judged judged_of(const std::vector<TradedGroup>& groups) {
  Judged judged;
  for (const TradedGroup& group : groups) judged.push_back(judge(group));
  return judged;
}

Grouped table_of(const std::vector<TradedGroup>& groups, const Judged& judged, bool ablation) {
  Grouped grouped;
  store::Table& table = grouped.table;
  std::vector<Labels> labels;
  for (const TradedGroup& group : groups) labels.insert(labels.end(), group.variants.size(), group.labels);
  table = label_table(labels);
  const auto add = [&](std::string name, const char* unit) {
    table.columns.push_back(std::move(name));
    table.units.emplace_back(unit);
  };
  add("variant", "");
  for (const char* name : {"runs", "asked"}) add(name, "-");
  add("cpu", "s");
  add("cost", "-");
  add("memory", "MB");
  add("steps", "-");
  for (const std::string& metric : groups.front().metrics) {
    const std::string what = (ablation ? "change:" : "error:") + metric;
    grouped.means.push_back(table.columns.size());
    for (const char* end : {".mean", ".low", ".high"}) add(what + end, "%");
    add("bound:" + metric, "%");
    add("chance:" + metric, "-");
    if (!ablation) add("frontier:" + metric, "-");
  }
  add("failure", "");

  std::size_t row = 0;
  for (const auto& levels : judged) {
    for (const TradeLevel& level : levels) {
      auto& cells = table.rows[row++];
      cells.emplace_back(level.name);
      cells.push_back(number(static_cast<double>(level.completed)));
      cells.push_back(number(static_cast<double>(level.asked)));
      for (const double value : {level.cpu_seconds, level.cost}) cells.push_back(number(value));
      cells.push_back(number(level.completed > 0 ? level.peak_memory_mb : std::nan("")));
      cells.push_back(number(level.steps));
      for (std::size_t m = 0; m < level.errors.size(); ++m) {
        const TradeError& error = level.errors[m];
        for (const double value : {error.error.mean, error.error.low, error.error.high, error.bound})
          cells.push_back(number(kPercent * value));
        cells.push_back(number(error.n >= kLeastPairs ? error.chance : std::nan("")));
        if (!ablation) cells.push_back(number(level.on_frontier[m] ? 1 : 0));
      }
      Cell failure;
      if (!level.failures.empty()) failure = list_of(level.failures);
      cells.push_back(failure);
    }
  }
  return grouped;
}

std::string own_error_of(const std::vector<TradedGroup>& groups, const Judged& judged) {
  const std::string& coarser = groups.front().coarser;
  if (coarser.empty()) return "unknown: the study names no coarser variant";
  std::vector<double> bounds(groups.front().metrics.size(), 0);
  for (const auto& levels : judged)
    for (const TradeLevel& level : levels) {
      if (level.name != coarser) continue;
      for (std::size_t m = 0; m < bounds.size(); ++m) {
        const double bound = level.errors[m].bound;
        if (!(bound <= bounds[m])) bounds[m] = bound;  // also when it is none
      }
    }
  std::string text;
  for (std::size_t m = 0; m < bounds.size(); ++m) {
    if (m > 0) text += ", ";
    text += groups.front().metrics[m];
    text += std::isnan(bounds[m]) ? " unknown" : fmt::format(" at most {:.2g} %", kPercent * bounds[m]);
  }
  return fmt::format("{} (95 %), by what separates it from \"{}\"", text, coarser);
}

}  // namespace

Grouped trade_table(const std::vector<TradedGroup>& groups, bool ablation) {
  return table_of(groups, judged_of(groups), ablation);
}

std::string trade_text(const std::vector<TradedGroup>& groups, bool ablation) {
  const Judged judged = judged_of(groups);
  const Grouped grouped = table_of(groups, judged, ablation);
  std::string lines = text(grouped.table, Format::table, grouped.means) + "\n";
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const TradedGroup& group = groups[g];
    for (const TradeLevel& level : judged[g]) {
      if (!level.failures.empty())
        lines += fmt::format("{}: {} of {} runs have no result: {}\n", place_of(group, level.name),
                             level.asked - level.completed, level.asked, list_of(level.failures));
      for (std::size_t m = 0; m < level.errors.size(); ++m) {
        const TradeError& error = level.errors[m];
        if (!is_chance(error)) continue;
        lines += fmt::format(
            "{}: {} is not distinguishable from {}; as much or more by chance in {:.2g} of cases, "
            "at most {:.2g} % in truth\n",
            place_of(group, level.name), group.metrics[m],
            group.against.empty() ? "the exact value" : "\"" + group.against + "\"", error.chance,
            kPercent * error.bound);
      }
    }
  }
  if (!groups.front().coarser.empty()) lines += "the reference's own error: " + own_error_of(groups, judged) + "\n";
  if (!ablation) lines += "frontier: 1 where nothing that was measured is both cheaper and closer, by the bound\n";
  lines += "bound: of the error's size, 95 %; cost: CPU time over that of the same packing's ";
  return lines + (groups.front().against.empty() ? "(none)\n" : "\"" + groups.front().against + "\"\n");
}

std::string own_error(const std::vector<TradedGroup>& groups) { return own_error_of(groups, judged_of(groups)); }

}  // namespace seapile::present
