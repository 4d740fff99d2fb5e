#include "runner/present/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "runner/store/run_folder.h"

namespace seapile::present {
namespace {

using store::Cell;

constexpr const char* kSeed = "bed.seed";

/// What makes packings of the same case differ is left out.
std::string label_without_seed(const Labels& labels) {
  std::vector<std::string> words;
  for (const auto& [path, value] : labels) {
    if (path == kSeed) continue;
    const auto last = path.find_last_of('.');
    words.push_back(fmt::format("{} {}", last == std::string::npos ? path : path.substr(last + 1), value));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

Cell metric(const std::optional<store::Manifest>& manifest, const std::string& name) {
  if (!manifest) return {};
  const auto& metrics = manifest->result.metrics;
  const auto found = std::ranges::find(metrics, name, &simulation::Metric::name);
  return found == metrics.end() ? Cell{} : Cell{found->value};
}

std::optional<store::Manifest> manifest_of(const std::filesystem::path& run_folder) {
  return run_folder.empty() ? std::nullopt : std::optional(store::read_manifest(run_folder));
}

/// How many packings each case was computed for, the seed apart: least and most.
std::pair<std::size_t, std::size_t> packings(const std::vector<CaseResult>& cases) {
  std::vector<std::pair<std::string, std::size_t>> counts;
  for (const CaseResult& result : cases) {
    const std::string label = label_without_seed(result.labels);
    const auto found = std::ranges::find(counts, label, &std::pair<std::string, std::size_t>::first);
    if (found == counts.end()) {
      counts.emplace_back(label, 1);
    } else {
      ++found->second;
    }
  }
  if (counts.empty()) return {0, 0};
  const auto [least, most] = std::ranges::minmax_element(counts, {}, &std::pair<std::string, std::size_t>::second);
  return {least->second, most->second};
}

}  // namespace

store::Table summary(const std::vector<CaseResult>& cases) {
  std::vector<Labels> labels;
  for (const CaseResult& result : cases) labels.push_back(result.labels);
  store::Table table = label_table(labels);
  table.columns.insert(table.columns.begin(), "case");
  table.units.insert(table.units.begin(), "");
  const std::vector<std::pair<const char*, const char*>> columns = {{"outcome", ""},      {"solid fraction", "-"},
                                                                    {"mean q_c", "Pa"},   {"fluctuation", "Pa"},
                                                                    {"max overlap", "-"}, {"CPU", "s"}};
  for (const auto& [name, unit] : columns) {
    table.columns.emplace_back(name);
    table.units.emplace_back(unit);
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const CaseResult& result = cases[i];
    const auto run = manifest_of(result.run_folder), bed = manifest_of(result.bed_folder);
    std::vector<Cell> row = {result.case_id.substr(0, 10)};
    row.insert(row.end(), table.rows[i].begin(), table.rows[i].end());
    row.emplace_back(result.outcome);
    row.push_back(metric(bed, "solid_fraction"));
    row.push_back(metric(run, "tip_resistance_mean"));
    row.push_back(metric(run, "tip_resistance_fluctuation"));
    row.push_back(metric(run, "overlap_max"));
    row.push_back(run ? Cell{run->provenance.cpu_seconds} : Cell{});
    table.rows[i] = std::move(row);
  }
  return table;
}

Figure resistance_figure(const std::string& title, const std::vector<CaseResult>& cases) {
  Figure figure;
  figure.title = title;
  for (const CaseResult& result : cases) {
    if (result.run_folder.empty()) continue;
    const store::Manifest manifest = store::read_manifest(result.run_folder);
    const bool drawn = manifest.header.kind == "drive" && manifest.result.outcome == simulation::Outcome::completed;
    if (!drawn) continue;
    ResistanceCurve curve;
    for (const simulation::Record& record : store::read_series(result.run_folder)) {
      curve.depth.push_back(record.depth);
      curve.resistance.push_back(record.tip_resistance);
    }
    const std::string label = label_without_seed(result.labels);
    auto group = std::ranges::find(figure.groups, label, &CurveGroup::label);
    if (group == figure.groups.end()) group = figure.groups.insert(figure.groups.end(), CurveGroup{label, {}});
    group->packings.push_back(std::move(curve));
  }
  return figure;
}

std::string packing_remark(const std::vector<CaseResult>& cases) {
  const auto [least, most] = packings(cases);
  if (most == 1) {
    return "One packing is one packing: another one of the same preparation moves the mean by a few per cent. "
           "`--seeds N` repeats every case on N packings.";
  }
  if (least == 1) return "Some cases were computed for one packing only.";
  return "";
}

}  // namespace seapile::present
