#include "runner/present/normalised.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "runner/present/replicates.h"

namespace seapile::present {
namespace {

constexpr const char* kSimulated = "simulated";

/// The labels of cases as CSV: headings, and the cells of each case, every cell with its comma.
struct LabelText {
  std::string heading, none;
  std::vector<std::string> cells;
};

LabelText label_text(const std::vector<Labels>& cases) {
  const store::Table table = label_table(cases);
  LabelText text;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    text.heading += csv_heading(table.columns[i], table.units[i]) + ",";
    text.none += ",";
  }
  for (const auto& row : table.rows) {
    std::string& cells = text.cells.emplace_back();
    for (const store::Cell& cell : row) cells += cell_text(cell) + ",";
  }
  return text;
}

/// The runs of a case among all of them.
struct Group {
  Labels labels;
  CurveGroup curves;
  double width_over_d50 = 0;  ///< mean of the packings
};

std::vector<Group> groups_of(const std::vector<NormalisedRun>& runs) {
  std::vector<CurveSource> sources;
  for (const NormalisedRun& run : runs) sources.push_back(run.source);
  std::vector<Group> groups;
  for (const PackedCase& one : packed(sources)) {
    Group& group = groups.emplace_back(one.labels, CurveGroup{legend_text(one.labels), {}});
    for (const CurveSource& source : one.packings) {
      const auto run = std::ranges::find(runs, source.run_folder, [](const auto& r) { return r.source.run_folder; });
      group.curves.packings.push_back(run->curve);
      group.width_over_d50 += run->width_over_d50 / static_cast<double>(one.packings.size());
    }
  }
  return groups;
}

/// "4.0", or "4.0 to 8.0".
std::string extent(double least, double most) {
  const std::string from = fmt::format("{:.3g}", least), to = fmt::format("{:.3g}", most);
  return from == to ? from : from + " to " + to;
}

}  // namespace

std::vector<NormalisedRun> normalised(const std::vector<CurveSource>& drives) {
  std::map<std::filesystem::path, double> diameters;
  std::vector<NormalisedRun> runs;
  for (const CurveSource& source : drives) {
    if (!diameters.contains(source.bed_folder)) diameters[source.bed_folder] = median_diameter(source.bed_folder);
    NormalisedRun run{source, read_resistance(source.run_folder), 0};
    run.curve.over = overburden_of(source.run_folder, source.bed_folder);
    run.width_over_d50 = run.curve.over->width / diameters[source.bed_folder];
    runs.push_back(std::move(run));
  }
  return runs;
}

std::string normalised_csv(const std::vector<NormalisedRun>& runs, const std::vector<SiteCurve>& site) {
  std::vector<Labels> cases;
  for (const NormalisedRun& run : runs) cases.push_back(run.source.labels);
  const LabelText labels = label_text(cases);
  std::string text = "case,run," + labels.heading +
                     "depth[m],tip_resistance[Pa],effective_stress[Pa],depth_over_width[-],resistance_over_stress[-],"
                     "width_over_d50[-],model,source\n";
  const auto add = [&](const ResistanceCurve& curve, const std::string& before, const std::string& after) {
    for (std::size_t i = 0; i < curve.depth.size(); ++i) {
      const double depth = curve.depth[i], resistance = curve.resistance[i];
      if (const auto point = shown(curve, depth, resistance)) {
        text += fmt::format("{}{},{},{},{},{},{}\n", before, depth, resistance, effective_stress(*curve.over, depth),
                            point->depth, point->resistance, after);
      }
    }
  };
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const NormalisedRun& run = runs[k];
    add(run.curve, run.source.case_id.substr(0, 10) + "," + run.source.run + "," + labels.cells[k],
        fmt::format("{},{},{}", run.width_over_d50, kModel, kSimulated));
  }
  for (const SiteCurve& test : site) add(test.curve, ",," + labels.none, ",," + csv_field(test.label));
  return text;
}

std::string normalised_bands_csv(const std::vector<NormalisedRun>& runs, const std::vector<SiteCurve>& site,
                                 double level) {
  const std::vector<Group> groups = groups_of(runs);
  std::vector<Labels> cases;
  for (const Group& group : groups) cases.push_back(group.labels);
  const LabelText labels = label_text(cases);
  std::string text = labels.heading + "depth_over_width[-],n,mean[-],low[-],high[-],width_over_d50[-],model,source\n";
  for (std::size_t k = 0; k < groups.size(); ++k) {
    for (const auto& [depth, mean] : band_of_packings(groups[k].curves, level)) {
      text += fmt::format("{}{:.6g},{},{},", labels.cells[k], depth, mean.n, mean.mean);
      text += mean.n > 1 ? fmt::format("{},{},", mean.low, mean.high) : ",,";
      text += fmt::format("{},{},{}\n", groups[k].width_over_d50, kModel, kSimulated);
    }
  }
  for (const SiteCurve& test : site) {
    for (std::size_t i = 0; i < test.curve.depth.size(); ++i) {
      if (const auto point = shown(test.curve, test.curve.depth[i], test.curve.resistance[i]))
        text +=
            fmt::format("{}{:.6g},,{},,,,,{}\n", labels.none, point->depth, point->resistance, csv_field(test.label));
    }
  }
  return text;
}

Figure normalised_figure(const std::string& title, const std::vector<NormalisedRun>& runs,
                         const std::vector<SiteCurve>& site, bool bands) {
  Figure figure{title, {}, site};
  std::vector<std::size_t> packings;
  for (const Group& group : groups_of(runs)) {
    packings.push_back(group.curves.packings.size());
    if (bands) figure.groups.push_back(group.curves);
  }
  for (const NormalisedRun& run : runs) {
    if (bands) break;
    std::string label = legend_text(run.source.labels);
    for (const auto& [path, value] : run.source.labels) {
      if (path == kSeed) label += fmt::format("{}seed {}", label.empty() ? "" : ", ", value);
    }
    figure.groups.push_back({label, {run.curve}});
  }
  const auto [low, high] = std::ranges::minmax_element(runs, {}, &NormalisedRun::width_over_d50);
  const auto [least, most] = std::ranges::minmax_element(packings);
  figure.title +=
      fmt::format(" — discs in plane strain, B/d50 = {}, {} {}", extent(low->width_over_d50, high->width_over_d50),
                  extent(static_cast<double>(*least), static_cast<double>(*most)), *most == 1 ? "packing" : "packings");
  return figure;
}

}  // namespace seapile::present
