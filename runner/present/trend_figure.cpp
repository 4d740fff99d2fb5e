#include "runner/present/trend_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runner/present/gnuplot.h"
#include "runner/present/table.h"

namespace seapile::present {
namespace {

namespace fs = std::filesystem;

// In pixels.
constexpr int kPanel = 620, kHeight = 620, kAxis = 92, kGap = 24;
constexpr std::size_t kCharactersPerPanel = 54;

/// One line of a panel: its cases by rising abscissa.
struct Series {
  std::string name;
  std::vector<const TrendCase*> cases;
};

std::vector<Series> series_of(const Trend& trend) {
  std::vector<Series> all;
  for (const TrendCase& one : trend.cases) {
    auto found = std::ranges::find(all, one.series, &Series::name);
    if (found == all.end()) found = all.insert(all.end(), Series{one.series, {}});
    found->cases.push_back(&one);
  }
  for (Series& series : all) {
    std::ranges::stable_sort(series.cases, {}, [](const TrendCase* one) { return one->x.mean; });
  }
  return all;
}

/// A point with its bars: those that it lacks have no length.
std::string bar_line(const Interval& x, const Interval& y, double x_scale, double y_scale) {
  const auto end = [](double value, double mean) { return std::isnan(value) ? mean : value; };
  return fmt::format("{:.8g} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g}\n", x.mean * x_scale, y.mean * y_scale,
                     end(x.low, x.mean) * x_scale, end(x.high, x.mean) * x_scale, end(y.low, y.mean) * y_scale,
                     end(y.high, y.mean) * y_scale);
}

std::string point_lines(const std::vector<std::pair<double, double>>& points, double x_scale, double y_scale) {
  std::string lines;
  for (const auto& [x, y] : points) lines += fmt::format("{:.8g} {:.8g}\n", x * x_scale, y * y_scale);
  return lines;
}

/// The data of one panel and the commands that draw it.
struct Panel {
  std::string blocks, plot;
};

void add_series(Panel& panel, const std::string& block, std::size_t style, const std::string& title,
                const std::string& means, const std::string& runs) {
  if (means.empty()) return;
  const auto [colour, dash] = style_of(style);
  panel.blocks += fmt::format("$mean_{0} << END\n{1}END\n$run_{0} << END\n{2}END\n", block, means, runs);
  panel.plot += fmt::format("  $run_{} using 1:2 with points pt 7 ps 0.5 lc rgb '#a0{}' notitle, \\\n", block, colour);
  panel.plot +=
      fmt::format("  $mean_{} using 1:2 with lines lw 1.5 dt {} lc rgb '#60{}' notitle, \\\n", block, dash, colour);
  panel.plot += fmt::format("  $mean_{} using 1:2:3:4:5:6 with xyerrorbars pt 7 ps 0.9 lw 2 lc rgb '#{}' {}, \\\n",
                            block, colour, title.empty() ? "notitle" : "title " + quoted(title));
}

std::string axis_title(const std::string& name, const std::string& unit) {
  return quoted(unit.empty() || unit == "-" ? name : fmt::format("{} ({})", name, unit));
}

double largest(const Trend& trend, bool abscissa) {
  double most = 0;
  for (const TrendCase& one : trend.cases) {
    for (const auto& [x, y] : one.runs) most = std::max(most, std::abs(abscissa ? x : y));
  }
  return most;
}

}  // namespace

std::string gnuplot_script(const std::string& title, const Trend& trend) {
  const bool has_effect = !trend.reference.empty();
  const int width = (has_effect ? 2 : 1) * kPanel;
  std::string x_unit = trend.against_unit, y_unit = trend.of_unit;
  const double x_scale = prefixed(x_unit, largest(trend, true)), y_scale = prefixed(y_unit, largest(trend, false));

  Panel left, right;
  const std::vector<Series> all = series_of(trend);
  for (std::size_t s = 0; s < all.size(); ++s) {
    std::string means, runs, ratios, pairs;
    for (const TrendCase* one : all[s].cases) {
      means += bar_line(one->x, one->y, x_scale, y_scale);
      runs += point_lines(one->runs, x_scale, y_scale);
      if (!one->ratio || one->ratio->n == 0) continue;
      ratios += bar_line(one->x, *one->ratio, x_scale, 1);
      pairs += point_lines(one->ratios, x_scale, 1);
    }
    add_series(left, fmt::format("left_{}", s), s, all[s].name, means, runs);
    add_series(right, fmt::format("right_{}", s), s, all[s].name, ratios, pairs);
  }

  const bool replicated = std::ranges::any_of(trend.cases, [](const TrendCase& one) { return one.runs.size() > 1; });
  const std::string note = replicated
                               ? fmt::format("Bars: {:g} % interval of the mean over packings; faint: each packing.",
                                             100 * trend.question.level)
                               : "One packing: no interval.";
  const Heading head =
      heading(title, note, width, kHeight, kCharactersPerPanel * static_cast<std::size_t>(width / kPanel));
  std::string script = head.script;
  script +=
      "set border 3 lw 1 lc rgb '#8c8c8c'\n"
      "set xtics out nomirror scale 0.6 tc rgb '#444444'\n"
      "set ytics out nomirror scale 0.6 tc rgb '#444444'\n"
      "set grid xtics ytics back lt 1 lw 1 lc rgb '#e8e8e8'\n"
      "set offsets graph 0.05, graph 0.05, graph 0.12, 0\n"
      "set key top left inside reverse Left noenhanced samplen 1.5 spacing 1.25 tc rgb '#1a1a1a'\n";
  script += fmt::format("set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n",
                        1 - static_cast<double>(head.bottom + kGap) / kHeight, 70.0 / kHeight);
  script += fmt::format("set xlabel {} noenhanced tc rgb '#1a1a1a'\n", axis_title(trend.question.against, x_unit));
  script += left.blocks + right.blocks + "set multiplot\n";
  // The last curve is never seen; it saves the lists from a special last line.
  const auto draw_panel = [&](int index, const std::string& y_title, const std::string& plot) {
    const double from = index * kPanel + kAxis, to = (index + 1) * kPanel - kHeadingSide;
    script += fmt::format("set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n", from / width, to / width);
    script += fmt::format("set ylabel {} noenhanced tc rgb '#1a1a1a'\nplot \\\n{}  NaN notitle\n", y_title, plot);
  };
  draw_panel(0, axis_title(trend.question.of, y_unit), left.plot);
  if (has_effect) {
    script += "unset label\n";
    draw_panel(1, quoted("ratio to " + trend.reference + ", on the same bed"),
               "  1 with lines lw 1 dt (6,4) lc rgb '#8c8c8c' notitle, \\\n" + right.plot);
  }
  return script + "unset multiplot\n";
}

void draw(const std::string& title, const Trend& trend, const fs::path& svg) {
  draw_with_gnuplot(gnuplot_script(title, trend), fs::absolute(svg));
}

}  // namespace seapile::present
