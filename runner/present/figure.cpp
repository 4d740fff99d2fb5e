#include "runner/present/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "runner/present/gnuplot.h"
#include "runner/present/thinning.h"
#include "runner/store/run_folder.h"

namespace seapile::present {
namespace {

namespace fs = std::filesystem;

// In pixels; the picture is drawn for a page's or a screen's column.
constexpr int kWidth = 760, kHeight = 960, kKeyLine = 20;
constexpr std::size_t kTitleCharacters = 66;

constexpr std::string_view kBandAlpha = "c4";  // nearly transparent: two bands may lie over each other

using Points = std::vector<std::pair<double, double>>;  // depth and resistance, as they are shown

/// Every record that is drawn.
Points all_points(const ResistanceCurve& curve) {
  Points points;
  for (const std::size_t i : thinned(curve.resistance)) {
    if (const auto point = shown(curve, curve.depth[i], curve.resistance[i]))
      points.emplace_back(point->depth, point->resistance);
  }
  return points;
}

/// How the axes are named and scaled.
struct Axes {
  std::string_view across, down;
  double scale;  ///< from a value to its place across
  bool normalised, logarithmic;
};

Axes axes_of(const Figure& figure) {
  const bool normalised = std::ranges::any_of(figure.groups, [](const CurveGroup& group) {
    return std::ranges::any_of(group.packings, [](const auto& curve) { return curve.over.has_value(); });
  });
  if (!normalised) {
    return {"Tip resistance {/:Italic q_c} (kPa)", "Depth {/:Italic d} of the tip below the bed surface (m)", 1e-3,
            false, false};
  }
  return {"Tip resistance over vertical effective stress, {/:Italic q_c} / σ'_{v0}",
          "Depth of the tip over width of the pile, {/:Italic d} / {/:Italic B}", 1, true, !figure.site.empty()};
}

/// A gnuplot data block. On a logarithmic axis a line is broken where there is nothing to show.
std::string data_block(const std::string& name, const Points& points, const Axes& axes) {
  std::string block = fmt::format("${} << END\n", name);
  for (const auto& [depth, resistance] : points) {
    block +=
        axes.logarithmic && !(resistance > 0) ? "\n" : fmt::format("{:.6g} {:.6g}\n", resistance * axes.scale, depth);
  }
  return block + "END\n";
}

/// The outline of the interval, down along its low ends and up along its high ones.
std::string band_block(const std::string& name, const std::vector<BandPoint>& band, const Axes& axes, double least) {
  Points outline;
  for (const BandPoint& point : band) outline.emplace_back(point.depth, std::max(point.mean.low, least));
  for (auto point = band.rbegin(); point != band.rend(); ++point) outline.emplace_back(point->depth, point->mean.high);
  return data_block(name, outline, axes);
}

/// How far the drawn curves reach, in the values that are shown.
struct Reach {
  double deepest = 0, lowest = 0, highest = 0;
  double least = 0;  ///< above 0
};

/// Near the surface single records of a normalised curve are without bound; the means say how far the axis goes.
Reach reach_of(const Figure& figure, const Axes& axes) {
  Reach reach;
  const auto take = [&](double resistance) {
    reach.lowest = std::min(reach.lowest, resistance);
    reach.highest = std::max(reach.highest, resistance);
    if (resistance > 0) reach.least = reach.least > 0 ? std::min(reach.least, resistance) : resistance;
  };
  for (const CurveGroup& group : figure.groups) {
    for (const ResistanceCurve& curve : group.packings) {
      for (const double depth : curve.depth)
        reach.deepest = std::max(reach.deepest, curve.over ? depth / curve.over->width : depth);
      const Points points = curve.over ? bin_means(curve) : all_points(curve);
      for (const auto& [depth, resistance] : points) take(resistance);
    }
    for (const BandPoint& point : band_of_packings(group)) {
      if (point.mean.n > 1 && axes.normalised) take(point.mean.high);
    }
  }
  for (const SiteCurve& site : figure.site) {
    for (const auto& [depth, resistance] : all_points(site.curve)) {
      if (depth <= reach.deepest) take(resistance);
    }
  }
  return reach;
}

/// "mean of 5 packings, 95 % band"; empty when no group has several.
std::string band_title(const Figure& figure) {
  std::size_t least = 0, most = 0;
  for (const CurveGroup& group : figure.groups) {
    const std::size_t n = group.packings.size();
    if (n < 2) continue;
    most = std::max(most, n);
    least = least > 0 ? std::min(least, n) : n;
  }
  if (most == 0) return "";
  const std::string count = least == most ? fmt::format("{}", most) : fmt::format("{} to {}", least, most);
  return fmt::format("mean of {} packings, {:g} % band", count, 100 * kLevel);
}

/// What the kinds of line are. The title of a normalised figure says how many packings there are.
std::string note(const Figure& figure, const Axes& axes) {
  const bool replicated =
      std::ranges::any_of(figure.groups, [](const CurveGroup& group) { return group.packings.size() > 1; });
  const std::string packing = replicated || axes.normalised ? "" : " One packing of the grains.";
  const std::string site = figure.site.empty() ? "" : " Grey: measured in the field.";
  const std::string mean = fmt::format("mean{} over {} m of depth", replicated ? " of the packings" : "", kBinWidth);
  if (figure.groups.size() > kMostFaint) return fmt::format("M{}.{}{}", mean.substr(1), packing, site);
  return fmt::format("Strong: {}; faint: {}.{}{}", mean, replicated ? "each packing" : "every record", packing, site);
}

/// How many lines a legend above the axes has. Normalised curves leave no room inside: near the surface they are wide.
int legend_lines(const Figure& figure, const Axes& axes) {
  if (!axes.normalised) return 0;
  const auto labelled = std::ranges::count_if(figure.groups, [](const auto& group) { return !group.label.empty(); });
  return static_cast<int>(labelled) + static_cast<int>(figure.site.size()) + (band_title(figure).empty() ? 0 : 1);
}

/// Title, note, axes and legend.
std::string frame_of(const Figure& figure, const Axes& axes, const Reach& reach) {
  const int room = legend_lines(figure, axes) * kKeyLine, height = kHeight + room;
  auto [script, top] = heading(figure.title, note(figure, axes), kWidth, height, kTitleCharacters);
  const int legend = top - kHeadingSide / 2 + 6;
  top += room > 0 ? room + kKeyLine / 2 : 0;
  script += fmt::format("set tmargin at screen {:.4f}\n", 1 - static_cast<double>(top + 66) / height);
  script += fmt::format("set bmargin at screen {:.4f}\n", static_cast<double>(kHeadingSide) / height);
  script += fmt::format("set lmargin at screen {:.4f}\n", 92.0 / kWidth);
  script += fmt::format("set rmargin at screen {:.4f}\n", 1 - 36.0 / kWidth);
  script +=
      "set border 6 lw 1 lc rgb '#8c8c8c'\n"
      "unset xtics\n"
      "set format x2 '%g'\n"
      "set format y '%g'\n"
      "set x2tics out nomirror scale 0.6 tc rgb '#444444'\n"
      "set ytics out nomirror scale 0.6 tc rgb '#444444'\n"
      "set grid x2tics ytics back lt 1 lw 1 lc rgb '#e8e8e8'\n"
      "set key reverse Left noenhanced samplen 2.2 tc rgb '#1a1a1a'\n";
  script += axes.normalised
                ? fmt::format("set key at screen {:.4f},{:.4f} left top vertical maxcols 1\n",
                              static_cast<double>(kHeadingSide) / kWidth, 1 - static_cast<double>(legend) / height)
                : "set key top right inside opaque fc rgb '#ffffff' spacing 1.25\n";
  script += fmt::format("set x2label \"{}\" offset 0,-0.5 tc rgb '#1a1a1a'\n", axes.across);
  script += fmt::format("set ylabel \"{}\" offset 1,0 tc rgb '#1a1a1a'\n", axes.down);
  if (axes.logarithmic) {
    script += fmt::format("set logscale x2\nset x2range [{:.6g}:{:.6g}]\n", reach.least / 2, 2 * reach.highest);
  } else {
    // Of a normalised curve the axis ends with the means, of which bands are a part.
    const std::string end = axes.normalised && reach.highest > 0 ? fmt::format("{:.6g}", 1.1 * reach.highest) : "*";
    script += fmt::format("set x2range [{}:{}]\n", reach.lowest < -0.02 * reach.highest ? "*" : "0", end);
  }
  script += fmt::format("set yrange [{:.6g}:0]\n", reach.deepest > 0 ? reach.deepest : 1.0);
  return script;
}

/// Whether a line has a point: a run's own, or of packings their means over bins.
bool shows_anything(const Figure& figure) {
  return std::ranges::any_of(figure.groups, [&](const CurveGroup& group) {
    const bool by_bins = group.packings.size() > 1 || figure.groups.size() > kMostFaint;
    return std::ranges::any_of(group.packings, [&](const ResistanceCurve& curve) {
      return by_bins ? !bin_means(curve).empty() : !all_points(curve).empty();
    });
  });
}

}  // namespace

std::optional<ShownPoint> shown(const ResistanceCurve& curve, double depth, double resistance) {
  if (!curve.over) return ShownPoint{depth, resistance};
  const double stress = effective_stress(*curve.over, depth);
  if (!(depth > 0 && stress > 0)) return {};
  return ShownPoint{depth / curve.over->width, resistance / stress};
}

ResistanceCurve read_resistance(const fs::path& run_folder) {
  ResistanceCurve curve;
  for (const simulation::Record& record : store::read_series(run_folder)) {
    curve.depth.push_back(record.depth);
    curve.resistance.push_back(record.tip_resistance);
  }
  return curve;
}

std::vector<std::pair<double, double>> bin_means(const ResistanceCurve& curve) {
  struct Bin {
    double sum = 0;
    int count = 0;
  };
  std::map<long, Bin> bins;
  double reached = 0, deepest = 0;
  for (std::size_t i = 0; i < curve.depth.size(); ++i) {
    deepest = std::max(deepest, curve.depth[i]);
    if (curve.depth[i] <= reached) continue;
    reached = curve.depth[i];
    // A record that ends on a bin's lower edge lies in that bin; the tolerance is for depths summed from many steps.
    Bin& bin = bins[std::lround(std::ceil(reached / kBinWidth - 1e-6)) - 1];
    bin.sum += curve.resistance[i];
    ++bin.count;
  }
  std::vector<std::pair<double, double>> means;
  for (const auto& [index, bin] : bins) {
    const double lower_edge = static_cast<double>(index + 1) * kBinWidth;
    // Not full: the run ended inside it. A record may miss the edge by its own length.
    if (lower_edge > deepest + 0.1 * kBinWidth) continue;
    if (const auto point = shown(curve, (static_cast<double>(index) + 0.5) * kBinWidth, bin.sum / bin.count))
      means.emplace_back(point->depth, point->resistance);
  }
  return means;
}

std::vector<BandPoint> band_of_packings(const CurveGroup& group, double level) {
  std::map<double, std::vector<double>> values;
  for (const ResistanceCurve& packing : group.packings) {
    for (const auto& [depth, value] : bin_means(packing)) values[depth].push_back(value);
  }
  std::vector<BandPoint> band;
  for (const auto& [depth, of_packings] : values) {
    if (of_packings.size() == group.packings.size()) band.push_back({depth, mean_interval(of_packings, level)});
  }
  return band;
}

std::string gnuplot_script(const Figure& figure) {
  const bool with_faint = figure.groups.size() <= kMostFaint;
  const Axes axes = axes_of(figure);
  const Reach reach = reach_of(figure, axes);
  std::string script = frame_of(figure, axes, reach);

  // Bands and faint lines first, so that no strong line lies under one of them.
  std::string blocks, bands, faint, strong;
  for (std::size_t g = 0; g < figure.groups.size(); ++g) {
    const CurveGroup& group = figure.groups[g];
    const auto [colour, dash] = style_of(g);
    const bool replicated = group.packings.size() > 1;
    for (std::size_t p = 0; with_faint && p < group.packings.size(); ++p) {
      const std::string name = fmt::format("faint_{}_{}", g, p);
      if (replicated) {
        blocks += data_block(name, bin_means(group.packings[p]), axes);
      } else {
        blocks += data_block(name, all_points(group.packings[p]), axes);
      }
      faint += fmt::format("  ${} using 1:2 axes x2y1 with lines lw {} lc rgb '#{}{}' notitle, \\\n", name,
                           replicated ? 1.2 : 0.8, replicated ? "80" : "a8", colour);
    }
    const std::vector<BandPoint> band = band_of_packings(group);
    if (replicated && band.size() > 1) {
      const std::string name = fmt::format("band_{}", g);
      blocks += band_block(name, band, axes, axes.logarithmic ? reach.least / 2 : -INFINITY);
      bands += fmt::format(
          "  ${} using 1:2 axes x2y1 with filledcurves closed fs solid noborder fc rgb '#{}{}' notitle, \\\n", name,
          kBandAlpha, colour);
    }
    const std::string name = fmt::format("strong_{}", g);
    std::vector<std::pair<double, double>> means;
    for (const BandPoint& point : band) means.emplace_back(point.depth, point.mean.mean);
    blocks += data_block(name, means, axes);
    // A white edge keeps crossing lines apart.
    strong += fmt::format("  ${} using 1:2 axes x2y1 with lines lw 5.5 lc rgb '#40ffffff' notitle, \\\n", name);
    const std::string title = group.label.empty() ? "notitle" : "title " + quoted(group.label);
    strong +=
        fmt::format("  ${} using 1:2 axes x2y1 with lines lw 3 dt {} lc rgb '#{}' {}, \\\n", name, dash, colour, title);
  }
  for (std::size_t s = 0; s < figure.site.size(); ++s) {
    const std::string name = fmt::format("site_{}", s);
    blocks += data_block(name, all_points(figure.site[s].curve), axes);
    faint += fmt::format("  ${} using 1:2 axes x2y1 with lines lw 2.2 dt {} lc rgb '#777777' title {}, \\\n", name,
                         style_of(7 * s).dash, quoted(figure.site[s].label));
  }
  if (!bands.empty()) {
    strong += fmt::format("  keyentry with filledcurves fs solid noborder fc rgb '#{}444444' title {}, \\\n",
                          kBandAlpha, quoted(band_title(figure)));
  }
  // The last curve is never seen; it saves the list above from a special last line.
  return script + blocks + "plot \\\n" + bands + faint + strong + "  NaN axes x2y1 notitle\n";
}

void draw(const Figure& figure, const fs::path& svg) {
  if (!shows_anything(figure))
    throw store::StoreError(
        store::StoreError::Kind::io,
        fmt::format("{} is not drawn: no drive goes through a full {} m of depth", svg.string(), kBinWidth));
  draw_with_gnuplot(gnuplot_script(figure), fs::absolute(svg));
}

}  // namespace seapile::present
