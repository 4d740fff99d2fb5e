#include "runner/present/surface_figure.h"

#include <fmt/format.h>

#include <algorithm>

#include "runner/present/arrays.h"
#include "runner/present/gnuplot.h"
#include "runner/store/run_folder.h"

namespace seapile::present {
namespace {

namespace fs = std::filesystem;

// In pixels.
constexpr int kWidth = 900, kHeight = 560, kAxis = 96, kBelow = 84;
constexpr std::size_t kTitleCharacters = 80;

constexpr double kRoom = 0.06;  ///< above and below the curves, share of the range of their heights

/// What the axis of heights shows. It holds the lip's height, from which every curve begins.
struct Heights {
  double low = 1, high = 1;
};

Heights heights_of(const SurfaceFigure& figure) {
  Heights range;
  for (const SurfaceCurve& curve : figure.curves) {
    for (const double height : curve.height) {
      range.low = std::min(range.low, height);
      range.high = std::max(range.high, height);
    }
  }
  const double room = std::max(kRoom * (range.high - range.low), 1e-3);
  return {range.low - room, range.high + room};
}

std::string axes(const SurfaceFigure& figure, int top) {
  double last = 0;
  for (const SurfaceCurve& curve : figure.curves) last = std::max(last, curve.x.empty() ? 0.0 : curve.x.back());
  const Heights heights = heights_of(figure);
  std::string script =
      fmt::format("set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\nset lmargin at screen {:.4f}\n",
                  1 - static_cast<double>(top + 12) / kHeight, static_cast<double>(kBelow) / kHeight,
                  static_cast<double>(kAxis) / kWidth);
  script +=
      "set border 3 lw 1 lc rgb '#8c8c8c'\n"
      "set format '%g'\n"
      "set xtics out nomirror scale 0.6 tc rgb '#444444'\n"
      "set ytics out nomirror scale 0.6 tc rgb '#444444'\n"
      "set grid xtics ytics back lt 1 lw 1 lc rgb '#e8e8e8'\n"
      "set xlabel 'Distance from the lip {/:Italic x}/{/:Italic H} (-)' tc rgb '#1a1a1a'\n"
      "set ylabel 'Height of the surface {/:Italic h}/{/:Italic H} (-)' offset 1,0 tc rgb '#1a1a1a'\n"
      // Beside the curves, which may lie anywhere: they rise in one study and fall in another.
      "set key outside right top reverse Left noenhanced samplen 2.2 spacing 1.25 tc rgb '#1a1a1a'\n";
  return script + fmt::format("set xrange [0:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", last > 0 ? last : 1.0, heights.low,
                              heights.high);
}

}  // namespace

std::optional<SurfaceCurve> read_surface(const fs::path& run_folder) {
  const std::size_t frames = store::flow_frame_count(run_folder);
  if (frames == 0) return std::nullopt;
  const simulation::FlowFrame frame = store::read_flow_frame(run_folder, frames - 1);
  if (frame.surface.empty()) return std::nullopt;
  return SurfaceCurve{"", values<double>(frame.surface, "surface/x"), values<double>(frame.surface, "surface/height")};
}

std::string gnuplot_script(const SurfaceFigure& figure) {
  const char* note = "Free surface behind a die of radius or half gap H; dashed: the height of its lip.";
  auto [script, top] = heading(figure.title, note, kWidth, kHeight, kTitleCharacters);
  script += axes(figure, top);
  std::string plot = "plot \\\n  1 with lines lw 1.2 dt (6,4) lc rgb '#8c8c8c' notitle, \\\n";
  for (std::size_t k = 0; k < figure.curves.size(); ++k) {
    const SurfaceCurve& curve = figure.curves[k];
    script += fmt::format("$surface_{} << END\n", k);
    for (std::size_t i = 0; i < curve.x.size(); ++i)
      script += fmt::format("{:.6g} {:.6g}\n", curve.x[i], curve.height[i]);
    script += "END\n";
    const auto [colour, dash] = style_of(k);
    plot += fmt::format("  $surface_{} using 1:2 with lines lw 2.5 dt {} lc rgb '#{}' {}, \\\n", k, dash, colour,
                        curve.label.empty() ? "notitle" : "title " + quoted(curve.label));
  }
  // The last curve is never seen; it saves the list above from a special last line.
  return script + plot + "  NaN notitle\n";
}

void draw(const SurfaceFigure& figure, const fs::path& svg) { draw_with_gnuplot(gnuplot_script(figure), svg); }

}  // namespace seapile::present
