#include "solver/fluid/jet_in_time.h"

#include <algorithm>

namespace seapile::fluid {
namespace {

/// The outside pressure on the surface and, where a round film ends, on the outflow.
void set_pressures(Jet& jet) {
  Flow& flow = jet.flow;
  const FreeSurface& surface = jet.surface;
  flow.open.clear();
  if (surface.tension == 0 && surface.outside_pressure == 0) return;
  const std::vector<double> kappa = curvature(surface, flow.fluid.geometry);
  const auto pressure = [&](std::size_t s) { return surface.outside_pressure - surface.tension * kappa[s]; };
  for (std::size_t s = 0; s + 1 < surface.vertex.size(); ++s)
    flow.open.push_back({surface.vertex[s + 1], surface.vertex[s], {pressure(s + 1), pressure(s)}});
  const double plug = surface.outside_pressure + surface.tension / surface.height.back();
  for (const auto& [from, to] : surface.outflow) flow.open.push_back({from, to, {plug, plug}});
}

bool turned_over(const mesh::TriangleMesh& mesh) {
  return std::ranges::any_of(mesh.triangle, [&](const auto& t) {
    return !(mesh::doubled_area(mesh.position[t[0]], mesh.position[t[1]], mesh.position[t[2]]) > 0);
  });
}

}  // namespace

JetInTime started(const JetSpec& spec, const TransientMethod& method, base::InstructionSet instructions) {
  JetInTime run;
  run.jet = flat_jet(spec);
  run.jet.surface.scheme = method.kinematic;
  run.clock.dt = method.step;
  run.solver.order = method.order == 2 ? TimeOrder::second : TimeOrder::first;
  run.solver.tolerance = method.tolerance;
  run.solver.instructions = instructions;
  run.solver.unsteadiness = 0;  // the steady state must not depend on the step
  Flow& flow = run.jet.flow;
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v)
    if (!flow.held[3 * v]) flow.unknown[3 * v] = developed(spec.geometry, flow.mesh.position[v].y);
  remember(run.past, flow, run.clock.size());
  return run;
}

base::Objection step(JetInTime& run, base::Profile& profile) {
  Flow& flow = run.jet.flow;
  FreeSurface& surface = run.jet.surface;
  const std::vector<double> old_height = surface.height;
  const auto fail = [&](base::Objection why) {
    surface.height = old_height;
    mesh::regularise(flow.mesh, surface.columns, surface.height);
    return why;
  };

  // The surface, and the mesh with it.
  {
    const base::Stopwatch watch(profile, profile.index("free surface"));
    std::vector<SurfaceLevel> levels;
    const std::size_t count = run.solver.order == TimeOrder::second ? run.past.level.size() : 1;
    for (std::size_t k = 0; k < count; ++k) {
      SurfaceLevel level{run.past.level[k].interstitial, {}};
      for (const std::int32_t v : surface.vertex) level.height.push_back(run.past.level[k].position[v].y);
      levels.push_back(std::move(level));
    }
    surface.height = advanced_height(surface, levels, run.clock.size(), 0);
    if (base::Objection why = objection(surface); !why.empty()) return fail(std::move(why));
    mesh::regularise(flow.mesh, surface.columns, surface.height);
    if (turned_over(flow.mesh)) return fail({base::Cause::mesh, "the mesh below the surface has turned over"});
    set_rates(flow, run.past, run.solver.order);
    set_pressures(run.jet);
  }

  // The flow on the moved domain.
  const FlowReport report = advance(flow, run.past, run.solver, profile);
  if (!report.converged) return fail(objection(report, run.past));
  run.iterations += report.iterations;
  run.clock.advance();
  remember(run.past, flow, run.clock.size());
  return {};
}

void set_halvings(JetInTime& run, int halvings) {
  if (halvings == run.clock.halvings) return;
  run.clock.halvings = halvings;
  run.past.dt = run.clock.size();
  run.past.level.resize(1);
}

}  // namespace seapile::fluid
