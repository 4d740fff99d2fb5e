// What the colours of a figure mean.
#pragma once

#include <cairo.h>

namespace seapile::present {

/// Colours from `low` at the bottom to `full` at the top, with ticks; returns its lower end on the canvas.
/// `more_above`: the last colour stands for all that is larger, too.
double draw_bar(cairo_t* context, double x, double y, double height, double low, double full, bool more_above);

}  // namespace seapile::present
