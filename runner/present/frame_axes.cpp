#include "runner/present/frame_axes.h"

#include <algorithm>

#include "runner/present/axis.h"
#include "runner/present/lettering.h"

namespace seapile::present {
namespace {

// In units of the canvas.
constexpr double kTick = 4, kTickEvery = 45, kDigit = 6.8;

}  // namespace

Steps axis_steps(double width, double height, double scale) {
  const auto step = [&](double length, int least) {
    return nice_step(length, std::max(least, static_cast<int>(length * scale / kTickEvery)));
  };
  return {step(width, 1), step(height, 3)};
}

double room_for_numbers(const View& view, double step) {
  std::size_t longest = 0;
  for (const Tick& tick : ticks(view.bottom, view.top, step)) longest = std::max(longest, tick.text.size());
  return static_cast<double>(longest) * kDigit + kTick + 3;
}

void draw_axes(cairo_t* context, const Mapping& map, const Steps& steps, const AxisNames& names, double name_at) {
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
  const Lettering look{11, Align::middle};
  write(context, (map.left + map.right()) / 2, map.bottom() + 31, names.x, look);
  if (name_at == 0) return;
  const bool fits = text_width(context, names.y, look) < map.bottom() - map.top;
  write(context, map.left - name_at, (map.top + map.bottom()) / 2, fits ? names.y : names.y_short, look, true);
}

}  // namespace seapile::present
