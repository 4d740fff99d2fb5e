#include "runner/present/trade_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runner/present/gnuplot.h"

namespace seapile::present {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 1100, kPlot = 760, kAxis = 118, kGap = 24, kBottom = 70, kLine = 17;  // pixels
constexpr std::size_t kCharacters = 104;
constexpr double kPercent = 100;

/// What is drawn where an error is 0, or its interval ends there, by the smallest that is not.
constexpr double kBelow = 0.5;

struct Point {
  std::string name;
  double cpu = 0, error = 0, low = 0, high = 0;  ///< [s], [%]
  bool on_frontier = false, failed = false;
};

std::vector<Point> points_of(const TradedGroup& group, std::size_t metric) {
  std::vector<Point> points;
  for (const TradeLevel& level : judge(group)) {
    const TradeError& error = level.errors[metric];
    const bool failed = level.completed < level.asked;
    if (level.name == group.against || (error.n == 0 && !failed)) continue;
    Point point{level.name, level.cpu_seconds, kPercent * std::abs(error.error.mean), 0, 0, level.on_frontier[metric],
                failed};
    // Of a signed difference that may be none the interval reaches down to 0.
    const double a = kPercent * error.error.low, b = kPercent * error.error.high;
    point.low = a * b > 0 ? std::min(std::abs(a), std::abs(b)) : 0;
    point.high = std::max(std::abs(a), std::abs(b));
    if (std::isnan(a)) point.low = point.high = point.error;
    points.push_back(point);
  }
  return points;
}

double median_half_width(const std::vector<Point>& points) {
  std::vector<double> half;
  for (const Point& point : points)
    if (!point.failed && point.high > point.error) half.push_back(point.high - point.error);
  if (half.empty()) return 0;
  std::ranges::sort(half);
  return half[half.size() / 2];
}

}  // namespace

std::string gnuplot_script(const std::string& title, const TradedGroup& group, std::size_t metric) {
  std::vector<Point> points = points_of(group, metric);
  // As high as the list of names needs.
  const int height = std::max(640, 160 + kLine * static_cast<int>(points.size()));
  double least = INFINITY, most = 0, cheapest = INFINITY;
  for (const Point& point : points) {
    if (point.failed) continue;
    if (point.error > 0) least = std::min(least, point.error);
    most = std::max(most, point.high);
    cheapest = std::min(cheapest, point.cpu);
  }
  if (!std::isfinite(least)) least = most = 1;
  const double floor = kBelow * least, ceiling = 4 * most;
  std::ranges::stable_sort(points, {}, &Point::cpu);

  const std::string note =
      "Bars: 95 % intervals; joined: nothing measured is both cheaper and closer (upper ends); dashed: half an "
      "interval, what packings cannot tell.";
  const Heading head = heading(title, note, kWidth, height, kCharacters);

  std::string all, frontier, failed, names;
  const auto label = [&](const std::string& text, const std::string& at, const char* colour) {
    names += fmt::format("set label {} at {} noenhanced front font ',11' tc rgb '{}'\n", quoted(text), at, colour);
  };
  int number = 0;
  for (const Point& point : points) {
    // Numbers beside the points, names in a list, from the cheapest on.
    const std::string name = fmt::format("{}  {}{}", ++number, point.name, point.failed ? " (no result)" : "");
    const char* colour = point.failed ? "#b02020" : point.on_frontier ? "#1a1a1a" : "#707070";
    label(name,
          fmt::format("screen {:.4f}, screen {:.4f}", static_cast<double>(kPlot + kGap) / kWidth,
                      1 - (head.bottom + kGap + (number - 1.0) * kLine) / height),
          colour);
    const double cpu = std::isnan(point.cpu) ? cheapest : point.cpu,
                 y = point.failed ? 0.8 * ceiling : std::max(point.error, floor);
    label(fmt::format("{}", number), fmt::format("{:.6g},{:.6g} offset 0.6,0.5", cpu, y), colour);
    if (point.failed) {
      failed += fmt::format("{:.6g} {:.6g}\n", cpu, y);
      continue;
    }
    all +=
        fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}\n", cpu, y, std::max(point.low, floor), std::max(point.high, floor));
    if (point.on_frontier) frontier += fmt::format("{:.6g} {:.6g}\n", cpu, y);
  }
  std::string script = head.script;
  script += std::string(kLogarithmicAxes) + "unset key\n";
  script += fmt::format("set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n",
                        1 - static_cast<double>(head.bottom + kGap) / height, static_cast<double>(kBottom) / height);
  script += fmt::format("set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n",
                        static_cast<double>(kAxis) / kWidth, static_cast<double>(kPlot) / kWidth);
  script += fmt::format("set xrange [{:.6g}:*<{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", 0.7 * cheapest, 1e9, 0.6 * floor,
                        ceiling);
  script +=
      fmt::format("set xlabel 'CPU time of a run (s)' tc rgb '#1a1a1a'\nset ylabel {} noenhanced tc rgb '#1a1a1a'\n",
                  quoted(fmt::format("error of {} (%)", group.metrics[metric])));
  script += names;
  const auto [colour, dash] = style_of(0);
  script += fmt::format("$all << END\n{}END\n", all);
  if (!frontier.empty()) script += fmt::format("$frontier << END\n{}END\n", frontier);
  if (!failed.empty()) script += fmt::format("$failed << END\n{}END\n", failed);
  script += "plot \\\n";
  if (const double noise = median_half_width(points); noise > 0)
    script += fmt::format("  {:.6g} with lines lw 1 dt (6,4) lc rgb '#8c8c8c', \\\n", noise);
  if (!frontier.empty()) script += fmt::format("  $frontier with lines lw 2 lc rgb '#80{}', \\\n", colour);
  if (!failed.empty()) script += "  $failed with points pt 2 ps 1.2 lw 2 lc rgb '#b02020', \\\n";
  script += fmt::format("  $all using 1:2:3:4 with yerrorbars pt 7 ps 0.8 lw 1.5 lc rgb '#{}'\n", colour);
  return script;
}

void draw(const std::string& title, const TradedGroup& group, std::size_t metric, const fs::path& svg) {
  draw_with_gnuplot(gnuplot_script(title, group, metric), fs::absolute(svg));
}

}  // namespace seapile::present
