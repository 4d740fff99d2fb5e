#include "runner/present/colour_bar.h"

#include <algorithm>

#include "runner/present/axis.h"
#include "runner/present/colour_map.h"
#include "runner/present/lettering.h"

namespace seapile::present {
namespace {

constexpr double kBarWidth = 14;
constexpr int kBarStops = 30;  ///< between which colours are straight

}  // namespace

double draw_bar(cairo_t* context, double x, double y, double height, double low, double full, bool more_above) {
  cairo_pattern_t* colours = cairo_pattern_create_linear(0, y + height, 0, y);
  for (int k = 0; k <= kBarStops; ++k) {
    const double share = static_cast<double>(k) / kBarStops;
    const Colour colour = colour_of(share);
    cairo_pattern_add_color_stop_rgb(colours, share, colour.red, colour.green, colour.blue);
  }
  cairo_set_source(context, colours);
  cairo_pattern_destroy(colours);
  cairo_rectangle(context, x, y, kBarWidth, height);
  cairo_fill(context);
  cairo_set_source_rgb(context, 0.3, 0.3, 0.3);
  cairo_set_line_width(context, 0.7);
  cairo_rectangle(context, x, y, kBarWidth, height);
  cairo_stroke(context);
  const auto marks = ticks(low, full, nice_step(full - low, std::max(2, static_cast<int>(height / 30))));
  for (const Tick& tick : marks) {
    const double at = y + height * (1 - (tick.value - low) / (full - low));
    cairo_move_to(context, x + kBarWidth, at);
    cairo_line_to(context, x + kBarWidth + 4, at);
    cairo_set_source_rgb(context, 0.3, 0.3, 0.3);
    cairo_stroke(context);
    const bool last = more_above && &tick == &marks.back();
    write(context, x + kBarWidth + 7, at + 3.7, (last ? "≥ " : "") + tick.text, {10.5});
  }
  return y + height;
}

}  // namespace seapile::present
