#include "solver/basin/remesh.h"

#include <algorithm>
#include <cmath>

#include "solver/mesh/basin_mesh.h"

namespace seapile::basin {
namespace {

using fluid::kPressure;
using fluid::kVelocityX;
using fluid::kVelocityY;

std::vector<double> component_of(const std::vector<double>& unknown, int component) {
  std::vector<double> values(unknown.size() / 3);
  for (std::size_t v = 0; v < values.size(); ++v) values[v] = unknown[3 * v + component];
  return values;
}

/// Takes the divergence out of velocities that were brought over, but for what the porosity's rate asks: the flow of an
/// instant, in which nothing moves but what pressure pushes. It is done twice, as stabilisation leaves a share of it the first time.
void settle(fluid::Flow& flow, const fluid::FlowSolver& like, double dt) {
  constexpr int kTimes = 2;
  constexpr double kInstant = 1e-3;  // [dt]
  fluid::FlowSolver solver;
  solver.order = fluid::TimeOrder::first;
  solver.tolerance = like.tolerance;
  solver.instructions = like.instructions;
  base::Profile unused;
  const std::vector<double> before = flow.unknown, rate = flow.porosity_rate;
  for (int i = 0; i < kTimes; ++i) {
    fluid::Past past;
    fluid::remember(past, flow, kInstant * dt);
    fluid::set_rates(flow, past, solver.order);
    flow.porosity_rate = rate;
    fluid::advance(flow, past, solver, unused);  // where it fails the flow stays as it was
  }
  // The pressure of an instant is none of the flow's.
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v) flow.unknown[3 * v + kPressure] = before[3 * v + kPressure];
}

}  // namespace

bool needs_new_mesh(const Basin& basin) {
  const auto& rule = basin.spec.mesh.remesh;
  return rule && mesh::asks_for_new_mesh({rule->angle, rule->share, rule->shape}, basin.flow.mesh);
}

mesh::TriangleMesh mesh_for(const BasinSpec& spec, const std::vector<base::Vec2>& right_half_of_top, double tip) {
  const auto& pattern = std::get<UnstructuredMesh>(spec.mesh.pattern);
  mesh::BasinOutline outline{spec.width, right_half_of_top, {}};
  if (!spec.pile) return mesh::basin_mesh(outline, [&](base::Vec2) { return pattern.size; });
  outline.pile = tip_outline(*spec.pile, tip);
  return mesh::basin_mesh(outline, [&](base::Vec2 p) {
    // From the tip's face, as a level line over its width.
    const double beside = std::max(0.0, std::abs(p.x) - spec.pile->radius);
    return std::min(pattern.size, pattern.pile_size + pattern.growth * std::hypot(beside, p.y - tip));
  });
}

void remesh(Basin& basin, const std::function<void(fluid::Flow&)>& suspended) {
  const BasinSpec& spec = basin.spec;
  const double tip = basin.past_tip.front();
  RemeshReport report;
  report.before = mesh::summary_of(mesh::quality_of(basin.flow.mesh));

  // The mesh is made for a surface that is its own mirror image, and then put where the surface is.
  const std::size_t count = basin.top.x.size();
  std::vector<base::Vec2> half;
  for (std::size_t s = count / 2; s < count; ++s)
    half.push_back({basin.top.x[s], 0.5 * (basin.top.height[s] + basin.top.height[count - 1 - s])});
  fluid::Flow flow = flow_in(spec, mesh_for(spec, half, tip));
  fluid::FreeSurface top = top_of(spec, flow.mesh);
  Domain domain = domain_of(spec, flow.mesh, top, tip);
  top.height = basin.top.height;

  Basin fresh{.spec = spec, .flow = std::move(flow), .top = std::move(top), .domain = std::move(domain)};
  place(fresh, tip);
  set_outside(fresh);
  if (suspended) suspended(fresh.flow);

  const mesh::Transfer transfer(basin.flow.mesh, fresh.flow.mesh);
  const bool projects = spec.mesh.remesh && spec.mesh.remesh->transfer == TransferMethod::projection;
  for (const int c : {kVelocityX, kVelocityY, kPressure}) {
    const std::vector<double> before = component_of(basin.flow.unknown, c);
    const std::vector<double> after =
        projects && c != kPressure ? transfer.projected(before) : transfer.interpolated(before);
    for (std::size_t v = 0; v < after.size(); ++v)
      if (!fresh.flow.held[3 * v + c]) fresh.flow.unknown[3 * v + c] = after[v];
  }
  // The water on the pile has the pile's velocity.
  const auto carried = [](const fluid::Flow& one) {
    return [&one](std::int32_t v) { return one.held[3 * v + kVelocityY] != 0; };
  };
  if (const auto v = std::ranges::find_if(basin.domain.wetted, carried(basin.flow)); v != basin.domain.wetted.end())
    for (const std::int32_t w : fresh.domain.wetted)
      if (carried(fresh.flow)(w))
        fresh.flow.u(w, kVelocityY) = fresh.flow.porosity[w] / basin.flow.porosity[*v] * basin.flow.u(*v, kVelocityY);

  settle(fresh.flow, basin.solver, basin.clock.size());

  double size = 0, changed = 0;
  for (const int c : {kVelocityX, kVelocityY}) {
    const mesh::TransferError error =
        transfer.error(component_of(basin.flow.unknown, c), component_of(fresh.flow.unknown, c));
    size += error.norm * error.norm;
    changed += error.difference * error.difference;
    report.momentum_change += std::abs(error.after - error.before);
  }
  if (size > 0) {
    report.velocity_difference = std::sqrt(changed / size);
    report.energy_change = kinetic_energy_of(fresh.flow) / kinetic_energy_of(basin.flow) - 1;
    report.momentum_change /= std::sqrt(size * volume_of(basin.flow.mesh));
  }

  basin.flow = std::move(fresh.flow);
  basin.top = std::move(fresh.top);
  basin.domain = std::move(fresh.domain);
  basin.solver.factor = {};
  basin.solver.factor_rate = -1;
  basin.past = {};
  fluid::remember(basin.past, basin.flow, basin.clock.size());
  basin.past_tip.resize(1);
  basin.past_flux.resize(1);
  report.time = time_of(basin);
  report.after = mesh::summary_of(mesh::quality_of(basin.flow.mesh));
  basin.remeshes.push_back(report);
}

}  // namespace seapile::basin
