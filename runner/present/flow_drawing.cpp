#include "runner/present/flow_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runner/present/colour_bar.h"
#include "runner/present/flow_marks.h"
#include "runner/present/frame_axes.h"
#include "runner/present/lettering.h"
#include "runner/present/table.h"

namespace seapile::present {
namespace {

// In units of the canvas.
constexpr double kWidest = 720, kTallest = 480;  ///< a panel
constexpr double kSide = 14, kHeading = 28, kPanelTitle = 22, kName = 18, kRemark = 17, kGap = 18;
constexpr double kLegend = 78, kLegendNames = 36, kShortestBar = 56, kTallestBar = 240;
constexpr double kLeastLegend = kLegendNames + kShortestBar + 14;
constexpr double kLeastWidth = 520;  ///< room for the heading and its key
constexpr double kLeastPanel = 165;  ///< room for a title
constexpr double kLong = 1.5;        ///< of a panel, its width over its height, from which on they stand in one column
constexpr double kSample = 22, kRemarkSize = 10.5;

/// What a figure of jets, of basins or of saturated beds says of its lengths and speeds.
struct Words {
  AxisNames axes;
  const char *length, *speed, *pressure, *scales, *speeds;
};
const Words kOfJets = {{"x [H]", "distance from the axis y [H]", "y [H]"},
                       "H",
                       "U",
                       "mu U/H",
                       "H: the die's radius or half gap; x is 0 at its lip.",
                       " U: the mean velocity in the die."};
const Words kOfBasins = {
    {"x [m]", "height above the bottom y [m]", "y [m]"}, "m", "m/s", "Pa", "x is 0 in the middle of the basin.", ""};
const Words kOfBeds = {
    {"x [m]", "height above the base y [m]", "y [m]"}, "m", "m/s", "Pa", "x is 0 in the middle of the box.", ""};

const Words& words_of(const FlowFigure& figure) {
  if (figure.beds) return kOfBeds;
  return figure.basins ? kOfBasins : kOfJets;
}

const char* heading(FlowFigureKind kind) {
  switch (kind) {
    case FlowFigureKind::mesh:
      return "Mesh of the fluid";
    case FlowFigureKind::velocity:
      return "Velocity of the fluid";
    case FlowFigureKind::pressure:
      return "Pressure of the fluid";
    case FlowFigureKind::porosity:
      return "Porosity";
  }
  return "";
}

/// What the colours stand for, its unit, and the factor to that unit.
struct Coloured {
  const char* name;
  std::string unit;
  double scale;
};
Coloured coloured(const FlowFigure& figure) {
  if (figure.kind == FlowFigureKind::velocity) return {"speed", words_of(figure).speed, 1};
  if (figure.kind == FlowFigureKind::porosity) return {"porosity", "-", 1};
  Coloured pressure{"pressure", words_of(figure).pressure, 1};
  pressure.scale = prefixed(pressure.unit, std::max(std::abs(figure.low), std::abs(figure.full)));
  return pressure;
}

/// What is said below the panels, line by line.
std::vector<std::string> remarks(const FlowFigure& figure) {
  const Words& words = words_of(figure);
  if (figure.kind == FlowFigureKind::mesh) {
    std::vector<std::string> sizes;
    for (const FlowPanel& panel : figure.panels) {
      sizes.push_back(fmt::format("{} vertices and {} triangles", panel.vertices, panel.triangles));
    }
    if (std::ranges::count(sizes, sizes.front()) == std::ssize(sizes)) sizes.resize(1);
    return {fmt::format("The whole mesh has {}. {}", fmt::join(sizes, "; "), words.scales)};
  }
  if (figure.kind == FlowFigureKind::porosity) {
    return {std::string("Colour: share of the plane that is outside grains, linear in each triangle. ") + words.scales};
  }
  if (figure.kind == FlowFigureKind::pressure) {
    return {std::string("Colour: pressure without the hydrostatic one, linear in each triangle. ") + words.scales};
  }
  return {fmt::format("Colour: speed, linear in each triangle. Arrows: velocity at their middles, {:g} {} apart.",
                      figure.spacing, words.length),
          std::string(words.scales) + words.speeds};
}

/// What the lines are, from the right end of the heading leftwards.
void draw_key(cairo_t* context, const FlowFigure& figure, double right, double y) {
  std::vector<std::pair<EdgeLook, std::string>> entries = {{EdgeLook::surface, "free surface"},
                                                           {EdgeLook::boundary, "other boundary"}};
  if (figure.kind == FlowFigureKind::mesh) entries.emplace_back(EdgeLook::inner, "edge");
  const Lettering look{10.5, Align::right};
  for (const auto& [line, name] : entries) {
    write(context, right, y, name, look);
    right -= text_width(context, name, look) + 6;
    draw_sample(context, {right - kSample, y - 3.7}, {right, y - 3.7}, line);
    right -= kSample + 16;
  }
}

void draw_panel(cairo_t* context, const FlowFigure& figure, const FlowPanel& panel, const Mapping& map) {
  cairo_save(context);
  cairo_rectangle(context, map.left, map.top, map.right() - map.left, map.bottom() - map.top);
  cairo_clip(context);
  draw_die(context, map, panel.die);
  if (!panel.pile.empty()) draw_pile(context, map, panel.pile);
  draw_values(context, map, panel.faces, figure.low, figure.full);
  draw_edges(context, map, panel.edges, EdgeLook::inner);
  draw_edges(context, map, panel.boundary, EdgeLook::boundary);
  draw_edges(context, map, panel.surface, EdgeLook::surface);
  draw_flow(context, map, panel.arrows);
  cairo_restore(context);
}

/// How many panels stand side by side: one of what is longer than high.
std::size_t columns_of(std::size_t panels, double width, double height) {
  if (width > kLong * height) return 1;
  return panels == 4 ? 2 : std::min<std::size_t>(panels, 3);
}

}  // namespace

std::string picture_of(const FlowFigure& figure, PictureFormat format) {
  double widest = 0, tallest = 0;
  for (const FlowPanel& panel : figure.panels) {
    widest = std::max(widest, panel.view.width());
    tallest = std::max(tallest, panel.view.height());
  }
  const double scale = std::min(kWidest / widest, kTallest / tallest);
  const Steps steps = axis_steps(widest, tallest, scale);
  double numbers = 0;
  for (const FlowPanel& panel : figure.panels) numbers = std::max(numbers, room_for_numbers(panel.view, steps.y));
  const bool has_legend = figure.full > figure.low;
  const Coloured colours = coloured(figure);
  const double left = kSide + kName + numbers, room = has_legend ? kGap + kLegend : 0;
  const std::size_t columns = columns_of(figure.panels.size(), widest, tallest);
  const double across = std::max(widest * scale, kLeastPanel) + kGap + numbers;  ///< from column to column
  const double width =
      std::max(left + across * static_cast<double>(columns) - kGap - numbers + room + kSide, kLeastWidth);
  const std::vector<std::string> lines = remarks(figure);
  const double each = kPanelTitle + std::max(tallest * scale + kBottomAxis, has_legend ? kLeastLegend : 0);
  const double height = kSide + kHeading +
                        each * std::ceil(static_cast<double>(figure.panels.size()) / static_cast<double>(columns)) +
                        kRemark * static_cast<double>(lines.size()) + kSide;

  Canvas canvas(format, width, height);
  cairo_t* context = canvas.context();
  std::string description = fmt::format("{}.", heading(figure.kind));
  write(context, kSide, kSide + 14, heading(figure.kind), {15, Align::left, true});
  draw_key(context, figure, width - kSide, kSide + 14);
  double top = kSide + kHeading + kPanelTitle;
  for (std::size_t k = 0; k < figure.panels.size(); ++k) {
    const FlowPanel& panel = figure.panels[k];
    const std::size_t column = k % columns;
    const bool first = column == 0, last = column + 1 == columns;
    if (k > 0 && first) top += each;
    const Mapping map{panel.view, left + static_cast<double>(column) * across, top, scale};
    draw_panel(context, figure, panel, map);
    draw_axes(context, map, steps, words_of(figure).axes, first ? numbers + 5 : 0);
    write_within(context, map.left, top - 7, last ? width - kSide - map.left : across - kGap, panel.title,
                 {12, Align::left, true});
    description += fmt::format(" {}.", panel.title);
    // One for all of them; in a single column beside each, for they reach far down.
    if (has_legend && last && (columns == 1 || k < columns)) {
      const double x = map.right() + kGap;
      write(context, x, top + 9, colours.name, {11});
      write(context, x, top + 23, fmt::format("[{}]", colours.unit), {11});
      draw_bar(context, x, top + kLegendNames, std::clamp(tallest * scale - kLegendNames, kShortestBar, kTallestBar),
               figure.low * colours.scale, figure.full * colours.scale, false);
    }
  }
  double y = top + each - kPanelTitle + 14;
  for (const std::string& line : lines) {
    write_within(context, kSide, y, width - 2 * kSide, line, {kRemarkSize, Align::left, false, 0.35});
    description += " " + line;
    y += kRemark;
  }
  return canvas.finish(description);
}

}  // namespace seapile::present
