#include "runner/present/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>

#include "runner/store/run_folder.h"

namespace seapile::present {
namespace {

using store::Cell;

/// A column of summary(): a metric of the run or of its bed.
struct Headline {
  std::string_view column, unit, metric;
  bool of_bed;
};
/// Means over packings when there are several.
constexpr Headline kDriveHeadlines[] = {{"solid fraction", "-", "solid_fraction", true},
                                        {"mean q_c", "Pa", "tip_resistance_mean", false},
                                        {"fluctuation", "Pa", "tip_resistance_fluctuation", false},
                                        {"max overlap", "-", "overlap_max", false}};
constexpr Headline kJetHeadlines[] = {{"swell ratio", "-", "swell_ratio", false},
                                      {"surface leak", "-", "surface_leak", false},
                                      {"mass defect", "-", "mass_defect", false}};
constexpr Headline kBasinHeadlines[] = {{"reached", "s", "reached", false},
                                        {"volume drift", "-", "volume_drift", false},
                                        {"lowest q", "-", "lowest_shape", false},
                                        {"meshes", "-", "meshes", false}};
constexpr Headline kWaterHeadlines[] = {{"vertices", "-", "vertices", false}};

std::vector<Headline> headlines_of(const std::vector<CaseResult>& cases) {
  std::vector<Headline> all;
  const auto has = [&](SceneKind kind) { return std::ranges::find(cases, kind, &CaseResult::kind) != cases.end(); };
  const auto add = [&](bool wanted, std::span<const Headline> some) {
    if (wanted) all.insert(all.end(), some.begin(), some.end());
  };
  add(has(SceneKind::grains) || cases.empty(), kDriveHeadlines);
  add(has(SceneKind::jet), kJetHeadlines);
  add(has(SceneKind::basin), kBasinHeadlines);
  add(has(SceneKind::jet) || has(SceneKind::basin), kWaterHeadlines);
  return all;
}

bool is_water(const CaseResult& result) { return result.kind != SceneKind::grains; }

Cell metric(const std::optional<store::Manifest>& manifest, const std::string& name) {
  if (!manifest) return {};
  const auto& metrics = manifest->result.metrics;
  const auto found = std::ranges::find(metrics, name, &simulation::Metric::name);
  return found == metrics.end() ? Cell{} : Cell{found->value};
}

std::optional<store::Manifest> manifest_of(const std::filesystem::path& run_folder) {
  return run_folder.empty() ? std::nullopt : std::optional(store::read_manifest(run_folder));
}

}  // namespace

SceneKind kind_of(const scene::SceneSpec& scene) {
  if (scene.jet) return SceneKind::jet;
  return scene.basin ? SceneKind::basin : SceneKind::grains;
}

bool is_completed(const CaseResult& result, std::string_view kind) {
  const auto run = manifest_of(result.run_folder);
  return run && run->header.kind == kind && run->result.outcome == simulation::Outcome::completed;
}

store::Table summary(const std::vector<CaseResult>& cases) {
  std::vector<Labels> labels;
  for (const CaseResult& result : cases) labels.push_back(result.labels);
  store::Table table = label_table(labels);
  table.columns.insert(table.columns.begin(), "case");
  table.units.insert(table.units.begin(), "");
  const std::vector<Headline> headlines = headlines_of(cases);
  const auto add = [&](std::string_view column, std::string_view unit) {
    table.columns.emplace_back(column);
    table.units.emplace_back(unit);
  };
  add("outcome", "");
  for (const Headline& headline : headlines) add(headline.column, headline.unit);
  add("CPU", "s");
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const CaseResult& result = cases[i];
    const auto run = manifest_of(result.run_folder), bed = manifest_of(result.bed_folder);
    std::vector<Cell> row = {result.case_id.substr(0, 10)};
    row.insert(row.end(), table.rows[i].begin(), table.rows[i].end());
    row.emplace_back(result.outcome);
    for (const Headline& headline : headlines)
      row.push_back(metric(headline.of_bed ? bed : run, std::string(headline.metric)));
    row.push_back(run ? Cell{run->provenance.cpu_seconds} : Cell{});
    table.rows[i] = std::move(row);
  }
  return table;
}

Figure resistance_figure(const std::string& title, const std::vector<CaseResult>& cases) {
  Figure figure;
  figure.title = title;
  for (const CaseResult& result : cases) {
    if (!is_completed(result, "drive")) continue;
    const std::string label = legend_text(result.labels);
    auto group = std::ranges::find(figure.groups, label, &CurveGroup::label);
    if (group == figure.groups.end()) group = figure.groups.insert(figure.groups.end(), CurveGroup{label, {}});
    group->packings.push_back(read_resistance(result.run_folder));
  }
  return figure;
}

SurfaceFigure surface_figure(const std::string& title, const std::vector<CaseResult>& cases) {
  SurfaceFigure figure{title, {}};
  for (const CaseResult& result : cases) {
    if (result.kind != SceneKind::jet || !is_completed(result, "flow")) continue;
    std::optional<SurfaceCurve> curve = read_surface(result.run_folder);
    if (!curve) continue;
    curve->label = legend_text(result.labels);
    figure.curves.push_back(std::move(*curve));
  }
  return figure;
}

Closing closing(const std::vector<CaseResult>& cases) {
  store::Table each = summary(cases);
  const std::vector<Headline> headlines = headlines_of(cases);
  std::vector<Role> roles;
  for (const std::string& column : each.columns) {
    const bool is_metric = std::ranges::find(headlines, column, &Headline::column) != headlines.end();
    roles.push_back(column == "case" || column == kSeed ? Role::dropped
                    : column == "outcome"               ? Role::outcome
                    : column == "CPU"                   ? Role::total
                    : is_metric                         ? Role::mean
                                                        : Role::key);
  }
  const bool replicated = std::ranges::any_of(each.columns, [](const auto& column) { return column == kSeed; });
  if (std::ranges::all_of(cases, is_water)) return {std::move(each), {}, ""};
  if (!replicated) return {std::move(each), {}, std::string(kOnePacking) + "\n"};
  Grouped grouped = group(each, roles);
  std::string words = remark(grouped, Format::table);
  return {std::move(grouped.table), std::move(grouped.means), std::move(words)};
}

std::string closing_text(const std::vector<CaseResult>& cases) {
  const Closing end = closing(cases);
  return text(end.table, Format::table, end.means) + (end.remark.empty() ? "" : "\n" + end.remark);
}

}  // namespace seapile::present
