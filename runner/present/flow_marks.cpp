#include "runner/present/flow_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <limits>
#include <set>
#include <utility>

namespace seapile::present {
namespace {

using base::Vec2;

constexpr double kGrid = 8;  ///< places per unit: shorter numbers in SVG files, too fine to be seen
constexpr Colour kInner = {0.45, 0.45, 0.50}, kBoundary = {0.12, 0.12, 0.12}, kSurface = {0.84, 0.20, 0.05};
constexpr Colour kDie = {0.86, 0.86, 0.87};

void set_look(cairo_t* context, EdgeLook look) {
  set_colour(context, look == EdgeLook::inner ? kInner : look == EdgeLook::boundary ? kBoundary : kSurface);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_width(context, look == EdgeLook::inner ? 0.4 : look == EdgeLook::boundary ? 1.0 : 1.8);
}

/// A point of the canvas on a grid that is too fine to be seen, so that equal points are equal.
struct Place {
  long x = 0, y = 0;
  friend auto operator<=>(const Place&, const Place&) = default;
};

Place place(Vec2 p) { return {std::lround(p.x * kGrid), std::lround(p.y * kGrid)}; }

struct Point {
  Vec2 at;
  double level = 0;
};

using Polygon = std::vector<Point>;

/// The part of a convex polygon on one side of a level. Two triangles with a common edge cut it at
/// the same place: the same sum is formed whichever way the edge is passed.
Polygon cut(const Polygon& polygon, double level, bool above) {
  const auto inside = [&](const Point& p) { return above ? p.level >= level : p.level <= level; };
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (inside(a)) part.push_back(a);
    if (inside(a) == inside(b)) continue;
    const Point &low = a.level < b.level ? a : b, &high = a.level < b.level ? b : a;
    part.push_back({low.at + ((level - low.level) / (high.level - low.level)) * (high.at - low.at), level});
  }
  return part;
}

/// Polygons that lie side by side as the outline of them all: an edge that two of them have vanishes.
class Outline {
 public:
  void add(const Polygon& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Place from = place(polygon[i].at), to = place(polygon[(i + 1) % polygon.size()].at);
      if (from == to) continue;
      if (const auto back = edges_.find({to, from}); back != edges_.end()) {
        edges_.erase(back);
      } else {
        edges_.insert({from, to});
      }
    }
  }

  /// As a path. What comes to a place leaves it again, so that every walk ends where it began.
  void trace(cairo_t* context) {
    while (!edges_.empty()) {
      const Place start = edges_.begin()->first;
      cairo_move_to(context, static_cast<double>(start.x) / kGrid, static_cast<double>(start.y) / kGrid);
      for (Place at = start;;) {
        const auto next = edges_.lower_bound({at, Place{std::numeric_limits<long>::min(), 0}});
        at = next->second;
        edges_.erase(next);
        if (at == start) break;
        cairo_line_to(context, static_cast<double>(at.x) / kGrid, static_cast<double>(at.y) / kGrid);
      }
      cairo_close_path(context);
    }
  }

 private:
  std::multiset<std::pair<Place, Place>> edges_;
};

}  // namespace

void draw_edges(cairo_t* context, const Mapping& map, const std::vector<DrawnEdge>& edges, EdgeLook look) {
  for (const DrawnEdge& edge : edges) {
    const Place from = place(map(edge.from)), to = place(map(edge.to));
    cairo_move_to(context, static_cast<double>(from.x) / kGrid, static_cast<double>(from.y) / kGrid);
    cairo_line_to(context, static_cast<double>(to.x) / kGrid, static_cast<double>(to.y) / kGrid);
  }
  set_look(context, look);
  cairo_stroke(context);
}

void draw_sample(cairo_t* context, Vec2 from, Vec2 to, EdgeLook look) {
  cairo_move_to(context, from.x, from.y);
  cairo_line_to(context, to.x, to.y);
  set_look(context, look);
  cairo_stroke(context);
}

void draw_values(cairo_t* context, const Mapping& map, const std::vector<DrawnTriangle>& faces, double low,
                 double full) {
  if (full <= low) return;
  // A band reaches under the next one, which is drawn over it: edges of two colours that only touch leave a pale hair.
  std::array<Outline, kBands> bands;
  for (const DrawnTriangle& face : faces) {
    Polygon triangle;
    double least = kBands, most = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double level = (face.value[k] - low) / (full - low) * kBands;
      triangle.push_back({map(face.corner[k]), level});
      least = std::min(least, level);
      most = std::max(most, level);
    }
    const int first = std::max(0, static_cast<int>(least) - 1);
    for (int band = first; band < kBands && band <= most; ++band) {
      bands[static_cast<std::size_t>(band)].add(cut(cut(triangle, band, true), band + 2, false));
    }
  }
  for (std::size_t band = 0; band < bands.size(); ++band) {
    bands[band].trace(context);
    set_colour(context, colour_of((static_cast<double>(band) + 0.5) / kBands));
    cairo_fill(context);
  }
}

void draw_flow(cairo_t* context, const Mapping& map, const std::vector<DrawnVelocity>& arrows) {
  for (const DrawnVelocity& arrow : arrows) add_arrow(context, map(arrow.tail), map(arrow.head));
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_set_source_rgba(context, 1, 1, 1, 0.75);
  cairo_set_line_width(context, 2.4);
  cairo_stroke_preserve(context);
  set_colour(context, kBoundary);
  cairo_set_line_width(context, 0.9);
  cairo_stroke(context);
}

void draw_die(cairo_t* context, const Mapping& map, const View& die) {
  if (die.top <= die.bottom) return;
  const Vec2 corner = map({die.left, die.top}), opposite = map({die.right, die.bottom});
  cairo_rectangle(context, corner.x, corner.y, opposite.x - corner.x, opposite.y - corner.y);
  set_colour(context, kDie);
  cairo_fill(context);
}

}  // namespace seapile::present
