#include "runner/present/series_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runner/present/gnuplot.h"
#include "runner/present/replicates.h"
#include "runner/present/thinning.h"

namespace seapile::present {
namespace {

namespace fs = std::filesystem;

// In pixels.
constexpr int kWidth = 900, kPanel = 280, kName = 40, kAxis = 96, kBelow = 84, kKeyLine = 20;
constexpr std::size_t kTitleCharacters = 80;

std::string axis_title(const std::string& name, const std::string& unit) {
  return quoted(unit.empty() || unit == "-" ? name : fmt::format("{} ({})", name, unit));
}

/// The factor to a readable unit, which takes the place of the axis' own.
double scale_of(const SeriesAxis& axis, std::string& unit) {
  double most = 0;
  for (const auto& run : axis.values) {
    for (const double value : run) most = std::isfinite(value) ? std::max(most, std::abs(value)) : most;
  }
  unit = axis.unit;
  return prefixed(unit, most);
}

/// A line that is broken where a value is none.
std::string block(const std::string& name, const std::vector<double>& x, double x_scale, const std::vector<double>& y,
                  double y_scale) {
  std::string lines = fmt::format("${} << END\n", name);
  for (const std::size_t i : thinned(y)) {
    const bool there = std::isfinite(x[i]) && std::isfinite(y[i]);
    lines += there ? fmt::format("{:.8g} {:.8g}\n", x[i] * x_scale, y[i] * y_scale) : "\n";
  }
  return lines + "END\n";
}

}  // namespace

SeriesFigure series_figure(const std::string& title, const std::vector<CurveSource>& sources, Series series,
                           const std::vector<std::string>& columns) {
  SeriesFigure figure{title, {}, {}, {}};
  for (const std::string& name : columns) figure.panels.push_back({name, unit_of(series, name), {}});
  for (const CurveSource& source : sources) {
    figure.runs.push_back(legend_text(source.labels));
    std::vector<std::vector<double>> values = read_columns(source, series, columns);
    for (std::size_t c = 0; c < columns.size(); ++c) figure.panels[c].values.push_back(std::move(values[c]));
  }
  figure.abscissa = std::move(figure.panels.front());
  figure.panels.erase(figure.panels.begin());
  return figure;
}

std::string gnuplot_script(const SeriesFigure& figure) {
  const auto panels = static_cast<int>(figure.panels.size());
  const auto titled =
      static_cast<int>(std::ranges::count_if(figure.runs, [](const std::string& run) { return !run.empty(); }));
  const int room = titled * kKeyLine + panels * kPanel + kBelow;
  const int height = heading(figure.title, "", kWidth, room, kTitleCharacters).bottom + room;
  auto [script, top] = heading(figure.title, "", kWidth, height, kTitleCharacters);
  const auto from_left = [](int pixels) { return static_cast<double>(pixels) / kWidth; };
  const auto from_top = [&](int pixels) { return 1 - static_cast<double>(pixels) / height; };
  script += fmt::format(
      "set border 3 lw 1 lc rgb '#8c8c8c'\n"
      "set format y '%g'\n"
      "set xtics out nomirror scale 0.6 tc rgb '#444444'\n"
      "set ytics out nomirror scale 0.6 tc rgb '#444444'\n"
      "set grid xtics ytics back lt 1 lw 1 lc rgb '#e8e8e8'\n"
      "set offsets 0, 0, graph 0.05, graph 0.05\n"
      "set key at screen {:.4f},{:.4f} left top vertical reverse Left noenhanced samplen 2 tc rgb '#1a1a1a'\n"
      "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset multiplot\n",
      from_left(kAxis), from_top(top - kHeadingSide / 2), from_left(kAxis), 1 - from_left(kHeadingSide));
  top += titled * kKeyLine;
  std::string x_unit;
  const double x_scale = scale_of(figure.abscissa, x_unit);
  for (int p = 0; p < panels; ++p) {
    const SeriesAxis& panel = figure.panels[static_cast<std::size_t>(p)];
    std::string unit;
    const double scale = scale_of(panel, unit);
    const bool last = p + 1 == panels;
    script += fmt::format("set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n",
                          from_top(top + p * kPanel + kName), from_top(top + (p + 1) * kPanel));
    script += fmt::format("set label 99 {} at graph 0,1 offset 0,0.7 left noenhanced tc rgb '#1a1a1a'\n",
                          axis_title(panel.name, unit));
    script += last ? fmt::format("set format x '%g'\nset xlabel {} noenhanced tc rgb '#1a1a1a'\n",
                                 axis_title(figure.abscissa.name, x_unit))
                   : "set format x ''\n";
    std::string plot;
    for (std::size_t k = 0; k < figure.runs.size(); ++k) {
      const std::string name = fmt::format("line_{}_{}", p, k);
      script += block(name, figure.abscissa.values[k], x_scale, panel.values[k], scale);
      const auto [colour, dash] = style_of(k);
      const bool in_key = p == 0 && !figure.runs[k].empty();
      plot += fmt::format("  ${} using 1:2 with lines lw 2 dt {} lc rgb '#{}' {}, \\\n", name, dash, colour,
                          in_key ? "title " + quoted(figure.runs[k]) : "notitle");
    }
    // The last curve is never seen; it saves the list from a special last line. The heading is written once.
    script += "plot \\\n" + plot + "  NaN notitle\nunset label\n";
  }
  return script + "unset multiplot\n";
}

void draw(const SeriesFigure& figure, const fs::path& svg) {
  draw_with_gnuplot(gnuplot_script(figure), fs::absolute(svg));
}

}  // namespace seapile::present
