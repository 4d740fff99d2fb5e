#include "runner/present/quality_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runner/present/axis.h"
#include "runner/present/flow_marks.h"
#include "runner/present/frame_axes.h"
#include "runner/present/frame_marks.h"
#include "runner/present/lettering.h"

namespace seapile::present {
namespace {

// In units of the canvas.
constexpr double kPlotWidth = 300, kPlotHeight = 150, kTallestMesh = 320, kSide = 14, kHeading = 26, kTitle = 22,
                 kRemark = 17;
constexpr double kLeft = 50, kColumnGap = 46, kBelow = 50, kTick = 4, kKey = 9;
constexpr double kLeastWidth = 560;  ///< room for what is said below
constexpr Colour kGood = {0.23, 0.44, 0.64}, kBad = {0.84, 0.20, 0.05};

/// One histogram, as it is drawn.
struct Plot {
  const std::vector<double>& shares;
  double top;                     ///< of the axis
  double limit;                   ///< below it a triangle is bad
  double step;                    ///< between two numbers of the axis
  std::string name, bad, lowest;  ///< of the axis; how many are bad; the worst
};

/// A round number in percent that holds every bin.
double top_of(double full) {
  const double percent = std::max(100 * full, 1.0), step = nice_step(percent, 5);
  return std::ceil(percent / step) * step;
}

void draw_bars(cairo_t* context, const Plot& plot, double left, double bottom, double highest) {
  const double width = kPlotWidth / static_cast<double>(plot.shares.size());
  for (std::size_t k = 0; k < plot.shares.size(); ++k) {
    const double height = 100 * plot.shares[k] / highest * kPlotHeight;
    if (height == 0) continue;
    const double middle = (static_cast<double>(k) + 0.5) / static_cast<double>(plot.shares.size()) * plot.top;
    cairo_rectangle(context, left + static_cast<double>(k) * width + 0.6, bottom - height, width - 1.2, height);
    set_colour(context, middle < plot.limit ? kBad : kGood);
    cairo_fill(context);
  }
}

/// The frame, its numbers, and the names of the axes; the shares are named left of the first column.
void draw_frame(cairo_t* context, const Plot& plot, double left, double bottom, double highest, bool first) {
  cairo_set_source_rgb(context, 0.2, 0.2, 0.2);
  cairo_set_line_width(context, 0.8);
  cairo_rectangle(context, left, bottom - kPlotHeight, kPlotWidth, kPlotHeight);
  cairo_stroke(context);
  for (const Tick& tick : ticks(0, plot.top, plot.step)) {
    const double x = left + tick.value / plot.top * kPlotWidth;
    cairo_move_to(context, x, bottom);
    cairo_line_to(context, x, bottom + kTick);
    cairo_stroke(context);
    write(context, x, bottom + 15, tick.text, {10.5, Align::middle});
  }
  for (const Tick& tick : ticks(0, highest, nice_step(highest, 5))) {
    const double y = bottom - tick.value / highest * kPlotHeight;
    cairo_move_to(context, left - kTick, y);
    cairo_line_to(context, left, y);
    cairo_stroke(context);
    if (first) write(context, left - kTick - 3, y + 3.7, tick.text, {10.5, Align::right});
  }
  write(context, left + kPlotWidth / 2, bottom + 31, plot.name, {11, Align::middle});
  if (first) {
    write(context, left - kLeft + 10, bottom - kPlotHeight / 2, "share of the triangles [%]", {11, Align::middle},
          true);
  }
}

/// The mesh in its view, what is bad filled.
void draw_mesh(cairo_t* context, const QualityPanel& panel, double left, double top, double scale, bool first) {
  const Mapping map{panel.mesh.view, left, top, scale};
  cairo_save(context);
  cairo_rectangle(context, map.left, map.top, map.right() - map.left, map.bottom() - map.top);
  cairo_clip(context);
  draw_die(context, map, panel.mesh.die);
  if (!panel.mesh.pile.empty()) draw_pile(context, map, panel.mesh.pile);
  for (const auto& corners : panel.bad) {
    for (const base::Vec2 corner : corners) {
      const base::Vec2 p = map(corner);
      cairo_line_to(context, p.x, p.y);
    }
    cairo_close_path(context);
  }
  set_colour(context, kBad);
  cairo_fill(context);
  draw_edges(context, map, panel.mesh.edges, EdgeLook::inner);
  draw_edges(context, map, panel.mesh.boundary, EdgeLook::boundary);
  draw_edges(context, map, panel.mesh.surface, EdgeLook::boundary);
  cairo_restore(context);
  const Steps steps = axis_steps(panel.mesh.view.width(), panel.mesh.view.height(), scale);
  const AxisNames names = panel.in_metres ? AxisNames{"x [m]", "y [m]", "y [m]"} : AxisNames{"x [H]", "y [H]", "y [H]"};
  draw_axes(context, map, steps, names, first ? kLeft - 10 : 0);
}

double mesh_scale(const View& view) { return std::min(kPlotWidth / view.width(), kTallestMesh / view.height()); }

/// How many are bad, beside their colour, and the worst. Regular triangles have q = 1 and 60 degrees, so that bars are
/// high on the right.
void draw_legend(cairo_t* context, const Plot& plot, double left, double bottom) {
  const double x = left + 8, y = bottom - kPlotHeight + 18;
  cairo_rectangle(context, x, y - kKey, kKey, kKey);
  set_colour(context, kBad);
  cairo_fill(context);
  write(context, x + kKey + 5, y, plot.bad, {10.5});
  write(context, x + kKey + 5, y + 15, plot.lowest, {10.5});
}

}  // namespace

std::string picture_of(const QualityFigure& figure, PictureFormat format) {
  const std::string heading = "Quality of the triangles";
  const double columns = static_cast<double>(figure.panels.size());
  const double width = std::max(2 * kSide + kLeft + columns * kPlotWidth + (columns - 1) * kColumnGap, kLeastWidth);
  double tallest = 0;
  for (const QualityPanel& panel : figure.panels)
    tallest = std::max(tallest, panel.mesh.view.height() * mesh_scale(panel.mesh.view));
  const double meshes = tallest + kBottomAxis + 14;
  const double height = kSide + kHeading + kTitle + meshes + 2 * (kPlotHeight + kBelow) + kRemark + kSide;
  const double highest = top_of(figure.full);

  Canvas canvas(format, width, height);
  cairo_t* context = canvas.context();
  write(context, kSide, kSide + 14, heading, {15, Align::left, true});
  std::string description = heading + ".";
  double left = kSide + kLeft;
  for (const QualityPanel& panel : figure.panels) {
    const bool first = &panel == &figure.panels.front();
    const double top = kSide + kHeading + kTitle;
    write_within(context, left, top - 7, kPlotWidth, panel.title, {12, Align::left, true});
    draw_mesh(context, panel, left, top, mesh_scale(panel.mesh.view), first);
    double bottom = top + meshes + kPlotHeight;
    const double degrees = 180 / std::numbers::pi;
    description += fmt::format(" {}: {} triangles.", panel.title, panel.triangles);
    for (const Plot& plot :
         {Plot{panel.shape, 1, kBadShape, 0.2, "shape q", fmt::format("q < 0.5: {:.3g} %", 100 * panel.below_half),
               fmt::format("lowest {:.3f}", panel.lowest_shape)},
          Plot{panel.angle, 60, 30, 10, "smallest angle [degrees]",
               fmt::format("below 30°: {:.3g} %", 100 * panel.small_angles),
               fmt::format("smallest {:.1f}°", panel.smallest_angle * degrees)}}) {
      draw_bars(context, plot, left, bottom, highest);
      draw_frame(context, plot, left, bottom, highest, first);
      draw_legend(context, plot, left, bottom);
      description += fmt::format(" {}, {}.", plot.bad, plot.lowest);
      bottom += kPlotHeight + kBelow;
    }
    left += kPlotWidth + kColumnGap;
  }
  const std::string remark =
      "q: 4√3 times the area over the sum of the squared edges, 1 for equal edges. Red: q < 0.5. Histograms of whole "
      "meshes.";
  write_within(context, kSide, height - kSide - 4, width - 2 * kSide, remark, {10.5, Align::left, false, 0.35});
  return canvas.finish(description + " " + remark);
}

}  // namespace seapile::present
