#include "solver/simulation/jet.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "solver/base/profile.h"
#include "solver/fluid/jet_in_time.h"
#include "solver/fluid/steady.h"
#include "solver/mesh/generate.h"
#include "solver/simulation/jet_state.h"
#include "solver/simulation/objection.h"
#include "solver/simulation/stepping.h"

namespace seapile::simulation {
namespace {

/// The surface is judged outside this distance from the lip, where its slope is singular [H].
constexpr double kNearLip = 0.02;
constexpr std::int64_t kStretch = 20;  // steps between two states to which a run could go back
constexpr const char* kStepping = "jet/rejected";

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

/// A jet in time, from its state to its end.
class InTime {
 public:
  InTime(const fluid::JetSpec& spec, const fluid::TransientMethod& method, const Execution& execution,
         const std::vector<Array>& resume_from, const JetHooks& hooks)
      : spec_(spec),
        hooks_(hooks),
        run_(fluid::started(spec, method, instructions_of(execution.simd))),
        stepping_(stepping_of(resume_from, kStepping)),
        stretch_(execution.trying.stretch > 0 ? execution.trying.stretch : kStretch),
        reject_at_(execution.trying.reject_at),
        last_(std::llround(method.duration / method.step)) {
    if (!resume_from.empty()) restore(run_, resume_from);
  }

  RunResult run(base::Profile& profile) {
    begin_stretch();
    while (result_.outcome == Outcome::completed && !at_end()) {
      advance(profile);
      if (at_end() || steps_ < stretch_) continue;
      begin_stretch();
      tell();
    }
    return finished();
  }

 private:
  bool at_end() const { return run_.clock.step >= last_; }

  void begin_stretch() {
    start_ = snapshot(run_);
    if (stepping_ != Stepping{}) start_.push_back(as_array(stepping_, kStepping));
    start_calm_ = stepping_.calm;
    attempts_ = Attempts(run_.clock.halvings);
    steps_ = 0;
  }

  /// At a stretch's start: progress, checkpoints, and whether to stop.
  void tell() {
    const double time = run_.clock.time();
    if (hooks_.progress) hooks_.progress({time, time / (static_cast<double>(last_) * run_.clock.dt), std::nan("")});
    const bool stop = hooks_.stop && hooks_.stop();
    if (hooks_.checkpoint && (stop || (hooks_.checkpoint_due && hooks_.checkpoint_due()))) hooks_.checkpoint(start_);
    if (!stop) return;
    result_.outcome = Outcome::stopped;
    result_.reason = "stopped on request at t = " + std::to_string(time) + " H/U";
  }

  void resize(int halvings) {
    if (halvings == run_.clock.halvings) return;
    stepping_.calm = 0;
    stepping_.smallest = std::max(stepping_.smallest, halvings);
    set_halvings(run_, halvings);
  }

  void advance(base::Profile& profile) {
    if (!attempts_.rejected() && may_grow(stepping_, run_.clock, 1)) resize(run_.clock.halvings - 1);
    Objection why = fluid::step(run_, profile);
    if (why.empty()) why = objection(run_.jet);
    if (!why.empty()) return reject(why);
    ++steps_;
    count_accepted(stepping_, run_.clock);
    if (run_.clock.step != reject_at_) return;
    reject_at_ = -1;
    go_back();
    resize(attempts_.halvings());
  }

  /// Everything returns to the stretch's start, but for what is known of rejected steps.
  void go_back() {
    restore(run_, start_);
    stepping_.calm = start_calm_;
    steps_ = 0;
  }

  void reject(const Objection& why) {
    ++stepping_.rejected[static_cast<std::size_t>(why.cause)];
    if (attempts_.after(run_.clock.halvings, false) == Remedy::halve) {
      go_back();
      return resize(attempts_.halvings());
    }
    const std::vector<Array> rejected = snapshot(run_);
    result_.outcome = Outcome::diverged;
    result_.reason = why.why + " (at t = " + std::to_string(run_.clock.time()) + " H/U)";
    go_back();
    if (hooks_.checkpoint) hooks_.checkpoint(start_);
    if (hooks_.post_mortem) hooks_.post_mortem(rejected, result_.reason);
  }

  RunResult finished() {
    result_.time = run_.clock.time();
    std::vector<Metric>& metrics = result_.metrics;
    metrics = metrics_of(spec_, run_.jet);
    const double count = static_cast<double>(std::max<std::int64_t>(run_.clock.step, 1));
    metrics.push_back({"steps", static_cast<double>(run_.clock.step), "-", "steps done"});
    metrics.push_back(
        {"iterations_per_step", static_cast<double>(run_.iterations) / count, "-", "corrections of a step, mean"});
    metrics.push_back({"refactorisations", static_cast<double>(run_.solver.refactorisations), "-", "factors made"});
    std::ranges::move(metrics_of(stepping_, run_.clock.dt, "-", ", in H/U"), std::back_inserter(metrics));
    const FlowFrame frame = frame_of(run_.jet, result_.time);
    result_.state_hash = hash_of(frame);
    if (hooks_.frame && result_.outcome != Outcome::stopped) hooks_.frame(frame);
    return std::move(result_);
  }

  const fluid::JetSpec& spec_;
  const JetHooks& hooks_;
  fluid::JetInTime run_;
  Stepping stepping_;
  std::int64_t stretch_, reject_at_, last_;
  RunResult result_;

  // Of the stretch.
  std::vector<Array> start_;
  std::int64_t start_calm_ = 0;
  Attempts attempts_{0};
  std::int64_t steps_ = 0;
};

}  // namespace

RunResult run_jet(const fluid::JetSpec& jet, const Execution& execution, const std::vector<Array>& resume_from,
                  const JetHooks& hooks) {
  base::Profile profile;
  RunResult result;
  try {
    if (const auto* method = std::get_if<fluid::TransientMethod>(&jet.method))
      result = InTime(jet, *method, execution, resume_from, hooks).run(profile);
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
