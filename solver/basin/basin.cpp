#include "solver/basin/basin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "solver/basin/remesh.h"
#include "solver/mesh/basin_mesh.h"
#include "solver/mesh/inversion.h"
#include "solver/mesh/rectangle.h"

namespace seapile::basin {
namespace {

using fluid::kVelocityX;
using fluid::kVelocityY;

constexpr double kBottom = 0;

pile::PileSpec as_pile(const BasinPileSpec& spec) {
  pile::PileSpec pile;
  pile.radius = spec.radius;
  pile.tip = spec.tip;
  pile.driving = spec.driving;
  return pile;
}

double initial_height(const BasinSpec& spec, double x) {
  if (!spec.surface) return spec.depth;
  if (const auto* hump = std::get_if<HumpSurface>(&spec.surface->initial)) {
    const double s = x / hump->width;
    return spec.depth + hump->amplitude * (s == 0 ? 1 : std::sin(s) / s);
  }
  if (const auto* wave = std::get_if<CosineSurface>(&spec.surface->initial)) {
    const double phase = static_cast<double>(wave->mode) * std::numbers::pi * (x / spec.width + 0.5);
    return spec.depth + wave->amplitude * std::cos(phase);
  }
  return spec.depth;
}

/// The surface's vertices at rest, right half, as far apart as the mesh is fine.
std::vector<base::Vec2> level_top(const BasinSpec& spec, const UnstructuredMesh& pattern) {
  const double first = spec.pile ? spec.pile->radius : 0, last = 0.5 * spec.width;
  const double tip = tip_at(spec, 0);
  const auto size = [&](double x) {
    if (!spec.pile) return pattern.size;
    return std::min(pattern.size, pattern.pile_size + pattern.growth * std::hypot(x - first, spec.depth - tip));
  };
  // Edges in proportion to the size: equal shares of the integral of 1/size.
  constexpr int kFine = 4000;
  std::vector<double> edges(kFine + 1, 0);
  const auto place = [&](int i) { return first + (last - first) * i / kFine; };
  for (int i = 0; i < kFine; ++i)
    edges[i + 1] = edges[i] + (place(i + 1) - place(i)) / size(0.5 * (place(i) + place(i + 1)));
  const int count = std::max(1, static_cast<int>(std::lround(edges.back())));
  std::vector<base::Vec2> top{{first, spec.depth}};
  for (int k = 1, i = 0; k < count; ++k) {
    const double wanted = edges.back() * k / count;
    while (edges[i + 1] < wanted) ++i;
    const double at = (wanted - edges[i]) / (edges[i + 1] - edges[i]);
    top.push_back({(1 - at) * place(i) + at * place(i + 1), spec.depth});
  }
  top.push_back({last, spec.depth});
  return top;
}

/// Heights of the rows' edges, each row as much higher than the one below it as all others.
std::vector<double> rows_of(const StructuredMesh& grid, double depth) {
  const auto count = static_cast<int>(grid.rows);
  if (grid.bottom_row == 1) return mesh::even(kBottom, depth, count);
  const auto heights = [&](double growth) {
    std::vector<double> y{kBottom};
    for (double row = grid.bottom_row * depth / count; static_cast<int>(y.size()) <= count; row *= growth)
      y.push_back(y.back() + row);
    return y;
  };
  double low = 1, high = 2;
  while (heights(high).back() < depth) high *= 2;
  for (int i = 0; i < 100; ++i) (heights(0.5 * (low + high)).back() < depth ? low : high) = 0.5 * (low + high);
  std::vector<double> y = heights(low);
  y.back() = depth;
  return y;
}

mesh::TriangleMesh first_mesh(const BasinSpec& spec) {
  if (const auto* grid = std::get_if<StructuredMesh>(&spec.mesh.pattern)) {
    const std::vector<double> x = mesh::even(-0.5 * spec.width, 0.5 * spec.width, static_cast<int>(grid->columns)),
                              y = rows_of(*grid, spec.depth);
    return mesh::rectangle(x, y, mesh::Diagonals::mirrored);
  }
  return mesh_for(spec, level_top(spec, std::get<UnstructuredMesh>(spec.mesh.pattern)), tip_at(spec, 0));
}

mesh::MotionKind motion_of(const MotionMethod& method) {
  if (const auto* zones = std::get_if<ZonesMotion>(&method)) return mesh::Zones{zones->reach};
  if (const auto* elliptic = std::get_if<EllipticMotion>(&method)) return mesh::Elliptic{elliptic->stiffening};
  return mesh::Vertical{};
}

fluid::KinematicScheme kinematic(SurfaceScheme scheme) {
  switch (scheme) {
    case SurfaceScheme::galerkin:
      return fluid::KinematicScheme::galerkin;
    case SurfaceScheme::differences:
      return fluid::KinematicScheme::differences;
    case SurfaceScheme::conservative:
    case SurfaceScheme::upwinded:
      break;
  }
  return fluid::KinematicScheme::upwinded;
}

}  // namespace

double tip_at(const BasinSpec& spec, double time) {
  return spec.pile ? spec.depth - spec.pile->start - pile::path(spec.pile->driving, time) : 0;
}

std::vector<base::Vec2> tip_outline(const BasinPileSpec& pile, double tip) {
  return {{0, tip}, {pile.radius, tip + pile::tip_height(as_pile(pile))}};
}

double time_of(const Basin& basin) { return basin.clock.time(); }

void set_halvings(Basin& basin, int halvings) {
  if (halvings == basin.clock.halvings) return;
  basin.clock.halvings = halvings;
  basin.past.dt = basin.clock.size();
  basin.past.level.resize(1);
  basin.past_tip.resize(1);
  basin.past_flux.resize(std::min<std::size_t>(basin.past_flux.size(), 1));
}

double volume_of(const mesh::TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& t : mesh.triangle)
    volume += 0.5 * mesh::doubled_area(mesh.position[t[0]], mesh.position[t[1]], mesh.position[t[2]]);
  return volume;
}

double kinetic_energy_of(const fluid::Flow& flow) {
  double sum = 0;
  for (const auto& t : flow.mesh.triangle) {
    const double doubled =
        mesh::doubled_area(flow.mesh.position[t[0]], flow.mesh.position[t[1]], flow.mesh.position[t[2]]);
    for (const auto c : {kVelocityX, kVelocityY}) {
      // Mass matrix of linear functions: area/12 (1 + delta_ij).
      const double a = flow.u(t[0], c), b = flow.u(t[1], c), d = flow.u(t[2], c);
      sum += doubled / 12 * (a * a + b * b + d * d + a * b + b * d + d * a);
    }
  }
  return 0.5 * flow.fluid.density * sum;
}

fluid::Flow flow_in(const BasinSpec& spec, mesh::TriangleMesh mesh) {
  fluid::Flow flow =
      fluid::at_rest(std::move(mesh), {spec.density, spec.viscosity, fluid::Geometry::planar, spec.convection});
  std::vector<std::uint8_t> at_top(flow.mesh.vertices(), 0);
  for (const mesh::BoundaryEdge& e : flow.mesh.boundary)
    if (e.tag == mesh::kBasinTop) at_top[e.from] = at_top[e.to] = 1;
  for (const mesh::BoundaryEdge& e : flow.mesh.boundary)
    for (const std::int32_t v : {e.from, e.to}) {
      const bool wall = e.tag == mesh::kBasinLeft || e.tag == mesh::kBasinRight, bottom = e.tag == mesh::kBasinBottom,
                 pile = e.tag == mesh::kPileTip || e.tag == mesh::kPileSleeve;
      const bool sticks = pile || (wall && spec.walls == WallKind::no_slip);
      if (wall || pile || (bottom && spec.bottom == WallKind::no_slip)) fluid::hold(flow, v, kVelocityX, 0);
      if (bottom || (sticks && !at_top[v])) fluid::hold(flow, v, kVelocityY, 0);
    }
  return flow;
}

fluid::FreeSurface top_of(const BasinSpec& spec, const mesh::TriangleMesh& mesh) {
  fluid::FreeSurface top;
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;  // from the left to the right
  for (const mesh::BoundaryEdge& e : mesh.boundary)
    if (e.tag == mesh::kBasinTop) edges.emplace_back(e.to, e.from);
  std::ranges::sort(edges, {}, [&](const auto& edge) { return mesh.position[edge.first].x; });
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (e == 0) {
      top.vertex.push_back(edges[e].first);
    } else if (edges[e].first != top.vertex.back()) {
      if (top.gap) throw std::logic_error("basin: the surface has two gaps");
      top.gap = top.vertex.size() - 1;
      top.vertex.push_back(edges[e].first);
    }
    top.vertex.push_back(edges[e].second);
  }
  for (const std::int32_t v : top.vertex) {
    if (!top.x.empty() && !(mesh.position[v].x > top.x.back()))
      throw std::logic_error("basin: a surface whose x does not rise is no graph");
    top.x.push_back(mesh.position[v].x);
    top.height.push_back(mesh.position[v].y);
  }
  top.columns.bottom = kBottom;
  if (spec.surface) {
    top.tension = spec.surface->tension;
    top.scheme = kinematic(spec.surface->scheme);
  }
  return top;
}

Domain domain_of(const BasinSpec& spec, const mesh::TriangleMesh& mesh, const fluid::FreeSurface& top, double tip) {
  mesh::MovingBoundary moving{top.vertex, {}, kBottom};
  std::vector<std::uint8_t> of_tip(mesh.vertices(), 0), of_sleeve(mesh.vertices(), 0);
  std::vector<std::int32_t> wetted, at_pile;
  for (const mesh::BoundaryEdge& e : mesh.boundary) {
    if (e.tag != mesh::kPileTip && e.tag != mesh::kPileSleeve) continue;
    for (const std::int32_t v : {e.from, e.to}) (e.tag == mesh::kPileTip ? of_tip : of_sleeve)[v] = 1;
  }
  for (std::size_t v = 0; v < mesh.vertices(); ++v) {
    if (of_tip[v]) of_sleeve[v] = 0;
    if (of_tip[v] || of_sleeve[v]) wetted.push_back(static_cast<std::int32_t>(v));
    if (of_tip[v]) moving.tip.push_back(static_cast<std::int32_t>(v));
  }
  std::ranges::sort(moving.tip, {}, [&](std::int32_t v) { return mesh.position[v].x; });
  for (std::size_t t = 0; t < mesh.triangles(); ++t)
    if (std::ranges::any_of(mesh.triangle[t], [&](std::int32_t v) { return of_tip[v] != 0 || of_sleeve[v] != 0; }))
      at_pile.push_back(static_cast<std::int32_t>(t));
  return {mesh.position,
          top.height,
          tip,
          mesh::MeshMotion(mesh, moving, motion_of(spec.mesh.motion)),
          under(mesh, top.x),
          std::move(wetted),
          std::move(of_tip),
          std::move(of_sleeve),
          std::move(at_pile)};
}

bool is_iterated(const BasinSpec& spec) {
  return spec.time.iterated && spec.surface &&
         (spec.surface->scheme == SurfaceScheme::conservative || spec.surface->scheme == SurfaceScheme::upwinded);
}

void place(Basin& basin, double tip) {
  const Domain& domain = basin.domain;
  std::vector<double> lifted(basin.top.height.size());
  for (std::size_t s = 0; s < lifted.size(); ++s) lifted[s] = basin.top.height[s] - domain.reference_height[s];
  const std::vector<double> dy = domain.motion.displacements(lifted, tip - domain.reference_tip);
  for (std::size_t v = 0; v < dy.size(); ++v)
    basin.flow.mesh.position[v] = {domain.reference[v].x, domain.reference[v].y + dy[v]};
  for (std::size_t s = 0; s < lifted.size(); ++s) basin.flow.mesh.position[basin.top.vertex[s]].y = basin.top.height[s];
}

void set_outside(Basin& basin) {
  basin.flow.open.clear();
  basin.flow.film.clear();
  if (!basin.spec.surface) return;
  const fluid::FreeSurface& top = basin.top;
  const auto weight = [&](std::size_t s) {
    return basin.spec.density * basin.spec.gravity * (top.height[s] - basin.spec.depth);
  };
  for (std::size_t s = 0; s + 1 < top.vertex.size(); ++s) {
    if (top.gap == s) continue;
    basin.flow.open.push_back({top.vertex[s + 1], top.vertex[s], {weight(s + 1), weight(s)}});
    basin.flow.film.push_back({top.vertex[s + 1], top.vertex[s], top.tension, basin.spec.density * basin.spec.gravity,
                               is_iterated(basin.spec)});
  }
}

Basin assembled(const BasinSpec& spec, base::InstructionSet instructions, fluid::Flow flow, fluid::FreeSurface top,
                Domain domain) {
  Basin basin{.spec = spec, .flow = std::move(flow), .top = std::move(top), .domain = std::move(domain)};
  basin.clock.dt = spec.time.step;
  basin.solver.order = spec.time.order == 2 ? fluid::TimeOrder::second : fluid::TimeOrder::first;
  basin.solver.tolerance = spec.time.tolerance;
  basin.solver.instructions = instructions;
  basin.solver.unsteadiness = spec.time.rate;
  return basin;
}

Basin filled(const BasinSpec& spec, base::InstructionSet instructions) {
  return filled(spec, instructions, first_mesh(spec));
}

Basin filled(const BasinSpec& spec, base::InstructionSet instructions, mesh::TriangleMesh mesh) {
  fluid::Flow flow = flow_in(spec, std::move(mesh));
  fluid::FreeSurface top = top_of(spec, flow.mesh);
  const double tip = tip_at(spec, 0);
  Domain domain = domain_of(spec, flow.mesh, top, tip);
  Basin basin = assembled(spec, instructions, std::move(flow), std::move(top), std::move(domain));
  for (std::size_t s = 0; s < basin.top.x.size(); ++s) basin.top.height[s] = initial_height(spec, basin.top.x[s]);
  if (const base::Objection found = fluid::objection(basin.top); !found.empty())
    throw mesh::NoMesh("at the start " + found.why);
  place(basin, tip);
  if (mesh::first_inversion(basin.flow.mesh, basin.domain.reference, basin.flow.mesh.position))
    throw mesh::NoMesh("the surface at the start is too sharp for the mesh: triangles would turn over");
  set_outside(basin);
  fluid::remember(basin.past, basin.flow, spec.time.step);
  basin.past_tip = {tip};
  basin.past_flux = {std::vector<double>(basin.top.x.size(), 0)};
  basin.volume_at_start = volume_of(basin.flow.mesh);
  return basin;
}

}  // namespace seapile::basin
