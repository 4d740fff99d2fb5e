#include "runner/present/edge_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runner/present/gnuplot.h"

namespace seapile::present {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 820, kHeight = 600, kAxis = 110, kGap = 24, kBottom = 70;  // pixels
constexpr std::size_t kCharacters = 78;
constexpr double kRoom = 1.6;  // beyond what is drawn, a factor

/// One line of the map.
struct Line {
  std::string name;
  std::string bars, holds, fails;  ///< found; always holds; never holds
};

std::string name_of(const Labels& labels, const std::string& abscissa) {
  std::string name;
  for (const auto& [path, value] : labels) {
    if (path == abscissa) continue;
    const auto dot = path.rfind('.');
    name +=
        fmt::format("{}{} {}", name.empty() ? "" : ", ", path.substr(dot == std::string::npos ? 0 : dot + 1), value);
  }
  return name;
}

/// The first label that is a positive number in every search; "" when there is none.
std::string abscissa_of(const std::vector<EdgeSearch>& searches) {
  if (searches.empty()) return "";
  for (const auto& [path, unused] : searches.front().labels) {
    const bool numbers = std::ranges::all_of(searches, [&](const EdgeSearch& search) {
      const auto found = std::ranges::find(search.labels, path, &Labels::value_type::first);
      const auto number = found == search.labels.end() ? std::nullopt : quantity(found->second);
      return number && number->first > 0;
    });
    if (numbers) return path;
  }
  return "";
}

void add(Line& line, double x, const EdgeSearch& search) {
  const EdgeState state = judge(search);
  switch (state.end) {
    case EdgeEnd::found:
      line.bars += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}\n", x, std::sqrt(state.last_good * state.first_bad),
                               std::min(state.last_good, state.first_bad), std::max(state.last_good, state.first_bad));
      break;
    case EdgeEnd::always_holds:
      line.holds += fmt::format("{:.6g} {:.6g}\n", x, search.bad);
      break;
    case EdgeEnd::never_holds:
      line.fails += fmt::format("{:.6g} {:.6g}\n", x, search.good);
      break;
    case EdgeEnd::searching:
      break;
  }
}

/// 1, 2 and 5 times powers of ten between two positive numbers, as gnuplot takes them.
std::string tics_between(double low, double high) {
  std::string tics;
  for (double decade = std::pow(10, std::floor(std::log10(low))); decade <= high; decade *= 10)
    for (const double times : {1, 2, 5})
      if (const double at = times * decade; at >= low && at <= high)
        tics += fmt::format("{}{:.6g}", tics.empty() ? "" : ", ", at);
  return "(" + tics + ")";
}

std::string titled(const std::string& name, const std::string& unit) {
  return quoted(unit.empty() || unit == "-" ? name : fmt::format("{} ({})", name, unit));
}

}  // namespace

std::string gnuplot_script(const std::string& title, const std::vector<EdgeSearch>& searches) {
  const std::string abscissa = abscissa_of(searches);
  if (abscissa.empty()) return "";
  std::vector<Line> lines;
  std::string unit;
  double left = INFINITY, right = 0, low = INFINITY, high = 0;  // of what is drawn
  for (const EdgeSearch& search : searches) {
    const auto x = quantity(std::ranges::find(search.labels, abscissa, &Labels::value_type::first)->second);
    unit = x->second;
    left = std::min(left, x->first);
    right = std::max(right, x->first);
    const EdgeState state = judge(search);
    for (const double y : {state.end == EdgeEnd::always_holds ? search.bad : state.last_good,
                           state.end == EdgeEnd::always_holds  ? search.bad
                           : state.end == EdgeEnd::never_holds ? search.good
                                                               : state.first_bad}) {
      low = std::min(low, y);
      high = std::max(high, y);
    }
    const std::string name = name_of(search.labels, abscissa);
    auto line = std::ranges::find(lines, name, &Line::name);
    if (line == lines.end()) line = lines.insert(lines.end(), Line{name, "", "", ""});
    add(*line, x->first, search);
  }
  const Heading head = heading(title,
                               "Bars: from the last value that holds to the first that does not; triangles: holds (up) "
                               "or fails (down) as far as was tried.",
                               kWidth, kHeight, kCharacters);
  std::string script = head.script;
  script += std::string(kLogarithmicAxes) +
            "set format xy '%g'\n"
            "set key outside right top reverse Left noenhanced samplen 1.5 spacing 1.25 tc rgb '#1a1a1a'\n";
  script += fmt::format("set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\nset lmargin at screen {:.4f}\n",
                        1 - static_cast<double>(head.bottom + kGap) / kHeight, static_cast<double>(kBottom) / kHeight,
                        static_cast<double>(kAxis) / kWidth);
  script += fmt::format("set xlabel {} noenhanced tc rgb '#1a1a1a'\nset ylabel {} noenhanced tc rgb '#1a1a1a'\n",
                        titled(abscissa, unit), titled(searches.front().path, searches.front().unit));
  script += fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", left / kRoom, right * kRoom,
                        low / kRoom, high * kRoom);
  script += fmt::format("set xtics {}\nset ytics {}\n", tics_between(left / kRoom, right * kRoom),
                        tics_between(low / kRoom, high * kRoom));
  std::string plot;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto [colour, dash] = style_of(i);
    std::string key = lines[i].name.empty() ? "notitle" : "title " + present::quoted(lines[i].name);
    const auto curve = [&](const char* block, const std::string& data, const std::string& with) {
      if (data.empty()) return;
      script += fmt::format("${}_{} << END\n{}END\n", block, i, data);
      plot += fmt::format("{}  ${}_{} {} lc rgb '#{}' {}", plot.empty() ? "" : ", \\\n", block, i, with, colour, key);
      key = "notitle";
    };
    curve("found", lines[i].bars, "using 1:2:3:4 with yerrorbars pt 7 ps 0.7 lw 2");
    curve("line", lines[i].bars, fmt::format("using 1:2 with lines lw 1 dt {}", dash));
    curve("holds", lines[i].holds, "using 1:2 with points pt 9 ps 1.4");
    curve("fails", lines[i].fails, "using 1:2 with points pt 11 ps 1.4");
  }
  if (plot.empty()) return "";
  return script + "plot \\\n" + plot + "\n";
}

bool draw(const std::string& title, const std::vector<EdgeSearch>& searches, const fs::path& svg) {
  const std::string script = gnuplot_script(title, searches);
  if (script.empty()) return false;
  draw_with_gnuplot(script, fs::absolute(svg));
  return true;
}

}  // namespace seapile::present
