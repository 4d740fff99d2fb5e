// What widths, lengths and colours of a figure mean.
#pragma once

#include <cairo.h>

#include <string>
#include <vector>

#include "runner/present/frame_figure.h"

namespace seapile::present {

/// Width that the legend needs on the canvas; 0: there is none.
double legend_width(FigureKind kind);

/// Draws it downwards from (x, y), not higher than `height`; `scale` is the panels' units per metre.
void draw_legend(cairo_t* context, const FrameFigure& figure, double x, double y, double height, double scale);

/// At least one line about what is seen.
std::vector<std::string> remarks(const FrameFigure& figure);

}  // namespace seapile::present
