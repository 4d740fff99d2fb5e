#include "runner/present/crossing.h"

#include <fmt/format.h>

#include <algorithm>

namespace seapile::present {

std::vector<Crossing> crossings(const Trend& trend, double value) {
  std::vector<std::string> order;
  for (const TrendCase& one : trend.cases)
    if (std::ranges::find(order, one.series) == order.end()) order.push_back(one.series);

  std::vector<Crossing> found;
  for (const std::string& series : order) {
    std::vector<std::pair<double, double>> line;
    for (const TrendCase& one : trend.cases)
      if (one.series == series) line.emplace_back(one.x.mean, one.y.mean);
    std::ranges::sort(line);
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto [x, y] = line[i];
      if (y == value) {
        found.push_back({series, x, x, x});
      } else if (i > 0 && (y - value) * (line[i - 1].second - value) < 0) {
        const auto [x0, y0] = line[i - 1];
        found.push_back({series, x0 + (x - x0) * (value - y0) / (y - y0), x0, x});
      }
    }
  }
  return found;
}

std::string crossing_text(const Trend& trend, double value) {
  const auto unit = [](const std::string& name) { return name.empty() || name == "-" ? "" : " " + name; };
  const std::vector<Crossing> found = crossings(trend, value);
  if (found.empty()) return fmt::format("{} does not pass {:g}{}\n", trend.question.of, value, unit(trend.of_unit));
  std::string text;
  for (const Crossing& one : found)
    text += fmt::format("{}{}{} is {:g}{} at {} = {:.4g}{} (linear between {:g} and {:g})\n", one.series,
                        one.series.empty() ? "" : ": ", trend.question.of, value, unit(trend.of_unit),
                        trend.question.against, one.x, unit(trend.against_unit), one.low, one.high);
  return text;
}

}  // namespace seapile::present
