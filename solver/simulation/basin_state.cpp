#include "solver/simulation/basin_state.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/simulation/flow_state.h"

namespace seapile::simulation {
namespace {

using basin::Basin;
using fluid::FreeSurface;

constexpr const char* kPart = "basin/clock";

/// The amplitude of a mode of the surface: (2/L) int (h - H) cos(k x) dx, exact for the polygon.
double amplitude_of(const FreeSurface& top, double width, double depth, double mode) {
  const double k = mode * std::numbers::pi / width;
  double sum = 0;
  for (std::size_t s = 0; s + 1 < top.x.size(); ++s) {
    const double a = k * (top.x[s] + 0.5 * width), b = k * (top.x[s + 1] + 0.5 * width);
    const double slope = (top.height[s + 1] - top.height[s]) / (b - a);
    sum += (top.height[s + 1] - depth) * std::sin(b) - (top.height[s] - depth) * std::sin(a) +
           slope * (std::cos(b) - std::cos(a));
  }
  return 2 / width * sum / k;
}

void take_surface(FlowRecord& record, const Basin& basin) {
  const FreeSurface& top = basin.top;
  const basin::BasinSpec& spec = basin.spec;
  const std::size_t count = top.x.size();
  double area = 0, square = 0, length = 0;
  for (std::size_t s = 0; s + 1 < count; ++s) {
    if (top.gap == s) continue;
    const double dx = top.x[s + 1] - top.x[s], a = top.height[s] - spec.depth, b = top.height[s + 1] - spec.depth;
    area += 0.5 * dx * (a + b);
    square += dx / 3 * (a * a + a * b + b * b);
    length += std::hypot(dx, b - a) - dx;
  }
  record.rise = area / fluid::width_of(top);
  record.potential_energy = 0.5 * spec.density * spec.gravity * square + spec.surface->tension * length;
  const auto [lowest, highest] = std::ranges::minmax(top.height);
  record.lowest = lowest - spec.depth;
  record.highest = highest - spec.depth;
  record.left = top.height.front() - spec.depth;
  record.right = top.height.back() - spec.depth;
  record.middle = top.height[count / 2] - spec.depth;
  record.asymmetry = 0;
  for (std::size_t s = 0; s < count; ++s)
    record.asymmetry = std::max(record.asymmetry, std::abs(top.height[s] - top.height[count - 1 - s]));
  if (const auto* wave = std::get_if<basin::CosineSurface>(&spec.surface->initial))
    record.wave = amplitude_of(top, spec.width, spec.depth, static_cast<double>(wave->mode));
}

/// Largest |v - w| dt/h over the vertices of the triangles, h a triangle's shortest edge. The thesis' (3.19) asks for
/// max |v| dt <= min h of the whole mesh. A mesh that was made at the end of the step has not moved: it has no w.
double cfl_of(const Basin& basin) {
  if (!basin.remeshes.empty() && basin.remeshes.back().time == basin::time_of(basin)) return FlowRecord::kAbsent;
  const fluid::Flow& flow = basin.flow;
  double most = 0;
  for (const auto& t : flow.mesh.triangle) {
    double edge = std::numeric_limits<double>::infinity(), speed = 0;
    for (int k = 0; k < 3; ++k) {
      edge = std::min(edge, norm(flow.mesh.position[t[k]] - flow.mesh.position[t[(k + 1) % 3]]));
      const base::Vec2 u{flow.u(t[k], fluid::kVelocityX), flow.u(t[k], fluid::kVelocityY)};
      speed = std::max(speed, norm((1 / flow.porosity[t[k]]) * u - flow.mesh_velocity[t[k]]));
    }
    most = std::max(most, speed / edge);
  }
  return most * basin.clock.size();
}

/// A report on a remesh as a row of numbers, and back.
std::vector<double> row_of(const basin::RemeshReport& r) {
  std::vector<double> row{r.time, r.velocity_difference, r.energy_change, r.momentum_change};
  for (const mesh::QualitySummary& q : {r.before, r.after})
    row.insert(row.end(), {q.lowest_shape, q.smallest_angle, q.below_half, q.small_angles});
  return row;
}
constexpr int kRemeshColumns = 12;

basin::RemeshReport report_of(std::span<const double> row) {
  basin::RemeshReport r;
  r.time = row[0];
  r.velocity_difference = row[1];
  r.energy_change = row[2];
  r.momentum_change = row[3];
  r.before = {row[4], row[5], row[6], row[7]};
  r.after = {row[8], row[9], row[10], row[11]};
  return r;
}

}  // namespace

FlowRecord record_of(const Basin& basin) {
  const basin::BasinSpec& spec = basin.spec;
  FlowRecord record;
  record.time = basin::time_of(basin);
  record.volume = basin::volume_of(basin.flow.mesh);
  record.volume_error = record.volume / basin.volume_at_start - 1;
  record.kinetic_energy = basin::kinetic_energy_of(basin.flow);
  if (spec.surface) take_surface(record, basin);
  if (spec.pile) {
    record.pile_depth = spec.depth - basin.past_tip.front();
    record.pile_speed = pile::velocity(spec.pile->driving, record.time);
    record.pile_force_x = basin.tip_force.x + basin.sleeve_force.x;
    record.pile_force_y = basin.tip_force.y + basin.sleeve_force.y;
  }
  const mesh::QualitySummary quality = mesh::summary_of(mesh::quality_of(basin.flow.mesh));
  record.lowest_shape = quality.lowest_shape;
  record.below_half = quality.below_half;
  record.smallest_angle = quality.smallest_angle;
  record.small_angles = quality.small_angles;
  record.vertices = static_cast<double>(basin.flow.mesh.vertices());
  record.meshes = static_cast<double>(1 + basin.remeshes.size());
  record.iterations = static_cast<double>(basin.last_iterations);
  record.cfl = cfl_of(basin);
  return record;
}

FlowFrame frame_of(const Basin& basin) {
  return frame_of(basin.flow, basin.spec.surface ? &basin.top : nullptr, basin::time_of(basin), {});
}

std::vector<Array> snapshot(const Basin& basin) {
  const fluid::Flow& flow = basin.flow;
  std::vector<std::int32_t> boundary;
  for (const mesh::BoundaryEdge& e : flow.mesh.boundary)
    boundary.insert(boundary.end(), {e.from, e.to, e.triangle, e.tag});
  std::vector<double> remeshes;
  for (const basin::RemeshReport& r : basin.remeshes) {
    const std::vector<double> row = row_of(r);
    remeshes.insert(remeshes.end(), row.begin(), row.end());
  }
  std::vector<double> flux;
  for (const std::vector<double>& level : basin.past_flux) flux.insert(flux.end(), level.begin(), level.end());
  std::vector<Array> state{
      {{"basin/steps", "-", "steps, corrections, corrections of the last step", 1, Entity::run},
       std::vector<std::int64_t>{basin.clock.step, basin.iterations, basin.last_iterations}},
      {{"basin/volume_at_start", "m2", "volume of the water at the start", 1, Entity::run},
       std::vector<double>{basin.volume_at_start}},
      {{"basin/remeshes", "-", "reports on the remeshes so far", kRemeshColumns, Entity::run}, remeshes},
      {{"mesh/boundary", "-", "ends, triangle and tag of the boundary's edges", 4, Entity::run}, boundary},
      {{"mesh/reference", "m", "places when the mesh was made", 2, Entity::vertex}, flat(basin.domain.reference)},
      {{"mesh/reference_tip", "m", "height of the tip then", 1, Entity::run},
       std::vector<double>{basin.domain.reference_tip}},
      {{"flow/mesh_velocity", "m/s", "velocity of the mesh", 2, Entity::vertex}, flat(flow.mesh_velocity)},
      {{"surface/height", "m", "height", 1, Entity::surface}, basin.top.height},
      {{"surface/past_flux", "m2/s", "fluxes through it, level after level", 1, Entity::run}, flux},
      {{"pile/past_tip", "m", "heights of the tip, newest first", 1, Entity::run}, basin.past_tip},
      {{"pile/force", "N/m", "of the water on tip and sleeve", 2, Entity::run},
       flat({basin.tip_force, basin.sleeve_force})}};
  if (basin.clock.part != 0 || basin.clock.halvings != 0)
    state.push_back({{kPart, "-", "ticks since the last whole step, halvings", 1, Entity::run},
                     std::vector<std::int64_t>{basin.clock.part, basin.clock.halvings}});
  add_flow(state, flow, basin.past, basin.solver);
  return state;
}

Basin restored(const basin::BasinSpec& spec, base::InstructionSet instructions, const std::vector<Array>& state) {
  mesh::TriangleMesh mesh;
  mesh.position = vectors(array_of<double>(state, "mesh/reference"));
  const auto& corner = array_of<std::int32_t>(state, "mesh/corner");
  for (std::size_t i = 0; i + 2 < corner.size(); i += 3)
    mesh.triangle.push_back({corner[i], corner[i + 1], corner[i + 2]});
  const auto& boundary = array_of<std::int32_t>(state, "mesh/boundary");
  for (std::size_t i = 0; i + 3 < boundary.size(); i += 4)
    mesh.boundary.push_back({boundary[i], boundary[i + 1], boundary[i + 2], boundary[i + 3]});

  fluid::Flow flow = basin::flow_in(spec, std::move(mesh));
  FreeSurface top = basin::top_of(spec, flow.mesh);
  basin::Domain domain =
      basin::domain_of(spec, flow.mesh, top, array_of<double>(state, "mesh/reference_tip", 1).front());
  Basin basin = basin::assembled(spec, instructions, std::move(flow), std::move(top), std::move(domain));
  restore_flow(basin.flow, basin.past, basin.solver, state);
  if (has_array(state, kPart)) {
    const auto& part = array_of<std::int64_t>(state, kPart, 2);
    basin.clock.part = static_cast<int>(part[0]);
    basin.clock.halvings = static_cast<int>(part[1]);
  }
  basin.past.dt = basin.clock.size();
  const auto vertices = static_cast<std::ptrdiff_t>(basin.flow.mesh.vertices());
  basin.flow.mesh_velocity = vectors(array_of<double>(state, "flow/mesh_velocity", 2 * vertices));
  basin.top.height = array_of<double>(state, "surface/height", static_cast<std::ptrdiff_t>(basin.top.vertex.size()));
  basin.past_tip = array_of<double>(state, "pile/past_tip", static_cast<std::ptrdiff_t>(basin.past.level.size()));
  const auto& flux = array_of<double>(state, "surface/past_flux");
  const auto count = static_cast<std::ptrdiff_t>(basin.top.height.size());
  for (auto level = flux.begin(); flux.end() - level >= count; level += count)
    basin.past_flux.emplace_back(level, level + count);
  const std::vector<base::Vec2> force = vectors(array_of<double>(state, "pile/force", 4));
  basin.tip_force = force[0];
  basin.sleeve_force = force[1];
  const auto& steps = array_of<std::int64_t>(state, "basin/steps", 3);
  basin.clock.step = steps[0];
  basin.iterations = steps[1];
  basin.last_iterations = steps[2];
  basin.volume_at_start = array_of<double>(state, "basin/volume_at_start", 1).front();
  const auto& remeshes = array_of<double>(state, "basin/remeshes");
  for (std::size_t i = 0; i + kRemeshColumns <= remeshes.size(); i += kRemeshColumns)
    basin.remeshes.push_back(report_of(std::span(remeshes).subspan(i, kRemeshColumns)));
  basin::set_outside(basin);
  return basin;
}

}  // namespace seapile::simulation
