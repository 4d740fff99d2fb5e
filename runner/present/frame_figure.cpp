#include "runner/present/frame_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "runner/present/arrays.h"
#include "runner/present/axis.h"
#include "runner/present/flow_mesh.h"
#include "runner/present/pile_outline.h"
#include "runner/store/store_error.h"
#include "solver/pile/pile.h"

namespace seapile::present {
namespace {

using base::Vec2;

constexpr double kTipFromTop = 1.0 / 3;  ///< of the view's height
constexpr double kMargin = 0.02;         ///< around the box, share of the view's larger edge
constexpr int kMostLayers = 25;
constexpr double kWidestLine = 0.8;   ///< of the largest force, in mean grain diameters
constexpr double kLongestAxis = 1.0;  ///< semi-axis of the largest stress, in cells
constexpr double kPileArrow = 1.5;    ///< the pile's speed as an arrow, in mean grain diameters

View box_of(const FrameOfRun& run) {
  const scene::DomainSpec& domain = run.scene.bed.domain;
  return {-domain.width / 2, domain.width / 2, 0, domain.height};
}

const pile::PileSpec& pile_of(const FrameOfRun& run) {
  if (!run.scene.pile) throw std::logic_error("a frame of a scene without a pile");
  return *run.scene.pile;
}

bool meet(const View& a, const View& b) {
  return a.left <= b.right && b.left <= a.right && a.bottom <= b.top && b.bottom <= a.top;
}

View around(const View& a, const View& b) {
  return {std::min(a.left, b.left), std::max(a.right, b.right), std::min(a.bottom, b.bottom), std::max(a.top, b.top)};
}

bool sees(const View& view, const DrawnGrain& grain) {
  // The nearest point of the view to the centre.
  const Vec2 nearest{std::clamp(grain.centre.x, view.left, view.right),
                     std::clamp(grain.centre.y, view.bottom, view.top)};
  return norm(grain.centre - nearest) < grain.radius;
}

/// By the line's bounding box: at a corner of the view a line may be taken in that passes just outside.
bool sees(const View& view, const DrawnForce& line) {
  const double half = line.width / 2;
  return meet(view, {std::min(line.from.x, line.to.x) - half, std::max(line.from.x, line.to.x) + half,
                     std::min(line.from.y, line.to.y) - half, std::max(line.from.y, line.to.y) + half});
}

bool sees(const View& view, Vec2 point) {
  return point.x >= view.left && point.x <= view.right && point.y >= view.bottom && point.y <= view.top;
}

double mean_diameter(const std::vector<FrameOfRun>& runs) {
  double sum = 0;
  std::size_t count = 0;
  for (const FrameOfRun& run : runs) {
    const auto& radius = values<double>(run.frame.grains, "grains/radius");
    for (const double r : radius) sum += 2 * r;
    count += radius.size();
  }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

void add_grains(const FrameOfRun& run, double layer, FramePanel& panel) {
  const auto& position = values<double>(run.frame.grains, "grains/position");
  const auto& radius = values<double>(run.frame.grains, "grains/radius");
  const auto& displacement = values<double>(run.frame.grains, "grains/displacement");
  for (std::size_t i = 0; i < radius.size(); ++i) {
    DrawnGrain grain{vec2(position, i), radius[i], 0};
    if (!sees(panel.view, grain)) continue;
    if (layer > 0) grain.layer = std::lround(std::floor((grain.centre.y - vec2(displacement, i).y) / layer));
    panel.grains.push_back(grain);
  }
}

/// Lines of all contacts that press, wherever they are; without widths yet.
std::vector<DrawnForce> force_lines(const FrameOfRun& run) {
  const auto& id = values<std::int64_t>(run.frame.grains, "grains/id");
  const auto& position = values<double>(run.frame.grains, "grains/position");
  const auto& pair = values<std::int64_t>(run.frame.contacts, "contacts/grain");
  const auto& point = values<double>(run.frame.contacts, "contacts/position");
  const auto& force = values<double>(run.frame.contacts, "contacts/force");
  const auto centre = [&](std::int64_t name) {
    const auto row = std::ranges::lower_bound(id, name);  // A frame's grains are in the order of their ids.
    if (row == id.end() || *row != name) {
      throw store::StoreError(store::StoreError::Kind::damaged, fmt::format("the frame has no grain {}", name));
    }
    return vec2(position, static_cast<std::size_t>(row - id.begin()));
  };
  std::vector<DrawnForce> lines;
  for (std::size_t k = 0; 2 * k < pair.size(); ++k) {
    if (force.at(2 * k) <= 0) continue;
    const bool with_grain = pair[2 * k + 1] >= 0;
    lines.push_back({centre(pair[2 * k]), with_grain ? centre(pair[2 * k + 1]) : vec2(point, k), force.at(2 * k), 0});
  }
  return lines;
}

std::vector<DrawnStress> stresses_in(const View& view, const simulation::Frame& frame) {
  const auto& principal = values<double>(frame.cells, "cells/principal_stress");
  const auto& direction = values<double>(frame.cells, "cells/principal_direction");
  std::vector<DrawnStress> list;
  for (std::size_t k = 0; k < direction.size(); ++k) {
    const std::size_t columns = static_cast<std::size_t>(frame.grid.nx);
    const Vec2 centre{frame.grid.x0 + (static_cast<double>(k % columns) + 0.5) * frame.grid.spacing,
                      frame.grid.y0 + (static_cast<double>(k / columns) + 0.5) * frame.grid.spacing};
    const Vec2 values_here = vec2(principal, k);
    const bool is_empty = values_here.x == 0 && values_here.y == 0;
    if (sees(view, centre) && !is_empty) list.push_back({centre, values_here.x, values_here.y, direction[k], 0, 0});
  }
  return list;
}

void add_forces(const std::vector<FrameOfRun>& runs, FrameFigure& figure) {
  std::vector<std::vector<DrawnForce>> lines;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    lines.push_back(force_lines(runs[k]));
    for (const DrawnForce& line : lines.back()) {
      if (sees(figure.panels[k].view, line)) figure.scale.full = std::max(figure.scale.full, line.force);
    }
  }
  figure.scale.length = kWidestLine * mean_diameter(runs);
  if (figure.scale.full == 0) return;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    for (DrawnForce& line : lines[k]) {
      if (!sees(figure.panels[k].view, line)) continue;
      line.width = line.force / figure.scale.full * figure.scale.length;
      figure.panels[k].forces.push_back(line);
    }
  }
}

void add_stresses(const std::vector<FrameOfRun>& runs, FrameFigure& figure) {
  for (std::size_t k = 0; k < runs.size(); ++k) {
    figure.panels[k].stresses = stresses_in(figure.panels[k].view, runs[k].frame);
    figure.scale.length = std::max(figure.scale.length, kLongestAxis * runs[k].frame.grid.spacing);
    for (const DrawnStress& stress : figure.panels[k].stresses) {
      figure.scale.full = std::max({figure.scale.full, std::abs(stress.major), std::abs(stress.minor)});
    }
  }
  for (FramePanel& panel : figure.panels) {
    for (DrawnStress& stress : panel.stresses) {
      stress.semi_major = std::abs(stress.major) / figure.scale.full * figure.scale.length;
      stress.semi_minor = std::abs(stress.minor) / figure.scale.full * figure.scale.length;
    }
  }
}

void add_velocities(const std::vector<FrameOfRun>& runs, FrameFigure& figure) {
  figure.scale.full = 1;
  figure.scale.length = kPileArrow * mean_diameter(runs);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const double pile_speed = figure.panels[k].pile_speed;
    if (pile_speed == 0) throw std::invalid_argument("the pile never moves: velocities have nothing to be measured by");
    const auto& position = values<double>(runs[k].frame.grains, "grains/position");
    const auto& radius = values<double>(runs[k].frame.grains, "grains/radius");
    const auto& velocity = values<double>(runs[k].frame.grains, "grains/velocity");
    for (std::size_t i = 0; i < radius.size(); ++i) {
      const DrawnGrain grain{vec2(position, i), radius[i], 0};
      if (!sees(figure.panels[k].view, grain)) continue;
      const Vec2 v = (1 / pile_speed) * vec2(velocity, i);
      figure.panels[k].velocities.push_back({grain.centre, grain.centre + figure.scale.length * v, norm(v)});
    }
  }
}

/// The free surface of the fluid, edge by edge.
std::vector<DrawnEdge> water_of(const FrameOfRun& run) {
  if (!run.fluid || run.fluid->surface.empty()) return {};
  const FlowMesh mesh(*run.fluid);
  const auto& row = values<std::int64_t>(run.fluid->surface, "surface/vertex");
  std::vector<DrawnEdge> edges;
  for (std::size_t i = 0; i + 1 < row.size(); ++i) edges.push_back({mesh.at(row[i]), mesh.at(row[i + 1])});
  return edges;
}

std::vector<std::string> sizes_of(const FrameOfRun& run) {
  const scene::DomainSpec& domain = run.scene.bed.domain;
  const auto& radius = values<double>(run.frame.grains, "grains/radius");
  std::string text = fmt::format("Box {:g} m by {:g} m; bed {:.2f} m high", domain.width, domain.height, run.surface);
  if (!radius.empty()) {
    const auto [least, most] = std::ranges::minmax(radius);
    text += fmt::format(", {} grains of radii {:.3g} to {:.3g} mm", radius.size(), 1e3 * least, 1e3 * most);
  }
  std::vector<std::string> sentences = {fmt::format("{}; pile {:g} m wide.", text, 2 * pile_of(run).radius)};
  if (!run.fluid) return sentences;
  const FlowMesh mesh(*run.fluid);
  const std::string deep = run.scene.fluid ? fmt::format(" {:g} m deep", run.scene.fluid->depth) : "";
  sentences.push_back(
      fmt::format("Fluid{}; mesh of {} vertices and {} triangles.", deep, mesh.vertices(), mesh.triangles()));
  return sentences;
}

bool is_whole(FigureKind kind) { return kind == FigureKind::bed || kind == FigureKind::initial; }

}  // namespace

View default_view(FigureKind kind, const FrameOfRun& run) {
  const View box = box_of(run);
  if (is_whole(kind)) {
    const auto& position = values<double>(run.frame.grains, "grains/position");
    const auto& radius = values<double>(run.frame.grains, "grains/radius");
    double top = run.surface;
    for (std::size_t i = 0; i < radius.size(); ++i) top = std::max(top, vec2(position, i).y + radius[i]);
    for (const DrawnEdge& edge : water_of(run)) top = std::max({top, edge.from.y, edge.to.y});
    const double margin = kMargin * box.width();
    return {box.left - margin, box.right + margin, box.bottom - margin, top + 5 * margin};
  }
  const double tip = run.surface - run.frame.depth, margin = kMargin * kTipViewEdge;
  const double top = tip + kTipFromTop * kTipViewEdge;
  return {std::max(-kTipViewEdge / 2, box.left - margin), std::min(kTipViewEdge / 2, box.right + margin),
          std::max(top - kTipViewEdge, box.bottom - margin), top};
}

FrameFigure frame_figure(FigureKind kind, const std::vector<FrameOfRun>& runs, const std::optional<View>& view) {
  FrameFigure figure;
  figure.kind = kind;
  if (runs.empty()) return figure;
  View whole = default_view(kind, runs.front());
  double surface = 0;
  for (const FrameOfRun& run : runs) {
    whole = around(whole, default_view(kind, run));
    surface = std::max(surface, run.surface);
  }
  for (const FrameOfRun& run : runs) {
    FramePanel panel{run.title, run.frame.depth, {}, box_of(run), run.surface, {}, 0, {}, {}, {}, {}, {}};
    panel.pile_speed = pile::largest_speed(pile_of(run).driving);
    panel.view = view ? *view : is_whole(kind) ? whole : default_view(kind, run);
    if (!meet(panel.view, panel.box)) {
      throw std::invalid_argument(
          fmt::format("the window shows nothing of the box, which is x from {:g} to {:g} m and "
                      "y from 0 to {:g} m",
                      panel.box.left, panel.box.right, panel.box.top));
    }
    panel.pile = pile_outline(pile_of(run), run.surface - run.frame.depth, panel.view.top);
    if (kind == FigureKind::initial) {
      panel.water = water_of(run);
      panel.sizes = sizes_of(run);
    }
    figure.panels.push_back(std::move(panel));
  }

  if (kind == FigureKind::bed) figure.scale.layer = nice_step(surface, kMostLayers);
  if (kind == FigureKind::forces) add_forces(runs, figure);
  if (kind == FigureKind::stress) add_stresses(runs, figure);
  if (kind == FigureKind::velocity) add_velocities(runs, figure);
  if (kind != FigureKind::stress) {
    for (std::size_t k = 0; k < runs.size(); ++k) add_grains(runs[k], figure.scale.layer, figure.panels[k]);
  }
  return figure;
}

}  // namespace seapile::present
