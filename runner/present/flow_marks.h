// What stands for edges, speeds and velocities of the water on a canvas.
#pragma once

#include <cairo.h>

#include <vector>

#include "runner/present/flow_figure.h"
#include "runner/present/frame_marks.h"

namespace seapile::present {

/// Thin: between triangles; dark: the boundary; the free surface in a colour that the colour map lacks.
enum class EdgeLook { inner, boundary, surface };

void draw_edges(cairo_t* context, const Mapping& map, const std::vector<DrawnEdge>& edges, EdgeLook look);

/// A line from one point of the canvas to another as draw_edges() draws it, for the legend.
void draw_sample(cairo_t* context, base::Vec2 from, base::Vec2 to, EdgeLook look);

/// Triangles coloured by where their values lie between `low` and `full`, linear between the corners, in kBands bands.
void draw_values(cairo_t* context, const Mapping& map, const std::vector<DrawnTriangle>& faces, double low,
                 double full);
inline constexpr int kBands = 50;

/// Dark arrows with a pale edge, to be seen on any colour.
void draw_flow(cairo_t* context, const Mapping& map, const std::vector<DrawnVelocity>& arrows);

/// The solid wall of the die.
void draw_die(cairo_t* context, const Mapping& map, const View& die);

}  // namespace seapile::present
