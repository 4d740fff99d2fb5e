#include "runner/present/flow_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>

#include "runner/present/axis.h"
#include "runner/present/flow_mesh.h"
#include "runner/present/pile_outline.h"

namespace seapile::present {
namespace {

using base::Vec2;

constexpr double kBeforeLip = 2, kBehindLip = 4;  ///< [H]
constexpr double kMargin = 0.1;                   ///< around a jet [H]
constexpr double kShareAround = 0.03;             ///< around other fluids, of the larger edge
constexpr int kMostArrows = 32;                   ///< along the larger edge of the view
constexpr double kLongestArrow = 0.9;             ///< in spacings of the grid

View around(std::span<const Vec2> points) {
  View box{points[0].x, points[0].x, points[0].y, points[0].y};
  for (const Vec2 p : points) {
    box = {std::min(box.left, p.x), std::max(box.right, p.x), std::min(box.bottom, p.y), std::max(box.top, p.y)};
  }
  return box;
}

View around(const View& a, const View& b) {
  return {std::min(a.left, b.left), std::max(a.right, b.right), std::min(a.bottom, b.bottom), std::max(a.top, b.top)};
}

bool meet(const View& a, const View& b) {
  return a.left <= b.right && b.left <= a.right && a.bottom <= b.top && b.bottom <= a.top;
}

bool sees(const View& view, Vec2 p) {
  return p.x >= view.left && p.x <= view.right && p.y >= view.bottom && p.y <= view.top;
}

View box_of(const FlowMesh& mesh) {
  std::vector<Vec2> points;
  for (std::size_t v = 0; v < mesh.vertices(); ++v) points.push_back(mesh.at(static_cast<std::int64_t>(v)));
  if (points.empty()) throw store::StoreError(store::StoreError::Kind::damaged, "the frame has no vertices");
  return around(points);
}

using Ends = std::pair<std::int64_t, std::int64_t>;  ///< rows of an edge's vertices, the lower one first

Ends ends(std::int64_t a, std::int64_t b) { return {std::min(a, b), std::max(a, b)}; }

/// Every edge once, sorted by what it separates: two triangles, fluid and air, or fluid and the rest.
void add_edges(const FlowMesh& mesh, const simulation::FlowFrame& frame, FlowFigureKind kind, FlowPanel& panel) {
  std::map<Ends, int> triangles_at;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const auto corner = mesh.triangle(t);
    for (std::size_t k = 0; k < 3; ++k) ++triangles_at[ends(corner[k], corner[(k + 1) % 3])];
  }
  std::set<Ends> surface;
  if (!frame.surface.empty()) {
    const auto& row = values<std::int64_t>(frame.surface, "surface/vertex");
    for (std::size_t i = 0; i + 1 < row.size(); ++i) surface.insert(ends(row[i], row[i + 1]));
  }
  for (const auto& [edge, count] : triangles_at) {
    const Vec2 both[] = {mesh.at(edge.first), mesh.at(edge.second)};
    if (!meet(panel.view, around(both))) continue;
    if (count > 1 && kind != FlowFigureKind::mesh) continue;
    (count > 1 ? panel.edges : surface.contains(edge) ? panel.surface : panel.boundary).push_back({both[0], both[1]});
  }
}

/// The velocity at a point of the triangles that are drawn, linear in each; absent where there is none of them.
std::optional<Vec2> velocity_at(Vec2 p, const FlowMesh& mesh, const std::vector<double>& velocity,
                                const std::vector<std::size_t>& seen) {
  for (const std::size_t t : seen) {
    const auto corner = mesh.triangle(t);
    const Vec2 a = mesh.at(corner[0]), ab = mesh.at(corner[1]) - a, ac = mesh.at(corner[2]) - a, ap = p - a;
    const double area = ab.x * ac.y - ab.y * ac.x;
    const double b = (ap.x * ac.y - ap.y * ac.x) / area, c = (ab.x * ap.y - ab.y * ap.x) / area;
    constexpr double kHair = -1e-9;  // A point on an edge lies in one of its triangles, however sums are rounded.
    if (!(b >= kHair && c >= kHair && b + c <= 1 - kHair)) continue;
    const auto at = [&](std::size_t k) { return vec2(velocity, static_cast<std::size_t>(corner[k])); };
    return (1 - b - c) * at(0) + b * at(1) + c * at(2);
  }
  return std::nullopt;
}

/// What the colours of a figure stand for, at each vertex of a frame.
std::vector<double> values_of(FlowFigureKind kind, const simulation::FlowFrame& frame) {
  if (kind == FlowFigureKind::pressure) return values<double>(frame.vertices, "vertices/pressure");
  if (kind == FlowFigureKind::porosity) return values<double>(frame.vertices, "vertices/porosity");
  const auto& velocity = values<double>(frame.vertices, "vertices/velocity");
  std::vector<double> speeds;
  for (std::size_t v = 0; 2 * v < velocity.size(); ++v) speeds.push_back(norm(vec2(velocity, v)));
  return speeds;
}

/// The triangles in their panels, and the range of their values. Returns which triangles they are.
std::vector<std::vector<std::size_t>> add_faces(const std::vector<FlowOfRun>& runs, FlowFigure& figure) {
  std::vector<std::vector<std::size_t>> seen(runs.size());
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const FlowMesh mesh(runs[k].frame);
    const std::vector<double> at_vertices = values_of(figure.kind, runs[k].frame);
    FlowPanel& panel = figure.panels[k];
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
      const auto corner = mesh.triangle(t);
      DrawnTriangle face;
      for (std::size_t i = 0; i < 3; ++i) {
        face.corner[i] = mesh.at(corner[i]);
        face.value[i] = at_vertices.at(static_cast<std::size_t>(corner[i]));
      }
      // A flow that diverged may hold what is no number: such a triangle stays white.
      const bool known = std::ranges::all_of(face.value, [](double value) { return std::isfinite(value); });
      if (!known || !meet(panel.view, around(face.corner))) continue;
      low = std::min(low, *std::ranges::min_element(face.value));
      high = std::max(high, *std::ranges::max_element(face.value));
      seen[k].push_back(t);
      panel.faces.push_back(face);
    }
  }
  if (!(low <= high)) return seen;
  figure.low = figure.kind == FlowFigureKind::pressure ? low : 0;
  figure.full = figure.kind == FlowFigureKind::porosity ? 1 : high;
  return seen;
}

void add_arrows(const std::vector<FlowOfRun>& runs, const std::vector<std::vector<std::size_t>>& seen,
                FlowFigure& figure) {
  double edge = 0;
  for (const FlowPanel& panel : figure.panels) edge = std::max({edge, panel.view.width(), panel.view.height()});
  figure.spacing = nice_step(edge, kMostArrows);
  figure.length = kLongestArrow * figure.spacing;
  if (figure.full == 0) return;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const FlowMesh mesh(runs[k].frame);
    const auto& velocity = values<double>(runs[k].frame.vertices, "vertices/velocity");
    FlowPanel& panel = figure.panels[k];
    // Half a step off the axis, on which arrows would lie on the edge of the fluid.
    const auto first = [&](double from) { return (std::ceil(from / figure.spacing - 0.5) + 0.5) * figure.spacing; };
    for (double x = first(panel.view.left); x < panel.view.right; x += figure.spacing) {
      for (double y = first(panel.view.bottom); y < panel.view.top; y += figure.spacing) {
        const auto v = velocity_at({x, y}, mesh, velocity, seen[k]);
        if (!v) continue;
        const Vec2 middle{x, y}, half = (figure.length / figure.full / 2) * *v;
        const auto fits = [&](Vec2 end) { return sees(panel.view, end) && velocity_at(end, mesh, velocity, seen[k]); };
        if (!fits(middle - half) || !fits(middle + half)) continue;
        panel.arrows.push_back({middle - half, middle + half, norm(*v) / figure.full});
      }
    }
  }
}

/// The pile in the frame; empty without one.
std::vector<Vec2> pile_in(const FlowOfRun& run, double top) {
  if (run.pile && run.scene.pile) return pile_outline(*run.scene.pile, run.pile->surface - run.pile->depth, top);
  if (!run.scene.basin || !run.scene.basin->pile) return {};
  const basin::BasinSpec& basin = *run.scene.basin;
  pile::PileSpec pile;
  pile.radius = basin.pile->radius;
  pile.tip = basin.pile->tip;
  const double apex = basin.depth - basin.pile->start - pile::path(basin.pile->driving, run.frame.time);
  return pile_outline(pile, apex, top);
}

}  // namespace

std::string title_of(const FlowOfRun& run) {
  if (run.pile) return fmt::format("{}, d = {:.3f} m", run.title, run.pile->depth);
  return run.scene.basin ? fmt::format("{}, t = {:.6g} s", run.title, run.frame.time) : run.title;
}

View default_view(const FlowOfRun& run) {
  const FlowMesh mesh(run.frame);
  const View box = box_of(mesh);
  if (!run.scene.jet) {
    const double around = kShareAround * std::max(box.width(), box.height());
    return {box.left - around, box.right + around, box.bottom - around, box.top + around};
  }
  View view{std::max(-kBeforeLip, box.left - kMargin), std::min(kBehindLip, box.right + kMargin), box.bottom - kMargin,
            box.bottom};
  for (std::size_t v = 0; v < mesh.vertices(); ++v) {
    const Vec2 p = mesh.at(static_cast<std::int64_t>(v));
    if (p.x >= view.left && p.x <= view.right) view.top = std::max(view.top, p.y);
  }
  view.top += 2 * kMargin;
  return view;
}

FlowFigure flow_figure(FlowFigureKind kind, const std::vector<FlowOfRun>& runs, const std::optional<View>& view) {
  FlowFigure figure;
  figure.kind = kind;
  if (runs.empty()) return figure;
  figure.basins = !runs.front().scene.jet;
  figure.beds = std::ranges::all_of(runs, [](const FlowOfRun& run) { return run.scene.fluid.has_value(); });
  View whole = default_view(runs.front());
  for (const FlowOfRun& run : runs) whole = around(whole, default_view(run));
  for (const FlowOfRun& run : runs) {
    if (run.scene.jet.has_value() == figure.basins) {
      throw std::invalid_argument("a jet and another flow have no scale in common");
    }
    const FlowMesh mesh(run.frame);
    FlowPanel panel;
    panel.title = title_of(run);
    panel.view = view.value_or(whole);
    panel.vertices = mesh.vertices();
    panel.triangles = mesh.triangles();
    if (const View box = box_of(mesh); !meet(panel.view, box)) {
      throw std::invalid_argument(
          fmt::format("the window shows nothing of the fluid, which is x from {0:g} to {1:g} {4} and y from {2:g} to "
                      "{3:g} {4}",
                      box.left, box.right, box.bottom, box.top, figure.basins ? "m" : "H"));
    }
    if (run.scene.jet) panel.die = {-run.scene.jet->upstream, 0, 1, panel.view.top};
    panel.pile = pile_in(run, panel.view.top);
    add_edges(mesh, run.frame, kind, panel);
    figure.panels.push_back(std::move(panel));
  }
  if (kind == FlowFigureKind::mesh) return figure;
  const auto seen = add_faces(runs, figure);
  if (kind == FlowFigureKind::velocity) add_arrows(runs, seen, figure);
  return figure;
}

}  // namespace seapile::present
