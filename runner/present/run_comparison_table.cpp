#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "runner/present/run_comparison.h"

namespace seapile::present {
namespace {

using store::Cell;
using store::Table;

constexpr std::array kWords = {"identical", "rounding", "different"};

Cell words(const std::string& text) { return text.empty() ? Cell{} : Cell{text}; }

Cell number(double value) { return std::isfinite(value) ? Cell{value} : Cell{}; }

using Sections = std::array<std::pair<const char*, const std::vector<Difference>*>, 4>;

Sections sections_of(const RunComparison& comparison) {
  return {{{"parameter", &comparison.parameters},
           {"numerics", &comparison.numerics},
           {"code", &comparison.code},
           {"environment", &comparison.environment}}};
}

std::string short_number(double value) { return std::isnan(value) ? "-" : fmt::format("{:.6g}", value); }

std::string share(double relative) {
  if (relative == 0) return "0";
  return std::isfinite(relative) ? fmt::format("{:.2e}", relative) : "-";
}

std::string titled(const char* title, Table table, std::initializer_list<std::size_t> numbers) {
  if (table.rows.empty()) return "";
  for (const std::size_t column : numbers) align_right(table, column);
  return fmt::format("{}\n\n{}\n", title, text(table, Format::table));
}

}  // namespace

Table comparison_table(const RunComparison& comparison) {
  Table table{
      {"section", "name", "a", "b", "unit", "difference", "largest", "over", "at"}, std::vector<std::string>(9), {}};
  table.rows.push_back({"case", "case", comparison.case_a, comparison.case_b, {}, {}, {}, {}, {}});
  table.rows.push_back({"case", "run", comparison.run_a, comparison.run_b, {}, {}, {}, {}, {}});
  table.rows.push_back({"case", "state", words(comparison.state_a), words(comparison.state_b), {}, {}, {}, {}, {}});
  for (const auto& [section, list] : sections_of(comparison)) {
    for (const Difference& one : *list)
      table.rows.push_back({section, one.name, words(one.a), words(one.b), words(one.unit), {}, {}, {}, {}});
  }
  for (const SeriesDistance& curve : comparison.curves)
    table.rows.push_back({"curve",
                          curve.column,
                          {},
                          {},
                          words(curve.unit),
                          number(curve.distance.relative),
                          number(curve.distance.largest),
                          curve.over,
                          number(curve.distance.at)});
  for (const MetricDistance& metric : comparison.metrics)
    table.rows.push_back({"metric",
                          metric.name,
                          number(metric.a),
                          number(metric.b),
                          metric.unit,
                          number(metric.relative),
                          number(std::abs(metric.b - metric.a)),
                          {},
                          {}});
  const char* word = kWords[static_cast<std::size_t>(comparison.likeness)];
  table.rows.push_back({"verdict", word, {}, {}, {}, number(comparison.largest), {}, words(verdict(comparison)), {}});
  return table;
}

std::string comparison_text(const RunComparison& comparison) {
  std::string all =
      fmt::format("A  {} run {}, state {}\nB  {} run {}, state {}\n\n", comparison.case_a, comparison.run_a,
                  comparison.state_a.empty() ? "none" : comparison.state_a, comparison.case_b, comparison.run_b,
                  comparison.state_b.empty() ? "none" : comparison.state_b);
  for (const auto& [section, list] : sections_of(comparison)) {
    Table table{{section, "A", "B", "unit"}, std::vector<std::string>(4), {}};
    for (const Difference& one : *list) table.rows.push_back({one.name, words(one.a), words(one.b), words(one.unit)});
    all += titled(fmt::format("other {}", section).c_str(), table, {});
  }
  Table curves{
      {"column", "unit", "over", "from", "to", "L2 distance", "largest", "at"}, std::vector<std::string>(8), {}};
  for (const SeriesDistance& curve : comparison.curves) {
    const CurveDistance& d = curve.distance;
    curves.rows.push_back({curve.column, curve.unit, fmt::format("{} [{}]", curve.over, curve.over_unit),
                           short_number(d.from), short_number(d.to), share(d.relative), short_number(d.largest),
                           short_number(d.at)});
  }
  all += titled("curves, over what both cover", curves, {3, 4, 5, 6, 7});
  Table metrics{{"metric", "A", "B", "unit", "relative"}, std::vector<std::string>(5), {}};
  for (const MetricDistance& metric : comparison.metrics)
    metrics.rows.push_back(
        {metric.name, short_number(metric.a), short_number(metric.b), metric.unit, share(metric.relative)});
  all += titled("metrics", metrics, {1, 2, 4});
  return all + verdict(comparison) + "\n";
}

}  // namespace seapile::present
