#include "runner/present/frame_marks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace seapile::present {
namespace {

using base::Vec2;

constexpr double kGrid = 8;    ///< places per unit: shorter numbers in SVG files, too fine to be seen
constexpr double kSizes = 16;  ///< diameters of dots per unit
constexpr double kLayerTones[] = {0.76, 0.42}, kFilledTone = 0.62;
constexpr Colour kForce = {0.13, 0.13, 0.40}, kPileFill = {0.80, 0.84, 0.90}, kPileEdge = {0.16, 0.22, 0.32},
                 kWater = {0.85, 0.93, 0.99}, kWaterSurface = {0.0, 0.45, 0.70};
constexpr int kShades = 64;    ///< of the colour map; more are not told apart
constexpr double kHead = 3.2;  ///< of an arrow
constexpr double kSmallestMark = 0.25;

double rounded(double value) { return std::round(value * kGrid) / kGrid; }

/// Discs as dots of a round pen: a few bytes each, where a circle of four curves takes hundreds. Discs of one look and
/// diameter, to a sixteenth of a unit, are one path.
class Dots {
 public:
  void add(Vec2 centre, double diameter) {
    const long size = std::lround(diameter * kSizes);
    if (size > 0) by_size_[size].push_back({rounded(centre.x), rounded(centre.y)});
  }
  void draw(cairo_t* context, double grey) const {
    cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
    cairo_set_source_rgb(context, grey, grey, grey);
    for (const auto& [size, centres] : by_size_) {
      for (const Vec2 centre : centres) {
        cairo_move_to(context, centre.x, centre.y);
        cairo_line_to(context, centre.x, centre.y);
      }
      cairo_set_line_width(context, static_cast<double>(size) / kSizes);
      cairo_stroke(context);
    }
  }

 private:
  std::map<long, std::vector<Vec2>> by_size_;
};

Colour shade(int index) { return colour_of((index + 0.5) / kShades); }
int shade_of(double share) { return static_cast<int>(std::clamp(share, 0.0, 1.0 - 1e-9) * kShades); }

void hatch(cairo_t* context, double left, double top, double width, double height) {
  if (width <= 0 || height <= 0) return;
  cairo_save(context);
  cairo_rectangle(context, left, top, width, height);
  cairo_clip(context);
  cairo_set_source_rgb(context, 0.55, 0.55, 0.55);
  cairo_set_line_width(context, 0.6);
  // Anchored at the canvas' corner, so that neighbouring pieces fit together.
  const double first = std::floor((left + top) / 5) * 5, last = left + top + width + height;
  for (double sum = first; sum <= last; sum += 5) {
    cairo_move_to(context, sum - top, top);
    cairo_line_to(context, sum - top - height, top + height);
  }
  cairo_stroke(context);
  cairo_restore(context);
}

}  // namespace

void set_colour(cairo_t* context, const Colour& colour) {
  // In hundredths, which are finer than the eye: SVG files write every digit.
  const auto hundredths = [](double value) { return std::round(100 * value) / 100; };
  cairo_set_source_rgb(context, hundredths(colour.red), hundredths(colour.green), hundredths(colour.blue));
}

void draw_grains(cairo_t* context, const Mapping& map, const std::vector<DrawnGrain>& grains, GrainLook look) {
  Dots dots, others;
  for (const DrawnGrain& grain : grains) {
    const double diameter = 2 * grain.radius * map.scale;
    if (look == GrainLook::outlined) {
      // A ring is a white dot on a grey one; grains meet at points, so no ring is lost.
      dots.add(map(grain.centre), diameter);
      others.add(map(grain.centre), diameter - 1.0);
    } else {
      const bool second = look == GrainLook::layered && grain.layer % 2 != 0;
      (second ? others : dots).add(map(grain.centre), diameter * (look == GrainLook::shaded ? 0.96 : 1.0));
    }
  }
  const bool layered = look == GrainLook::layered, outlined = look == GrainLook::outlined;
  dots.draw(context, layered ? kLayerTones[0] : look == GrainLook::filled ? kFilledTone : outlined ? 0.80 : 0.92);
  others.draw(context, layered ? kLayerTones[1] : 1.0);
}

void draw_forces(cairo_t* context, const Mapping& map, const std::vector<DrawnForce>& lines) {
  std::map<long, std::vector<std::pair<Vec2, Vec2>>> by_width;
  for (const DrawnForce& line : lines) {
    const long steps = std::lround(line.width * map.scale / kWidthStep);
    if (steps > 0) by_width[steps].emplace_back(map(line.from), map(line.to));
  }
  set_colour(context, kForce);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  for (const auto& [steps, ends] : by_width) {
    for (const auto& [from, to] : ends) {
      cairo_move_to(context, rounded(from.x), rounded(from.y));
      cairo_line_to(context, rounded(to.x), rounded(to.y));
    }
    cairo_set_line_width(context, static_cast<double>(steps) * kWidthStep);
    cairo_stroke(context);
  }
}

void draw_stresses(cairo_t* context, const Mapping& map, const std::vector<DrawnStress>& stresses, double full) {
  for (const DrawnStress& stress : stresses) {
    const Vec2 centre = map(stress.centre);
    cairo_save(context);
    cairo_translate(context, centre.x, centre.y);
    cairo_rotate(context, -stress.direction);  // The canvas' y points down.
    cairo_scale(context, std::max(stress.semi_major * map.scale, kSmallestMark),
                std::max(stress.semi_minor * map.scale, kSmallestMark));
    cairo_new_sub_path(context);
    cairo_arc(context, 0, 0, 1, 0, 2 * std::numbers::pi);
    cairo_close_path(context);
    cairo_restore(context);
    set_colour(context, shade(shade_of(stress.major / full)));
    cairo_fill_preserve(context);
    cairo_set_source_rgb(context, 0.25, 0.25, 0.25);
    cairo_set_line_width(context, 0.35);
    cairo_stroke(context);
  }
}

void add_arrow(cairo_t* context, Vec2 from, Vec2 to) {
  const Vec2 way = to - from;
  const double length = norm(way);
  if (length < kSmallestMark) return;
  cairo_move_to(context, from.x, from.y);
  cairo_line_to(context, to.x, to.y);
  const double head = std::min(kHead, 0.45 * length);
  if (head < 0.8) return;
  const Vec2 along = (head / length) * way, across = 0.5 * perpendicular(along);
  for (const Vec2 corner : {to - along + across, to - along - across}) {
    cairo_move_to(context, corner.x, corner.y);
    cairo_line_to(context, to.x, to.y);
  }
}

void draw_velocities(cairo_t* context, const Mapping& map, const std::vector<DrawnVelocity>& arrows) {
  std::map<int, std::vector<const DrawnVelocity*>> by_shade;
  for (const DrawnVelocity& arrow : arrows) by_shade[shade_of(arrow.ratio)].push_back(&arrow);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_width(context, 1.0);
  for (const auto& [index, list] : by_shade) {  // Slow ones first, so that the fast ones lie on top.
    set_colour(context, shade(index));
    for (const DrawnVelocity* arrow : list) add_arrow(context, map(arrow->tail), map(arrow->head));
    cairo_stroke(context);
  }
}

void draw_pile(cairo_t* context, const Mapping& map, const std::vector<Vec2>& outline) {
  for (const Vec2 point : outline) {
    const Vec2 p = map(point);
    cairo_line_to(context, p.x, p.y);
  }
  set_colour(context, kPileFill);
  cairo_fill_preserve(context);
  set_colour(context, kPileEdge);
  cairo_set_line_width(context, 1.4);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_stroke(context);
}

void draw_box(cairo_t* context, const Mapping& map, const View& box) {
  const Vec2 low = map({box.left, box.bottom}), high = map({box.right, box.top});
  const double floor = std::min(low.y, map.bottom()), top = std::max(high.y, map.top);
  hatch(context, map.left, top, low.x - map.left, floor - top);
  hatch(context, high.x, top, map.right() - high.x, floor - top);
  hatch(context, map.left, low.y, map.right() - map.left, map.bottom() - low.y);
  cairo_set_source_rgb(context, 0.2, 0.2, 0.2);
  cairo_set_line_width(context, 1.2);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_MITER);
  cairo_move_to(context, low.x, high.y);
  cairo_line_to(context, low.x, low.y);
  cairo_line_to(context, high.x, low.y);
  cairo_line_to(context, high.x, high.y);
  cairo_stroke(context);
}

void draw_water(cairo_t* context, const Mapping& map, const View& box, const std::vector<DrawnEdge>& surface) {
  // One path: pieces that only touch would leave hairs.
  for (const DrawnEdge& edge : surface) {
    const bool forwards = edge.from.x < edge.to.x;
    const Vec2 left = forwards ? edge.from : edge.to, right = forwards ? edge.to : edge.from;
    bool first = true;
    for (const Vec2 corner : {Vec2{left.x, box.bottom}, left, right, Vec2{right.x, box.bottom}}) {
      const Vec2 p = map(corner);
      first ? cairo_move_to(context, p.x, p.y) : cairo_line_to(context, p.x, p.y);
      first = false;
    }
    cairo_close_path(context);
  }
  set_colour(context, kWater);
  cairo_fill(context);
}

void draw_water_surface(cairo_t* context, const Mapping& map, const std::vector<DrawnEdge>& surface) {
  for (const DrawnEdge& edge : surface) {
    const Vec2 from = map(edge.from), to = map(edge.to);
    cairo_move_to(context, rounded(from.x), rounded(from.y));
    cairo_line_to(context, rounded(to.x), rounded(to.y));
  }
  set_colour(context, kWaterSurface);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_width(context, 1.6);
  cairo_stroke(context);
}

void draw_surface(cairo_t* context, const Mapping& map, const View& box, double surface) {
  if (surface <= map.view.bottom || surface >= map.view.top) return;
  const Vec2 left = map({std::max(box.left, map.view.left), surface}),
             right = map({std::min(box.right, map.view.right), surface});
  const double dashes[] = {5, 3};
  set_colour(context, {0.75, 0.20, 0.10});
  cairo_set_line_cap(context, CAIRO_LINE_CAP_BUTT);
  cairo_set_dash(context, dashes, 2, 0);
  cairo_set_line_width(context, 1);
  cairo_move_to(context, left.x, left.y);
  cairo_line_to(context, right.x, right.y);
  cairo_stroke(context);
  cairo_set_dash(context, nullptr, 0, 0);
}

}  // namespace seapile::present
