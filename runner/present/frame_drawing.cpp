#include "runner/present/frame_drawing.h"

#include <fmt/format.h>

#include <algorithm>

#include "runner/present/frame_axes.h"
#include "runner/present/frame_legend.h"
#include "runner/present/frame_marks.h"
#include "runner/present/lettering.h"

namespace seapile::present {
namespace {

// In units of the canvas.
constexpr double kWidest = 640, kTallest = 480;  ///< a panel
constexpr double kSide = 14, kHeading = 26, kPanelTitle = 22, kName = 18, kRemark = 22, kMoreRemark = 16, kGap = 18;
constexpr double kLeastLegend = 170;                    ///< height
constexpr double kLeastPanel = 165, kLeastWidth = 520;  ///< room for a title, for the remark

const AxisNames kNames = {"x [m]", "height above the base y [m]", "y [m]"};

const char* heading(FigureKind kind) {
  switch (kind) {
    case FigureKind::initial:
      return "Initial configuration";
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

GrainLook look_of(FigureKind kind) {
  if (kind == FigureKind::initial) return GrainLook::filled;
  if (kind == FigureKind::bed) return GrainLook::layered;
  return kind == FigureKind::forces ? GrainLook::outlined : GrainLook::shaded;
}

std::string title_of(const FramePanel& panel) { return fmt::format("{}, d = {:.3f} m", panel.title, panel.depth); }

void draw_panel(cairo_t* context, const FrameFigure& figure, const FramePanel& panel, const Mapping& map) {
  cairo_save(context);
  cairo_rectangle(context, map.left, map.top, map.right() - map.left, map.bottom() - map.top);
  cairo_clip(context);
  draw_water(context, map, panel.box, panel.water);
  draw_grains(context, map, panel.grains, look_of(figure.kind));
  draw_stresses(context, map, panel.stresses, figure.scale.full);
  draw_forces(context, map, panel.forces);
  draw_surface(context, map, panel.box, panel.surface);
  draw_water_surface(context, map, panel.water);  // Under the pile, behind which a frame closes it.
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
  const Steps steps = axis_steps(widest, tallest, scale);
  double numbers = 0;
  for (const FramePanel& panel : figure.panels) numbers = std::max(numbers, room_for_numbers(panel.view, steps.y));
  const double legend = legend_width(figure.kind);
  const double tall = std::max(tallest * scale, legend > 0 ? kLeastLegend : 0);
  const double top = kSide + kHeading + kPanelTitle;
  const auto room = [&](const FramePanel& panel) { return std::max(panel.view.width() * scale, kLeastPanel); };
  double width = 2 * kSide + kName - kGap + (legend > 0 ? kGap + legend : 0);
  for (const FramePanel& panel : figure.panels) width += numbers + room(panel) + kGap;
  width = std::max(width, kLeastWidth);
  const std::vector<std::string> lines = remarks(figure);
  const double below = kRemark + kMoreRemark * static_cast<double>(lines.size() - 1);

  Canvas canvas(format, width, top + tall + kBottomAxis + below + kSide);
  cairo_t* context = canvas.context();
  std::string description = fmt::format("{}.", heading(figure.kind));
  write(context, kSide, kSide + 14, heading(figure.kind), {15, Align::left, true});
  double left = kSide + kName;
  for (const FramePanel& panel : figure.panels) {
    left += numbers;
    const Mapping map{panel.view, left, top, scale};
    draw_panel(context, figure, panel, map);
    draw_axes(context, map, steps, kNames, &panel == &figure.panels.front() ? numbers + 5 : 0);
    write_within(context, left, top - 7, room(panel), title_of(panel), {12, Align::left, true});
    description += fmt::format(" {}.", title_of(panel));
    left += room(panel) + kGap;
  }
  if (legend > 0) draw_legend(context, figure, left, top, tall, scale);
  double y = top + tall + kBottomAxis + 14;
  for (const std::string& line : lines) {
    write_within(context, kSide, y, width - 2 * kSide, line, {10.5, Align::left, false, 0.35});
    description += " " + line;
    y += kMoreRemark;
  }
  return canvas.finish(description);
}

}  // namespace seapile::present
