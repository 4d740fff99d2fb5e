#include "runner/present/report_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>

#include "runner/present/curve.h"
#include "runner/present/figure.h"
#include "runner/present/thinning.h"

namespace seapile::present {
namespace {

using store::Cell;

constexpr std::size_t kRowsOfALine = 40;  // of its values in numbers
constexpr std::string_view kBin = "tip_resistance_bin_", kSwell = "swell_ratio";

/// Six digits: as many as a screen can show.
double rounded(double value) {
  if (!std::isfinite(value)) return value;
  const std::string text = fmt::format("{:.6g}", value);
  double read = value;
  std::from_chars(text.data(), text.data() + text.size(), read);
  return read;
}

ReportLine line_of(LineKind kind, std::size_t group, std::string label, const std::vector<double>& x, double x_scale,
                   const std::vector<double>& y, double y_scale) {
  ReportLine line{kind, group, std::move(label), {}, {}};
  for (const std::size_t i : thinned_path(x, y, kMostChartPoints)) {
    line.x.push_back(rounded(x[i] * x_scale));
    line.y.push_back(rounded(y[i] * y_scale));
  }
  return line;
}

/// A place among the groups of a chart; the first of a label makes one. Absent when there are enough.
std::optional<std::size_t> group_of(ReportChart& chart, const Labels& labels) {
  std::string label = legend_text(labels);
  if (label.empty()) label = "the only case";
  const auto found = std::ranges::find(chart.groups, label);
  const auto place = static_cast<std::size_t>(found - chart.groups.begin());
  if (found != chart.groups.end()) return place;
  if (chart.groups.size() == kMostChartGroups) return {};
  chart.groups.push_back(std::move(label));
  return place;
}

std::string packing_of(const Labels& labels) {
  const auto seed = std::ranges::find(labels, kSeed, &Labels::value_type::first);
  return seed == labels.end() ? "" : "seed " + seed->second;
}

/// The points of a chart that checks name: `at` tells where a metric lies on y, absent where it is none of them.
void add_references(ReportChart& chart, const std::vector<Comparison>& published, bool value_is_x, double scale,
                    const std::function<std::optional<double>(const Comparison&)>& at) {
  for (const Comparison& one : published) {
    const auto place = at(one);
    if (!place || !one.reference || one.against != Against::published) continue;
    const std::string label = legend_text(one.labels);
    const auto group = static_cast<std::size_t>(std::ranges::find(chart.groups, label) - chart.groups.begin());
    auto line = std::ranges::find_if(chart.lines, [&](const ReportLine& known) {
      return known.kind == LineKind::reference && known.group == group && known.label == one.source;
    });
    if (line == chart.lines.end())
      line = chart.lines.insert(line, ReportLine{LineKind::reference, group, one.source, {}, {}});
    (value_is_x ? line->x : line->y).push_back(rounded(*one.reference * scale));
    (value_is_x ? line->y : line->x).push_back(*place);
    line->tolerance.push_back(rounded(one.tolerance * scale));
  }
}

/// Runs that differ by their packing alone, with what tells the packings apart.
struct Drives {
  CurveGroup group;
  std::vector<std::string> packings;
};

/// The means over depth in numbers: a row per case and bin.
ReportTable values_of(const std::vector<Drives>& drives, const std::vector<std::string>& groups) {
  ReportTable values{"Mean tip resistance over 0.05 m of depth",
                     {{"case", "depth", "n", "q_c.mean", "q_c.low", "q_c.high"}, {"", "m", "", "Pa", "Pa", "Pa"}, {}},
                     {3}};
  const auto number = [](double value) { return std::isnan(value) ? Cell{} : Cell{value}; };
  for (std::size_t g = 0; g < drives.size(); ++g) {
    for (const BandPoint& point : band_of_packings(drives[g].group))
      values.table.rows.push_back({groups[g], point.depth, static_cast<double>(point.mean.n), number(point.mean.mean),
                                   number(point.mean.low), number(point.mean.high)});
  }
  return values;
}

void add_means(ReportChart& chart, const CurveGroup& group, std::size_t place, double scale) {
  const std::vector<BandPoint> band = band_of_packings(group);
  const std::size_t n = group.packings.size();
  if (n > 1 && band.size() > 1) {
    ReportLine outline{LineKind::band, place, fmt::format("{:g} % interval of the mean", 100 * kLevel), {}, {}};
    const auto add = [&](double value, double depth) {
      outline.x.push_back(rounded(value * scale));
      outline.y.push_back(rounded(depth));
    };
    for (const BandPoint& point : band) add(point.mean.low, point.depth);
    for (auto point = band.rbegin(); point != band.rend(); ++point) add(point->mean.high, point->depth);
    chart.lines.push_back(std::move(outline));
  }
  std::vector<double> mean, depth;
  for (const BandPoint& point : band) {
    mean.push_back(point.mean.mean);
    depth.push_back(point.depth);
  }
  const std::string label = n > 1 ? fmt::format("mean of {} packings", n) : "mean";
  chart.lines.push_back(line_of(LineKind::mean, place, label, mean, scale, depth, 1));
}

std::optional<ReportChart> resistance_chart(const std::vector<CaseResult>& cases,
                                            const std::vector<Comparison>& published) {
  ReportChart chart{
      "Tip resistance against depth", "", {"Tip resistance q_c", "Pa"}, {"Depth d of the tip", "m"}, true};
  std::vector<Drives> drives;
  std::size_t runs = 0, left_out = 0;
  for (const CaseResult& result : cases) {
    if (!is_completed(result, "drive")) continue;
    const auto group = group_of(chart, result.labels);
    if (!group) {
      ++left_out;
      continue;
    }
    if (*group == drives.size()) drives.emplace_back();
    drives[*group].group.packings.push_back(read_resistance(result.run_folder));
    drives[*group].packings.push_back(packing_of(result.labels));
    ++runs;
  }
  if (runs == 0) return {};
  chart.values = values_of(drives, chart.groups);
  double most = 0;
  for (const auto& row : chart.values.table.rows) {
    if (const auto* mean = std::get_if<double>(&row[3])) most = std::max(most, std::abs(*mean));
  }
  const double scale = prefixed(chart.x.unit, most);
  const bool replicated = runs > drives.size(), with_records = runs <= kMostRecordLines;
  for (std::size_t g = 0; g < drives.size(); ++g) {
    const CurveGroup& group = drives[g].group;
    add_means(chart, group, g, scale);
    for (std::size_t p = 0; with_records && p < group.packings.size(); ++p)
      chart.lines.push_back(line_of(LineKind::record, g, drives[g].packings[p], group.packings[p].resistance, scale,
                                    group.packings[p].depth, 1));
  }
  chart.records = !replicated && drives.size() <= kMostFaint;
  chart.note = fmt::format("Strong: mean{} over {} m of newly reached depth{}.{}", replicated ? " of the packings" : "",
                           kBinWidth, replicated ? fmt::format("; shaded: its {:g} % interval", 100 * kLevel) : "",
                           with_records ? " Faint: every record, in the order of time." : "");
  if (left_out > 0) chart.note += fmt::format(" {} runs of further cases are not drawn.", left_out);
  add_references(chart, published, true, scale, [](const Comparison& one) -> std::optional<double> {
    if (!one.metric.starts_with(kBin)) return {};
    double depth = 0;
    const char* const end = one.metric.data() + one.metric.size();
    const auto [rest, error] = std::from_chars(one.metric.data() + kBin.size(), end, depth);
    if (error != std::errc() || rest != end) return {};
    return rounded(depth + kBinWidth / 2);
  });
  return chart;
}

void add_values(ReportChart& chart, const std::string& label, const std::vector<double>& x,
                const std::vector<double>& y) {
  for (const std::size_t i : thinned_path(x, y, kRowsOfALine)) {
    if (std::isfinite(x[i]) && std::isfinite(y[i])) chart.values.table.rows.push_back({label, x[i], y[i]});
  }
}

std::optional<ReportChart> surface_chart(const std::vector<CaseResult>& cases,
                                         const std::vector<Comparison>& published) {
  ReportChart chart{"Free surface of the jet",
                    "H is the die's radius or half gap.",
                    {"Distance from the lip x/H", "-"},
                    {"Height of the surface h/H", "-"}};
  chart.values = {"Height of the free surface", {{"case", "x/H", "h/H"}, {"", "-", "-"}, {}}};
  double last = 0;
  std::size_t left_out = 0;
  for (const CaseResult& result : cases) {
    if (result.kind != SceneKind::jet || !is_completed(result, "flow")) continue;
    const std::optional<SurfaceCurve> curve = read_surface(result.run_folder);
    if (!curve) continue;
    const auto group = group_of(chart, result.labels);
    if (!group) {
      ++left_out;
      continue;
    }
    chart.lines.push_back(line_of(LineKind::mean, *group, "", curve->x, 1, curve->height, 1));
    add_values(chart, chart.groups[*group], curve->x, curve->height);
    for (const double x : curve->x) last = std::max(last, x);
  }
  if (chart.lines.empty()) return {};
  if (left_out > 0) chart.note += fmt::format(" {} further cases are not drawn.", left_out);
  add_references(chart, published, false, 1,
                 [&](const Comparison& one) { return one.metric == kSwell ? std::optional(last) : std::nullopt; });
  return chart;
}

bool has_pile(const store::Manifest& manifest) {
  const auto pile = std::ranges::find(manifest.header.parts, "pile", &simulation::Part::name);
  return pile != manifest.header.parts.end() && pile->built;
}

/// Of basins the error of the volume, and the wave or the force on the pile, over time: a chart each.
std::vector<ReportChart> basin_charts(const std::vector<CaseResult>& cases) {
  std::vector<CurveSource> sources;
  bool with_pile = false, without_pile = false;
  for (const CaseResult& result : cases) {
    if (result.kind != SceneKind::basin || !is_completed(result, "flow")) continue;
    const store::Manifest manifest = store::read_manifest(result.run_folder);
    if (manifest.flow_records == 0) continue;
    (has_pile(manifest) ? with_pile : without_pile) = true;
    sources.push_back({result.case_id, manifest.run, result.labels, result.run_folder});
  }
  std::vector<std::string> columns = {"volume_error"};
  if (without_pile) columns.emplace_back("wave");
  if (with_pile) columns.emplace_back("pile_force_y");
  std::vector<ReportChart> charts;
  for (const std::string& column : columns) {
    ReportChart chart{column + " against time", "", {"time", "s"}, {column, unit_of(Series::water, column)}};
    chart.values = {column, {{"case", "time", column}, {"", "s", chart.y.unit}, {}}};
    std::vector<std::pair<std::size_t, std::vector<std::vector<double>>>> curves;
    double most = 0;
    std::size_t left_out = 0;
    for (const CurveSource& source : sources) {
      auto values = read_columns(source, Series::water, {"time", column});
      const auto there = [](double value) { return std::isfinite(value); };
      if (std::ranges::none_of(values[1], there)) continue;
      const auto group = group_of(chart, source.labels);
      if (!group) {
        ++left_out;
        continue;
      }
      for (const double value : values[1]) most = there(value) ? std::max(most, std::abs(value)) : most;
      add_values(chart, chart.groups[*group], values[0], values[1]);
      curves.emplace_back(*group, std::move(values));
    }
    if (curves.empty()) continue;
    const double scale = prefixed(chart.y.unit, most);
    for (const auto& [group, values] : curves)
      chart.lines.push_back(line_of(LineKind::mean, group, "", values[0], 1, values[1], scale));
    if (left_out > 0) chart.note = fmt::format("{} further cases are not drawn.", left_out);
    charts.push_back(std::move(chart));
  }
  return charts;
}

}  // namespace

std::vector<ReportChart> report_charts(const std::vector<CaseResult>& cases, const std::vector<Comparison>& published) {
  std::vector<ReportChart> charts;
  if (auto chart = resistance_chart(cases, published)) charts.push_back(*std::move(chart));
  if (auto chart = surface_chart(cases, published)) charts.push_back(*std::move(chart));
  for (ReportChart& chart : basin_charts(cases)) charts.push_back(std::move(chart));
  return charts;
}

}  // namespace seapile::present
