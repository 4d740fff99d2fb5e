#include "runner/present/frame_legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runner/present/axis.h"
#include "runner/present/colour_bar.h"
#include "runner/present/colour_map.h"
#include "runner/present/frame_marks.h"
#include "runner/present/lettering.h"

namespace seapile::present {
namespace {

constexpr double kShortestBar = 80, kTallestBar = 240;

/// The largest of 1, 2 or 5 times a power of ten that is not above a value > 0.
double nice_below(double value) {
  const double step = nice_step(value, 1);
  if (step <= value * (1 + 1e-9)) return step;
  const double power = std::pow(10, std::floor(std::log10(step) + 1e-9));
  return step / power < 3 ? step / 2 : step / 2.5;  // 1 or 2, or 5
}

struct Prefix {
  const char* unit;
  double size;
};

Prefix pressure_prefix(double full) {
  return full >= 1e6 ? Prefix{"MPa", 1e6} : full >= 1e3 ? Prefix{"kPa", 1e3} : Prefix{"Pa", 1};
}

void draw_force_legend(cairo_t* context, const FrameFigure& figure, double x, double y, double scale) {
  write(context, x, y + 9, "normal force", {11});
  write(context, x, y + 23, "[N/m]", {11});
  const double largest = nice_below(figure.scale.full);
  double at = y + 44;
  for (const double share : {1.0, 0.5, 0.2, 0.1}) {
    const double force = share * largest;
    set_colour(context, {0.13, 0.13, 0.40});
    cairo_set_line_cap(context, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_width(context, force / figure.scale.full * figure.scale.length * scale);
    cairo_move_to(context, x, at);
    cairo_line_to(context, x + 32, at);
    cairo_stroke(context);
    write(context, x + 40, at + 3.7, fmt::format("{:g}", force), {10.5});
    at += 22;
  }
}

void draw_stress_legend(cairo_t* context, const FrameFigure& figure, double x, double y, double height, double scale) {
  const auto [unit, size] = pressure_prefix(figure.scale.full);
  write(context, x, y + 9, "major principal", {11});
  write(context, x, y + 23, fmt::format("stress [{}]", unit), {11});
  const double bottom = draw_bar(context, x, y + 36, std::clamp(height - 120, kShortestBar, kTallestBar), 0,
                                 figure.scale.full / size, false);
  // A circle: a stress that is the same in all directions.
  const double stress = nice_below(figure.scale.full / size),
               radius = stress * size / figure.scale.full * figure.scale.length * scale;
  const double middle = bottom + 22 + radius;
  cairo_new_path(context);
  cairo_arc(context, x + radius, middle, radius, 0, 2 * std::numbers::pi);
  set_colour(context, {0.4, 0.4, 0.4});
  cairo_set_line_width(context, 0.8);
  cairo_stroke(context);
  cairo_move_to(context, x + radius, middle);
  cairo_line_to(context, x + 2 * radius, middle);
  cairo_stroke(context);
  write(context, x + 2 * radius + 6, middle + 3.7, fmt::format("{:g} {}", stress, unit), {10.5});
}

void draw_velocity_legend(cairo_t* context, const FrameFigure& figure, double x, double y, double height,
                          double scale) {
  write(context, x, y + 9, "speed over", {11});
  write(context, x, y + 23, "the pile's [-]", {11});
  const double bottom = draw_bar(context, x, y + 36, std::clamp(height - 120, kShortestBar, kTallestBar), 0, 1, true);
  const double length = figure.scale.length * scale;
  set_colour(context, colour_of(1));
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_width(context, 1);
  add_arrow(context, {x, bottom + 28}, {x + length, bottom + 28});
  cairo_stroke(context);
  write(context, x + length + 6, bottom + 31.7, "the pile's", {10.5});
}

}  // namespace

double legend_width(FigureKind kind) { return kind == FigureKind::bed || kind == FigureKind::initial ? 0 : 104; }

void draw_legend(cairo_t* context, const FrameFigure& figure, double x, double y, double height, double scale) {
  if (figure.scale.full <= 0) return;
  if (figure.kind == FigureKind::forces) draw_force_legend(context, figure, x, y, scale);
  if (figure.kind == FigureKind::stress) draw_stress_legend(context, figure, x, y, height, scale);
  if (figure.kind == FigureKind::velocity) draw_velocity_legend(context, figure, x, y, height, scale);
}

std::vector<std::string> remarks(const FrameFigure& figure) {
  switch (figure.kind) {
    case FigureKind::initial: {
      std::vector<std::string> lines;
      if (figure.panels.size() == 1) lines = figure.panels.front().sizes;
      if (figure.panels.size() > 1) {
        for (const FramePanel& panel : figure.panels)
          lines.push_back(fmt::format("{}: {}", panel.title, fmt::join(panel.sizes, " ")));
      }
      const bool wet = std::ranges::any_of(figure.panels, [](const FramePanel& panel) { return !panel.water.empty(); });
      lines.push_back(std::string("Dashed: the bed's surface.") +
                      (wet ? " Blue: the fluid and its free surface." : ""));
      return lines;
    }
    case FigureKind::bed:
      return {fmt::format(
          "Tones change every {:g} m of the height at which a grain lay before the drive. Dashed: the bed's "
          "surface then.",
          figure.scale.layer)};
    case FigureKind::forces:
      return {"A line per contact, as wide as its normal force is large; between centres, or to the point of contact."};
    case FigureKind::stress:
      return {
          "An ellipse per cell: semi-axes as long as the principal stresses, the longer one along the major stress."};
    case FigureKind::velocity: {
      std::vector<std::string> speeds;
      for (const FramePanel& panel : figure.panels) speeds.push_back(fmt::format("{:g} m/s", panel.pile_speed));
      if (std::ranges::count(speeds, speeds.front()) == std::ssize(speeds)) speeds.resize(1);
      return {
          fmt::format("An arrow per grain, from its centre. Largest speed of the pile: {}.", fmt::join(speeds, "; "))};
    }
  }
  return {};
}

}  // namespace seapile::present
