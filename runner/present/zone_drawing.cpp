#include "runner/present/zone_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runner/present/axis.h"
#include "runner/present/frame_marks.h"
#include "runner/present/gnuplot.h"
#include "runner/present/lettering.h"
#include "runner/present/table.h"

namespace seapile::present {
namespace {

// In units of the canvas.
constexpr double kPlotWidth = 520, kPlotHeight = 150, kSide = 14, kHeading = 28, kKeyLine = 17, kTitle = 26;
constexpr double kLeft = 58, kBelow = 42, kRemark = 17, kTick = 4, kSample = 30, kLine = 1.6;
constexpr double kRoomAround = 0.06;  ///< above and below the curves, share of the axis

struct Axis {
  double low = 0, high = 1, step = 0.5;
  double factor = 1;  ///< from the values to what the axis shows
  std::string name;   ///< with its unit
  double share(double value) const { return (value * factor - low) / (high - low); }
};

Axis axis_of(const ZoneFigure& figure, std::size_t quantity) {
  constexpr std::array<const char*, kZoneQuantities> kNames = {"porosity", "vertical stress", "major principal stress"};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const ZonePanel& run : figure.runs) {
    for (const auto* list : {&run.curves[quantity].before, &run.curves[quantity].after}) {
      low = std::min(low, *std::ranges::min_element(*list));
      high = std::max(high, *std::ranges::max_element(*list));
    }
  }
  Axis axis;
  std::string unit = "-";
  if (quantity != 0) {
    unit = "Pa";
    low = std::min(low, 0.0);
    axis.factor = prefixed(unit, std::max(std::abs(low), std::abs(high)));
  }
  const double room = std::max(kRoomAround * (high - low), 1e-6 * std::max(std::abs(high), 1.0));
  axis.low = (low == 0 ? 0 : low - room) * axis.factor;
  axis.high = (high + room) * axis.factor;
  axis.step = nice_step(axis.high - axis.low, 5);
  axis.name = fmt::format("{} [{}]", kNames[quantity], unit);
  return axis;
}

Colour colour_of_run(std::size_t run) {
  const unsigned long rgb = std::stoul(std::string(style_of(run).colour), nullptr, 16);
  const auto part = [&](int shift) { return static_cast<double>(rgb >> shift & 255) / 255; };
  return {part(16), part(8), part(0)};
}

void stroke_dashed(cairo_t* context, double on, double off) {
  const double dashes[] = {on, off};
  cairo_set_dash(context, dashes, 2, 0);
  cairo_stroke(context);
  cairo_set_dash(context, nullptr, 0, 0);
}

/// Where a panel is on the canvas, and the distances that it shows.
struct Place {
  double left, top, from, to;
  double x(double distance) const { return left + (distance - from) / (to - from) * kPlotWidth; }
  double y(double share) const { return top + (1 - share) * kPlotHeight; }
};

void draw_curve(cairo_t* context, const Place& place, const Axis& axis, const std::vector<double>& distance,
                const std::vector<double>& values, bool dashed) {
  for (std::size_t k = 0; k < distance.size(); ++k)
    cairo_line_to(context, place.x(distance[k]), place.y(axis.share(values[k])));
  cairo_set_line_width(context, kLine);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  dashed ? stroke_dashed(context, 4, 3) : cairo_stroke(context);
}

/// The half of the pile as a grey strip, the widest of the runs.
void draw_half_pile(cairo_t* context, const ZoneFigure& figure, const Place& place) {
  double radius = 0;
  for (const ZonePanel& run : figure.runs) radius = std::max(radius, run.pile_radius);
  const double right = place.x(std::clamp(radius, place.from, place.to));
  cairo_rectangle(context, place.left, place.top, right - place.left, kPlotHeight);
  set_colour(context, {0.93, 0.94, 0.96});
  cairo_fill(context);
}

void draw_frame(cairo_t* context, const Place& place, const Axis& axis, bool last) {
  cairo_set_source_rgb(context, 0.2, 0.2, 0.2);
  cairo_set_line_width(context, 0.8);
  cairo_rectangle(context, place.left, place.top, kPlotWidth, kPlotHeight);
  cairo_stroke(context);
  for (const Tick& tick : ticks(place.from, place.to, nice_step(place.to - place.from, 8))) {
    const double x = place.x(tick.value);
    cairo_move_to(context, x, place.y(0));
    cairo_line_to(context, x, place.y(0) + kTick);
    cairo_stroke(context);
    if (last) write(context, x, place.y(0) + 15, tick.text, {10.5, Align::middle});
  }
  for (const Tick& tick : ticks(axis.low, axis.high, axis.step)) {
    const double y = place.top + (1 - (tick.value - axis.low) / (axis.high - axis.low)) * kPlotHeight;
    cairo_move_to(context, place.left - kTick, y);
    cairo_line_to(context, place.left, y);
    cairo_stroke(context);
    write(context, place.left - kTick - 3, y + 3.7, tick.text, {10.5, Align::right});
  }
  write(context, place.left, place.top - 7, axis.name, {12, Align::left, true});
  if (last)
    write(context, place.left + kPlotWidth / 2, place.y(0) + 31, "distance from the pile's axis [m]",
          {11, Align::middle});
}

std::string reach_text(const ZonePanel& run, std::size_t quantity) {
  const ZoneCurve& curve = run.curves[quantity];
  if (curve.reach) return fmt::format("{:.2f} m", *curve.reach);
  return curve.before == curve.after ? "no change" : fmt::format("> {:.2f} m", run.distance.back());
}

/// Dotted lines where changes have faded, and from the panel's right end leftwards, in the runs' colours, how far.
void draw_reaches(cairo_t* context, const ZoneFigure& figure, std::size_t quantity, const Place& place) {
  double right = place.left + kPlotWidth;
  for (std::size_t k = figure.runs.size(); k-- > 0;) {
    const ZoneCurve& curve = figure.runs[k].curves[quantity];
    const std::string text = reach_text(figure.runs[k], quantity);
    const Lettering look{10.5};
    right -= text_width(context, text, look);
    write(context, right, place.top - 7, text, look);
    set_colour(context, colour_of_run(k));
    cairo_rectangle(context, right - 12, place.top - 14.5, 8, 8);
    cairo_fill(context);
    right -= 26;
    if (!curve.reach) continue;
    cairo_move_to(context, place.x(*curve.reach), place.y(0));
    cairo_line_to(context, place.x(*curve.reach), place.y(1));
    set_colour(context, colour_of_run(k));
    cairo_set_line_width(context, 1);
    stroke_dashed(context, 1, 2.5);
  }
  write(context, right + 10, place.top - 7, "change fades at", {10.5, Align::right});
}

/// Titles of the runs with their lines, one below the other; returns where they end.
double draw_key(cairo_t* context, const ZoneFigure& figure, double left, double top) {
  for (std::size_t k = 0; k < figure.runs.size(); ++k) {
    const double y = top + 11;
    set_colour(context, colour_of_run(k));
    cairo_set_line_width(context, kLine);
    cairo_move_to(context, left, y - 3.7);
    cairo_line_to(context, left + kSample, y - 3.7);
    cairo_stroke(context);
    write_within(context, left + kSample + 8, y, kPlotWidth - kSample - 8,
                 fmt::format("{}, d = {:.3f} m", figure.runs[k].title, figure.runs[k].depth), {11});
    top += kKeyLine;
  }
  cairo_set_source_rgb(context, 0.35, 0.35, 0.35);
  cairo_move_to(context, left, top + 11 - 3.7);
  cairo_line_to(context, left + kSample, top + 11 - 3.7);
  cairo_set_line_width(context, kLine);
  stroke_dashed(context, 4, 3);
  write(context, left + kSample + 8, top + 11, "before, d = 0; in the run's colour", {11});
  return top + kKeyLine;
}

std::vector<std::string> remarks(const ZoneFigure& figure) {
  std::vector<std::string> bands;
  for (const ZonePanel& run : figure.runs)
    bands.push_back(fmt::format("{:.3g} to {:.3g} m", run.band.bottom, run.band.top));
  if (std::ranges::count(bands, bands.front()) == std::ssize(bands)) bands.resize(1);
  return {
      fmt::format("Means left and right over the whole cells between heights of {} above the base, beside the pile.",
                  fmt::join(bands, "; ")),
      "Dotted: where the change fades: from there on it stays below 5 % of its largest. Grey: half the pile."};
}

}  // namespace

std::string picture_of(const ZoneFigure& figure, PictureFormat format) {
  const char* heading = "Zone of influence";
  const std::vector<std::string> lines = remarks(figure);
  const double width = 2 * kSide + kLeft + kPlotWidth;
  const double key = kKeyLine * static_cast<double>(figure.runs.size() + 1);
  const double height = 2 * kSide + kHeading + key + kZoneQuantities * (kTitle + kPlotHeight) + kBelow +
                        kRemark * static_cast<double>(lines.size());
  double from = figure.runs.front().band.left, to = figure.runs.front().band.right;
  for (const ZonePanel& run : figure.runs) {
    from = std::min(from, run.band.left);
    to = std::max(to, run.band.right);
  }

  Canvas canvas(format, width, height);
  cairo_t* context = canvas.context();
  write(context, kSide, kSide + 14, heading, {15, Align::left, true});
  double top = draw_key(context, figure, kSide + kLeft, kSide + kHeading);
  std::string description = fmt::format("{}.", heading);
  for (const ZonePanel& run : figure.runs) description += fmt::format(" {}, d = {:.3f} m.", run.title, run.depth);
  for (std::size_t q = 0; q < kZoneQuantities; ++q) {
    const Axis axis = axis_of(figure, q);
    const Place place{kSide + kLeft, top + kTitle, from, to};
    draw_half_pile(context, figure, place);
    for (const bool dashed : {true, false}) {
      for (std::size_t k = 0; k < figure.runs.size(); ++k) {
        const ZonePanel& run = figure.runs[k];
        set_colour(context, colour_of_run(k));
        draw_curve(context, place, axis, run.distance, dashed ? run.curves[q].before : run.curves[q].after, dashed);
      }
    }
    draw_reaches(context, figure, q, place);
    draw_frame(context, place, axis, q + 1 == kZoneQuantities);
    std::vector<std::string> reaches;
    for (const ZonePanel& run : figure.runs) reaches.push_back(reach_text(run, q));
    description += fmt::format(" {}: the change fades at {}.", axis.name, fmt::join(reaches, "; "));
    top += kTitle + kPlotHeight;
  }
  double y = top + kBelow + 8;
  for (const std::string& line : lines) {
    write_within(context, kSide, y, width - 2 * kSide, line, {10.5, Align::left, false, 0.35});
    description += " " + line;
    y += kRemark;
  }
  return canvas.finish(description);
}

}  // namespace seapile::present
