#include "runner/present/check_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "runner/store/label_text.h"

namespace seapile::present {
namespace {

using store::Cell;
using store::Table;

constexpr std::size_t kShownDigits = 10;  // of a case id
constexpr int kMostDecimals = 12;
constexpr double kLargestFixed = 1e9;

/// The id of a case, for people; nothing where packings are put together.
Cell case_cell(const Comparison& comparison) {
  return comparison.case_ids.size() == 1 ? Cell{comparison.case_ids[0].substr(0, kShownDigits)} : Cell{};
}

Cell number(double value) { return std::isnan(value) ? Cell{} : Cell{value}; }

/// A table of the labels with other columns before and behind them, whose cells are still to come.
Table with_labels(const std::vector<Comparison>& comparisons, const std::vector<std::string>& before,
                  const std::vector<std::string>& behind) {
  std::vector<Labels> labels;
  for (const Comparison& comparison : comparisons) labels.push_back(comparison.labels);
  Table table = label_table(labels);
  table.columns.insert(table.columns.begin(), before.begin(), before.end());
  table.columns.insert(table.columns.end(), behind.begin(), behind.end());
  table.units.insert(table.units.begin(), before.size(), "");
  table.units.insert(table.units.end(), behind.size(), "");
  return table;
}

/// Decimals that give a positive number two significant digits.
int decimals(double number) { return 1 - static_cast<int>(std::floor(std::log10(number))); }

/// Numbers of one comparison as text: with the unit's prefix, and as many decimals as give the tolerance two digits; up
/// to three more where a value far below its tolerance would show none.
class Shown {
 public:
  Shown(const Comparison& comparison, const Judgement& judgement) : unit_(comparison.unit) {
    const double value = std::isfinite(judgement.mean.mean) ? std::abs(judgement.mean.mean) : 0;
    scale_ = prefixed(unit_, std::max(value, std::abs(comparison.reference.value_or(0))));
    if (!(comparison.tolerance > 0)) return;
    const int of_tolerance = decimals(comparison.tolerance * scale_);
    const int of_value = value > 0 ? std::min(decimals(value * scale_), of_tolerance + 3) : of_tolerance;
    decimals_ = std::max({0, of_tolerance, of_value});
  }

  const std::string& unit() const { return unit_; }

  std::string operator()(double number) const {
    if (std::isnan(number)) return "-";
    double scaled = number * scale_;
    if (decimals_ > kMostDecimals || std::abs(scaled) >= kLargestFixed) return fmt::format("{:.6g}", scaled);
    if (std::abs(scaled) < 0.5 * std::pow(10.0, -decimals_)) scaled = 0;  // not "-0.0"
    return fmt::format("{:.{}f}", scaled, decimals_);
  }

 private:
  std::string unit_;
  double scale_ = 1;
  int decimals_ = kMostDecimals + 1;
};

std::string mean_text(const Shown& shown, const Interval& mean) {
  const double half = (mean.high - mean.low) / 2;
  return std::isnan(half) ? shown(mean.mean) : fmt::format("{} ± {}", shown(mean.mean), shown(half));
}

std::string count_text(const Comparison& comparison) {
  const std::size_t n = comparison.values.size(), all = comparison.case_ids.size();
  return n == all ? fmt::format("{}", n) : fmt::format("{} of {}", n, all);
}

Cell number(const std::optional<double>& value) { return value ? number(*value) : Cell{}; }

const char* name_of(Against against) {
  return against == Against::published ? "published" : against == Against::bounds ? "bounds" : "accepted";
}

void align_all_right(Table& table, std::initializer_list<const char*> names) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (std::ranges::find(names, table.columns[i]) != names.end()) align_right(table, i);
  }
}

/// Values within bounds that a study sets itself, for people: in the metric's own unit and in six digits, as a bound is
/// often many times larger than what it bounds.
Table bounds_table(const std::vector<Comparison>& comparisons) {
  Table table = with_labels(comparisons, {"metric", "case"}, {"n", "value", "unit", "at least", "at most", "verdict"});
  const auto digits = [](const std::optional<double>& value) {
    return value && !std::isnan(*value) ? fmt::format("{:.6g}", *value) : std::string("-");
  };
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    const Comparison& comparison = comparisons[i];
    const Judgement judgement = judge(comparison);
    const double half = (judgement.mean.high - judgement.mean.low) / 2;
    std::vector<Cell> row = {comparison.metric, case_cell(comparison)};
    row.insert(row.end(), table.rows[i].begin(), table.rows[i].end());
    for (const std::string& text :
         {count_text(comparison),
          digits(judgement.mean.mean) + (std::isnan(half) ? "" : fmt::format(" ± {:.2g}", half)), comparison.unit,
          digits(comparison.at_least), digits(comparison.at_most), words(judgement.finding)})
      row.emplace_back(text);
    table.rows[i] = std::move(row);
  }
  align_all_right(table, {"n", "value", "at least", "at most"});
  return table;
}

/// The comparisons of one kind as a table for people. Of drift every row is one run, and what it was accepted of is
/// told where it failed.
Table reference_table(const std::vector<Comparison>& comparisons, Against against) {
  const bool published = against == Against::published;
  const auto sources = sources_of(comparisons);
  std::vector<std::string> behind = {"value",      "unit",      published ? "reference" : "accepted",
                                     "difference", "tolerance", "verdict"};
  if (published) {
    behind.insert(behind.begin(), "n");
    behind.emplace_back("source");
  }
  Table table = with_labels(comparisons, {"metric", "case"}, behind);
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    const Comparison& comparison = comparisons[i];
    const Judgement judgement = judge(comparison);
    const Shown shown(comparison, judgement);
    const bool known = comparison.reference.has_value();
    std::vector<Cell> row = {comparison.metric, case_cell(comparison)};
    row.insert(row.end(), table.rows[i].begin(), table.rows[i].end());
    if (published) row.emplace_back(count_text(comparison));
    for (const std::string& text :
         {mean_text(shown, judgement.mean), shown.unit(), known ? shown(*comparison.reference) : "-",
          shown(judgement.difference), known ? shown(comparison.tolerance) : "-", words(judgement.finding)})
      row.emplace_back(text);
    const auto source = std::ranges::find(sources, comparison.source) - sources.begin() + 1;
    if (published) row.emplace_back(static_cast<double>(source));
    table.rows[i] = std::move(row);
  }
  align_all_right(table, {"n", "value", "reference", "accepted", "difference", "tolerance"});
  return table;
}

/// "FAILED  q_c, pile.tip=flat: ...".
std::string failure(const Comparison& comparison, const Judgement& judgement) {
  const Shown shown(comparison, judgement);
  std::string line = "FAILED  " + comparison.metric;
  for (const auto& [path, value] : comparison.labels) line += ", " + store::label_text(path, value);
  if (comparison.against == Against::bounds) {
    if (std::isnan(judgement.mean.mean)) return line + ": is no number";
    const bool above = judgement.difference > 0;
    const std::string unit = comparison.unit == "-" || comparison.unit.empty() ? "" : " " + comparison.unit;
    return line + fmt::format(": {:.6g}{}, {} {:.6g}{}", judgement.mean.mean, unit, above ? "at most" : "at least",
                              (above ? comparison.at_most : comparison.at_least).value_or(std::nan("")), unit);
  }
  line += fmt::format(": {} {} away, tolerance {} {}", shown(std::abs(judgement.difference)), shown.unit(),
                      shown(comparison.tolerance), shown.unit());
  line += comparison.against == Against::published ? "" : fmt::format("; accepted of {}", comparison.source);
  return comparison.reason.empty() ? line : fmt::format("{} ({})", line, comparison.reason);
}

}  // namespace

std::vector<Comparison> of_kind(const std::vector<Comparison>& comparisons, Against against) {
  std::vector<Comparison> chosen;
  std::ranges::copy_if(comparisons, std::back_inserter(chosen),
                       [&](const Comparison& comparison) { return comparison.against == against; });
  return chosen;
}

std::vector<std::string> sources_of(const std::vector<Comparison>& comparisons) {
  std::vector<std::string> sources;
  for (const Comparison& comparison : comparisons) {
    if (std::ranges::find(sources, comparison.source) == sources.end()) sources.push_back(comparison.source);
  }
  return sources;
}

Table shown_checks(const std::vector<Comparison>& comparisons, Against against) {
  return against == Against::bounds ? bounds_table(comparisons) : reference_table(comparisons, against);
}

Table check_table(const std::vector<Comparison>& comparisons) {
  Table table = with_labels(comparisons, {"against", "metric", "case"},
                            {"n", "value", "low", "high", "unit", "reference", "difference", "tolerance", "at_least",
                             "at_most", "verdict", "source", "reason"});
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    const Comparison& comparison = comparisons[i];
    const Judgement judgement = judge(comparison);
    const bool known = comparison.reference.has_value();
    std::vector<Cell> row = {name_of(comparison.against), comparison.metric, case_cell(comparison)};
    row.insert(row.end(), table.rows[i].begin(), table.rows[i].end());
    row.emplace_back(static_cast<double>(comparison.values.size()));
    for (const double value : {judgement.mean.mean, judgement.mean.low, judgement.mean.high})
      row.push_back(number(value));
    row.emplace_back(comparison.unit);
    row.push_back(known ? Cell{*comparison.reference} : Cell{});
    row.push_back(number(judgement.difference));
    row.push_back(known ? Cell{comparison.tolerance} : Cell{});
    row.push_back(number(comparison.at_least));
    row.push_back(number(comparison.at_most));
    row.emplace_back(words(judgement.finding));
    for (const std::string& text : {comparison.source, comparison.reason}) row.push_back(text.empty() ? Cell{} : text);
    table.rows[i] = std::move(row);
  }
  return table;
}

std::string check_text(const std::vector<Comparison>& comparisons) {
  const auto published = of_kind(comparisons, Against::published), accepted = of_kind(comparisons, Against::accepted);
  std::string all;
  if (!published.empty()) {
    all += text(shown_checks(published, Against::published), Format::table) + "\n";
    const auto sources = sources_of(published);
    for (std::size_t i = 0; i < sources.size(); ++i) all += fmt::format("source {}: {}\n", i + 1, sources[i]);
  }
  const auto bounds = of_kind(comparisons, Against::bounds);
  if (!bounds.empty())
    all += fmt::format("{}bounds\n\n{}", all.empty() ? "" : "\n",
                       text(shown_checks(bounds, Against::bounds), Format::table));
  if (!accepted.empty())
    all += fmt::format("\ndrift\n\n{}", text(shown_checks(accepted, Against::accepted), Format::table));
  return all;
}

std::string check_remark(const std::vector<Comparison>& comparisons, bool packings) {
  std::string lines;
  std::size_t most = 0, missing = 0, underpowered = 0;
  for (const Comparison& comparison : comparisons) {
    const Judgement judgement = judge(comparison);
    if (judgement.finding == Finding::failed) lines += failure(comparison, judgement) + "\n";
    most = std::max(most, comparison.values.size());
    missing += judgement.finding == Finding::missing ? 1 : 0;
    underpowered += judgement.finding == Finding::underpowered ? 1 : 0;
  }
  if (most > 1)
    lines += fmt::format("± is the {:g} % interval of the mean over n packings (Student's t)\n", 100 * kLevel);
  if (most == 1 && packings) lines += std::string(kOnePacking) + "\n";
  if (underpowered > 0)
    lines += "underpowered: half of the interval is wider than the tolerance; more packings decide\n";
  if (missing > 0) lines += "missing: a case has no completed result; `runner run` computes what the study lacks\n";
  return lines;
}

}  // namespace seapile::present
