// The axes around a panel of a figure.
#pragma once

#include <cairo.h>

#include <string>

#include "runner/present/frame_marks.h"

namespace seapile::present {

/// With their units. `y_short` stands where the panel is too low for the whole name.
struct AxisNames {
  std::string x, y, y_short;
};

/// Between two ticks, as long as the axes are.
struct Steps {
  double x = 0, y = 0;
};
/// `scale`: units of the canvas per length.
Steps axis_steps(double width, double height, double scale);

/// What the numbers beside a panel's left edge need.
double room_for_numbers(const View& view, double step);

inline constexpr double kBottomAxis = 38;  ///< height of the numbers and the name below a panel

/// The panel's edge, ticks, numbers and names. `name_at`: how far left of the panel the y axis is named; 0: nowhere.
void draw_axes(cairo_t* context, const Mapping& map, const Steps& steps, const AxisNames& names, double name_at);

}  // namespace seapile::present
