#include "solver/simulation/jet.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/base/profile.h"
#include "solver/fluid/jet_in_time.h"
#include "solver/fluid/steady.h"
#include "solver/mesh/generate.h"
#include "solver/simulation/jet_state.h"

namespace seapile::simulation {
namespace {

/// The surface is judged outside this distance from the lip, where its slope is singular [H].
constexpr double kNearLip = 0.02;
/// Progress of a transient jet is told, and a checkpoint may be sealed, every so many steps.
constexpr std::int64_t kStepsBetweenLooks = 20;

std::vector<base::Vec2> interstitial(const fluid::Flow& flow) {
  std::vector<base::Vec2> v(flow.mesh.vertices());
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = (1 / flow.porosity[i]) * base::Vec2{flow.unknown[3 * i], flow.unknown[3 * i + 1]};
  return v;
}

std::vector<Metric> metrics_of(const fluid::JetSpec& spec, const fluid::Jet& jet) {
  const std::vector<base::Vec2> v = interstitial(jet.flow);
  const auto [lowest, highest] = std::ranges::minmax_element(jet.surface.height);
  return {{"swell_ratio", jet.surface.height.back(), "-", "height of the jet at its end, chi = h(L2)/H"},
          {"lowest_height", *lowest, "-", "lowest height of the surface, in H"},
          {"highest_height", *highest, "-", "highest height of the surface, in H"},
          {"surface_leak", fluid::largest_leak(jet.surface, v, kNearLip), "-",
           "largest |u.n|/U on the surface, from 0.02 H behind the lip"},
          {"mass_defect", fluid::flux_through(jet.flow, fluid::kOutflow) / fluid::die_flux(spec) - 1, "-",
           "flux through the jet's end over that through the die, less 1"},
          {"vertices", static_cast<double>(jet.flow.mesh.vertices()), "-", "vertices of the mesh"},
          {"triangles", static_cast<double>(jet.flow.mesh.triangles()), "-", "triangles of the mesh"}};
}

RunResult run_steady(const fluid::JetSpec& spec, const JetHooks& hooks, base::Profile& profile) {
  RunResult result;
  fluid::Jet jet = [&] {
    const base::Stopwatch watch(profile, profile.index("mesh"));
    return fluid::flat_jet(spec);
  }();
  fluid::NewtonReport report;
  {
    const base::Stopwatch watch(profile, profile.index("Newton"));
    report = fluid::solve_steady(jet.flow, &jet.surface);
  }
  if (!report.converged) {
    result.outcome = Outcome::diverged;
    result.reason = report.reason;
  }
  result.metrics = metrics_of(spec, jet);
  result.metrics.push_back(
      {"iterations", static_cast<double>(report.iterations), "-", "iterations of Newton's method"});
  result.metrics.push_back(
      {"residual", report.residual, "-", "largest residual of an equation before the last iteration"});
  const FlowFrame frame = frame_of(jet, 0);
  result.state_hash = hash_of(frame);
  if (hooks.frame) hooks.frame(frame);
  return result;
}

RunResult run_in_time(const fluid::JetSpec& spec, const fluid::TransientMethod& method, const Execution& execution,
                      const std::vector<Array>& resume_from, const JetHooks& hooks, base::Profile& profile) {
  RunResult result;
  fluid::JetInTime run = fluid::started(spec, method, instructions_of(execution.simd));
  if (!resume_from.empty()) restore(run, resume_from);
  const auto steps = static_cast<std::int64_t>(std::llround(method.duration / method.step));
  while (run.step < steps) {
    if (std::string why = fluid::step(run, profile); !why.empty()) {
      result.outcome = Outcome::diverged;
      result.reason = why + " (at t = " + std::to_string(static_cast<double>(run.step) * run.dt) + " H/U)";
      if (hooks.checkpoint) hooks.checkpoint(snapshot(run));
      break;
    }
    if (run.step == steps || run.step % kStepsBetweenLooks != 0) continue;
    const double time = static_cast<double>(run.step) * run.dt;
    if (hooks.progress) hooks.progress({time, time / method.duration, std::nan("")});
    const bool stop = hooks.stop && hooks.stop();
    if (hooks.checkpoint && (stop || (hooks.checkpoint_due && hooks.checkpoint_due()))) hooks.checkpoint(snapshot(run));
    if (stop) {
      result.outcome = Outcome::stopped;
      result.reason = "stopped on request at t = " + std::to_string(time) + " H/U";
      break;
    }
  }
  result.time = static_cast<double>(run.step) * run.dt;
  result.metrics = metrics_of(spec, run.jet);
  const double count = static_cast<double>(std::max<std::int64_t>(run.step, 1));
  result.metrics.push_back({"steps", static_cast<double>(run.step), "-", "steps done"});
  result.metrics.push_back(
      {"iterations_per_step", static_cast<double>(run.iterations) / count, "-", "corrections of a step, mean"});
  result.metrics.push_back({"refactorisations", static_cast<double>(run.solver.refactorisations), "-", "factors made"});
  const FlowFrame frame = frame_of(run.jet, result.time);
  result.state_hash = hash_of(frame);
  if (hooks.frame && result.outcome != Outcome::stopped) hooks.frame(frame);
  return result;
}

}  // namespace

RunResult run_jet(const fluid::JetSpec& jet, const Execution& execution, const std::vector<Array>& resume_from,
                  const JetHooks& hooks) {
  base::Profile profile;
  RunResult result;
  try {
    if (const auto* method = std::get_if<fluid::TransientMethod>(&jet.method))
      result = run_in_time(jet, *method, execution, resume_from, hooks, profile);
    else
      result = run_steady(jet, hooks, profile);
  } catch (const mesh::NoMesh& error) {
    result.outcome = Outcome::diverged;
    result.reason = error.what();
  }
  for (const auto& e : profile.entries()) result.profile.push_back({e.part, e.seconds, e.calls});
  return result;
}

}  // namespace seapile::simulation
