// What stands for grains, forces, stresses, velocities, pile and walls on a canvas.
#pragma once

#include <cairo.h>

#include <vector>

#include "runner/present/colour_map.h"
#include "runner/present/frame_figure.h"

namespace seapile::present {

/// From metres to the canvas, whose y points down.
struct Mapping {
  View view;
  double left = 0, top = 0;  ///< of the view's corner on the canvas
  double scale = 1;          ///< units per metre
  double right() const { return left + view.width() * scale; }
  double bottom() const { return top + view.height() * scale; }
  base::Vec2 operator()(base::Vec2 p) const {
    return {left + (p.x - view.left) * scale, top + (view.top - p.y) * scale};
  }
};

enum class GrainLook {
  filled,    ///< one tone
  layered,   ///< filled, two tones in turn from layer to layer
  outlined,  ///< faint circles
  shaded,    ///< faint discs
};

void draw_grains(cairo_t* context, const Mapping& map, const std::vector<DrawnGrain>& grains, GrainLook look);

/// Lines with round ends, each as wide as it says to within kWidthStep / 2; what would be thinner than that is left
/// out.
void draw_forces(cairo_t* context, const Mapping& map, const std::vector<DrawnForce>& lines);
inline constexpr double kWidthStep = 0.04;

/// Ellipses, coloured by the major stress as a share of `full` [Pa].
void draw_stresses(cairo_t* context, const Mapping& map, const std::vector<DrawnStress>& stresses, double full);

/// Arrows, coloured by the ratio.
void draw_velocities(cairo_t* context, const Mapping& map, const std::vector<DrawnVelocity>& arrows);

/// The pile, filled, closed above the view.
void draw_pile(cairo_t* context, const Mapping& map, const std::vector<base::Vec2>& outline);

/// Walls and base, hatched outside.
void draw_box(cairo_t* context, const Mapping& map, const View& box);

/// The initial bed surface, dashed.
void draw_surface(cairo_t* context, const Mapping& map, const View& box, double surface);

/// The fluid as a plane from the base to its free surface, pale; and the free surface itself.
void draw_water(cairo_t* context, const Mapping& map, const View& box, const std::vector<DrawnEdge>& surface);
void draw_water_surface(cairo_t* context, const Mapping& map, const std::vector<DrawnEdge>& surface);

void set_colour(cairo_t* context, const Colour& colour);
/// An arrow from one point of the canvas to another, with a head when it is long enough for one; added to the path.
void add_arrow(cairo_t* context, base::Vec2 from, base::Vec2 to);

}  // namespace seapile::present
