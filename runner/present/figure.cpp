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
constexpr int kWidth = 760, kHeight = 960;
constexpr std::size_t kTitleCharacters = 66;

constexpr std::string_view kBandAlpha = "c4";  // nearly transparent: two bands may lie over each other

ResistanceCurve thinned_curve(const ResistanceCurve& curve) {
  ResistanceCurve result;
  for (const std::size_t i : thinned(curve.resistance)) {
    result.depth.push_back(curve.depth[i]);
    result.resistance.push_back(curve.resistance[i]);
  }
  return result;
}

/// A gnuplot data block of q_c in kPa against depth.
std::string data_block(const std::string& name, const std::vector<double>& depth,
                       const std::vector<double>& resistance) {
  std::string block = fmt::format("${} << END\n", name);
  for (std::size_t i = 0; i < depth.size(); ++i)
    block += fmt::format("{:.6g} {:.6g}\n", resistance[i] / 1000, depth[i]);
  return block + "END\n";
}

std::string data_block(const std::string& name, const std::vector<std::pair<double, double>>& means) {
  std::vector<double> depth, resistance;
  for (const auto& [d, q] : means) {
    depth.push_back(d);
    resistance.push_back(q);
  }
  return data_block(name, depth, resistance);
}

/// The outline of the interval, down along its low ends and up along its high ones.
std::string band_block(const std::string& name, const std::vector<BandPoint>& band) {
  std::vector<std::pair<double, double>> outline;
  for (const BandPoint& point : band) outline.emplace_back(point.depth, point.mean.low);
  for (auto point = band.rbegin(); point != band.rend(); ++point) outline.emplace_back(point->depth, point->mean.high);
  return data_block(name, outline);
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

/// What the two kinds of line are.
std::string note(const Figure& figure) {
  const bool replicated =
      std::ranges::any_of(figure.groups, [](const CurveGroup& group) { return group.packings.size() > 1; });
  const std::string packing = replicated ? "" : " One packing of the grains.";
  if (figure.groups.size() > kMostFaint) {
    return fmt::format("Mean{} over {} m of depth.{}", replicated ? " of the packings" : "", kBinWidth, packing);
  }
  return fmt::format("Strong: mean{} over {} m of depth; faint: {}.{}", replicated ? " of the packings" : "", kBinWidth,
                     replicated ? "each packing" : "every record", packing);
}

/// Title, note, axes and legend.
std::string frame_of(const Figure& figure, double deepest, bool tension) {
  auto [script, top] = heading(figure.title, note(figure), kWidth, kHeight, kTitleCharacters);
  script += fmt::format("set tmargin at screen {:.4f}\n", 1 - static_cast<double>(top + 66) / kHeight);
  script += fmt::format("set bmargin at screen {:.4f}\n", static_cast<double>(kHeadingSide) / kHeight);
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
      "set x2label 'Tip resistance {/:Italic q_c} (kPa)' offset 0,-0.5 tc rgb '#1a1a1a'\n"
      "set ylabel 'Depth {/:Italic d} of the tip below the bed surface (m)' offset 1,0 tc rgb '#1a1a1a'\n"
      "set key top right inside reverse Left noenhanced opaque fc rgb '#ffffff' samplen 2.2 spacing 1.25 "
      "tc rgb '#1a1a1a'\n";
  script += fmt::format("set x2range [{}:*]\n", tension ? "*" : "0");
  script += fmt::format("set yrange [{:.6g}:0]\n", deepest > 0 ? deepest : 1.0);
  return script;
}

}  // namespace

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
    means.emplace_back((static_cast<double>(index) + 0.5) * kBinWidth, bin.sum / bin.count);
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
  double deepest = 0, lowest = 0, highest = 0;
  for (const CurveGroup& group : figure.groups) {
    for (const ResistanceCurve& curve : group.packings) {
      for (const double depth : curve.depth) deepest = std::max(deepest, depth);
      for (const double value : curve.resistance) {
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
      }
    }
  }
  std::string script = frame_of(figure, deepest, lowest < -0.02 * highest);

  // Bands and faint lines first, so that no strong line lies under one of them.
  std::string blocks, bands, faint, strong;
  for (std::size_t g = 0; g < figure.groups.size(); ++g) {
    const CurveGroup& group = figure.groups[g];
    const auto [colour, dash] = style_of(g);
    const bool replicated = group.packings.size() > 1;
    for (std::size_t p = 0; with_faint && p < group.packings.size(); ++p) {
      const std::string name = fmt::format("faint_{}_{}", g, p);
      if (replicated) {
        blocks += data_block(name, bin_means(group.packings[p]));
      } else {
        const ResistanceCurve raw = thinned_curve(group.packings[p]);
        blocks += data_block(name, raw.depth, raw.resistance);
      }
      faint += fmt::format("  ${} using 1:2 axes x2y1 with lines lw {} lc rgb '#{}{}' notitle, \\\n", name,
                           replicated ? 1.2 : 0.8, replicated ? "80" : "a8", colour);
    }
    const std::vector<BandPoint> band = band_of_packings(group);
    if (replicated && band.size() > 1) {
      const std::string name = fmt::format("band_{}", g);
      blocks += band_block(name, band);
      bands += fmt::format(
          "  ${} using 1:2 axes x2y1 with filledcurves closed fs solid noborder fc rgb '#{}{}' notitle, \\\n", name,
          kBandAlpha, colour);
    }
    const std::string name = fmt::format("strong_{}", g);
    std::vector<std::pair<double, double>> means;
    for (const BandPoint& point : band) means.emplace_back(point.depth, point.mean.mean);
    blocks += data_block(name, means);
    // A white edge keeps crossing lines apart.
    strong += fmt::format("  ${} using 1:2 axes x2y1 with lines lw 5.5 lc rgb '#40ffffff' notitle, \\\n", name);
    const std::string title = group.label.empty() ? "notitle" : "title " + quoted(group.label);
    strong +=
        fmt::format("  ${} using 1:2 axes x2y1 with lines lw 3 dt {} lc rgb '#{}' {}, \\\n", name, dash, colour, title);
  }
  if (!bands.empty()) {
    strong += fmt::format("  keyentry with filledcurves fs solid noborder fc rgb '#{}444444' title {}, \\\n",
                          kBandAlpha, quoted(band_title(figure)));
  }
  // The last curve is never seen; it saves the list above from a special last line.
  return script + blocks + "plot \\\n" + bands + faint + strong + "  NaN axes x2y1 notitle\n";
}

void draw(const Figure& figure, const fs::path& svg) { draw_with_gnuplot(gnuplot_script(figure), svg); }

}  // namespace seapile::present
