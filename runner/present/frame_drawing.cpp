#include "runner/present/frame_drawing.h"

#include <fmt/format.h>

#include <algorithm>

#include "runner/present/axis.h"
#include "runner/present/frame_legend.h"
#include "runner/present/frame_marks.h"
#include "runner/present/lettering.h"

namespace seapile::present {
namespace {

// In units of the canvas.
constexpr double kWidest = 640, kTallest = 480;  ///< a panel
constexpr double kSide = 14, kHeading = 26, kPanelTitle = 22, kName = 18, kBottomAxis = 38, kRemark = 22, kGap = 18;
constexpr double kLeastLegend = 170;                    ///< height
constexpr double kLeastPanel = 165, kLeastWidth = 520;  ///< room for a title, for the remark
constexpr double kTick = 4, kTickEvery = 45, kDigit = 6.8;

const char* heading(FigureKind kind) {
  switch (kind) {
    case FigureKind::bed:
      return "Grains by their initial layer";
    case FigureKind::forces:
      return "Contact forces";
    case FigureKind::stress:
      return "Principal stresses";
    case FigureKind::velocity:
      return "Velocities";
  }
  return "";
}

std::string title_of(const FramePanel& panel) { return fmt::format("{}, d = {:.3f} m", panel.title, panel.depth); }

/// Room for the numbers beside the panels' left edges.
double room_for_numbers(const FrameFigure& figure, double step) {
  std::size_t longest = 0;
  for (const FramePanel& panel : figure.panels) {
    for (const Tick& tick : ticks(panel.view.bottom, panel.view.top, step))
      longest = std::max(longest, tick.text.size());
  }
  return static_cast<double>(longest) * kDigit + kTick + 3;
}

struct Steps {
  double x = 0, y = 0;  ///< [m]
};

/// `name_at`: how far left of the panel the y axis is named; 0: nowhere.
void draw_axes(cairo_t* context, const Mapping& map, const Steps& steps, double name_at) {
  cairo_set_source_rgb(context, 0.2, 0.2, 0.2);
  cairo_set_line_width(context, 0.8);
  cairo_rectangle(context, map.left, map.top, map.right() - map.left, map.bottom() - map.top);
  cairo_stroke(context);
  const Lettering numbers{10.5, Align::middle};
  for (const Tick& tick : ticks(map.view.left, map.view.right, steps.x)) {
    const double x = map({tick.value, 0}).x;
    cairo_move_to(context, x, map.bottom());
    cairo_line_to(context, x, map.bottom() + kTick);
    cairo_stroke(context);
    write(context, x, map.bottom() + 15, tick.text, numbers);
  }
  for (const Tick& tick : ticks(map.view.bottom, map.view.top, steps.y)) {
    const double y = map({0, tick.value}).y;
    cairo_move_to(context, map.left - kTick, y);
    cairo_line_to(context, map.left, y);
    cairo_stroke(context);
    write(context, map.left - kTick - 3, y + 3.7, tick.text, {10.5, Align::right});
  }
  const Lettering names{11, Align::middle};
  write(context, (map.left + map.right()) / 2, map.bottom() + 31, "x [m]", names);
  if (name_at == 0) return;
  const std::string whole = "height above the base y [m]", height = whole.substr(whole.rfind("y "));
  const bool fits = text_width(context, whole, names) < map.bottom() - map.top;
  write(context, map.left - name_at, (map.top + map.bottom()) / 2, fits ? whole : height, names, true);
}

void draw_panel(cairo_t* context, const FrameFigure& figure, const FramePanel& panel, const Mapping& map) {
  cairo_save(context);
  cairo_rectangle(context, map.left, map.top, map.right() - map.left, map.bottom() - map.top);
  cairo_clip(context);
  draw_grains(context, map, panel.grains,
              figure.kind == FigureKind::bed      ? GrainLook::layered
              : figure.kind == FigureKind::forces ? GrainLook::outlined
                                                  : GrainLook::shaded);
  draw_stresses(context, map, panel.stresses, figure.scale.full);
  draw_forces(context, map, panel.forces);
  draw_surface(context, map, panel.box, panel.surface);
  draw_pile(context, map, panel.pile);
  draw_box(context, map, panel.box);
  draw_velocities(context, map, panel.velocities);
  cairo_restore(context);
}

}  // namespace

std::string picture_of(const FrameFigure& figure, PictureFormat format) {
  double widest = 0, tallest = 0;
  for (const FramePanel& panel : figure.panels) {
    widest = std::max(widest, panel.view.width());
    tallest = std::max(tallest, panel.view.height());
  }
  const double scale = std::min(kWidest / widest, kTallest / tallest);
  const auto step = [&](double length, int least) {
    return nice_step(length, std::max(least, static_cast<int>(length * scale / kTickEvery)));
  };
  const Steps steps{step(widest, 1), step(tallest, 3)};
  const double legend = legend_width(figure.kind), numbers = room_for_numbers(figure, steps.y);
  const double tall = std::max(tallest * scale, legend > 0 ? kLeastLegend : 0);
  const double top = kSide + kHeading + kPanelTitle;
  const auto room = [&](const FramePanel& panel) { return std::max(panel.view.width() * scale, kLeastPanel); };
  double width = 2 * kSide + kName - kGap + (legend > 0 ? kGap + legend : 0);
  for (const FramePanel& panel : figure.panels) width += numbers + room(panel) + kGap;
  width = std::max(width, kLeastWidth);

  Canvas canvas(format, width, top + tall + kBottomAxis + kRemark + kSide);
  cairo_t* context = canvas.context();
  std::string description = fmt::format("{}.", heading(figure.kind));
  write(context, kSide, kSide + 14, heading(figure.kind), {15, Align::left, true});
  double left = kSide + kName;
  for (const FramePanel& panel : figure.panels) {
    left += numbers;
    const Mapping map{panel.view, left, top, scale};
    draw_panel(context, figure, panel, map);
    draw_axes(context, map, steps, &panel == &figure.panels.front() ? numbers + 5 : 0);
    write_within(context, left, top - 7, room(panel), title_of(panel), {12, Align::left, true});
    description += fmt::format(" {}.", title_of(panel));
    left += room(panel) + kGap;
  }
  if (legend > 0) draw_legend(context, figure, left, top, tall, scale);
  const std::string line = remark(figure);
  write_within(context, kSide, top + tall + kBottomAxis + 14, width - 2 * kSide, line,
               {10.5, Align::left, false, 0.35});
  return canvas.finish(description + " " + line);
}

}  // namespace seapile::present
