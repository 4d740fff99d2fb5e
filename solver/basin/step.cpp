#include "solver/basin/step.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "solver/basin/pile_force.h"
#include "solver/basin/remesh.h"
#include "solver/mesh/inversion.h"

namespace seapile::basin {
namespace {

using fluid::kVelocityX;
using fluid::kVelocityY;

std::vector<base::Vec2> velocities(const std::vector<double>& unknown) {
  std::vector<base::Vec2> v(unknown.size() / 3);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = {unknown[3 * i + kVelocityX], unknown[3 * i + kVelocityY]};
  return v;
}

base::Clock after(base::Clock clock) {
  clock.advance();
  return clock;
}

/// The pile, surface and mesh of one step on their way to the new time.
class Way {
 public:
  Way(Basin& basin, const Suspension& suspension)
      : basin_(basin),
        suspension_(suspension),
        dt_(basin.clock.size()),
        tip_(tip_at(basin.spec, after(basin.clock).time())),
        second_(basin.solver.order == fluid::TimeOrder::second && basin.past.level.size() == 2),
        old_height_(basin.top.height),
        old_unknown_(basin.flow.unknown),
        old_mesh_velocity_(basin.flow.mesh_velocity),
        old_porosity_(basin.flow.porosity),
        old_porosity_rate_(basin.flow.porosity_rate) {
    const std::vector<double>& past = basin.past_tip;
    pile_velocity_ = (second_ ? 1.5 * (tip_ - past[0]) - 0.5 * (past[0] - past[1]) : tip_ - past[0]) / dt_;
    for (std::size_t k = 0; k < (second_ ? 2u : 1u); ++k) {
      fluid::SurfaceLevel level{basin.past.level[k].interstitial, {}};
      for (const std::int32_t v : basin.top.vertex) level.height.push_back(basin.past.level[k].position[v].y);
      levels_.push_back(std::move(level));
    }
  }

  double tip() const { return tip_; }
  const base::Objection& objection() const { return objection_; }

  /// The water on the pile moves with it.
  void move_pile() {
    for (const std::int32_t v : basin_.domain.wetted)
      if (basin_.flow.held[3 * v + kVelocityY]) basin_.flow.u(v, kVelocityY) = basin_.flow.porosity[v] * pile_velocity_;
  }

  /// The surface, by the velocities of the flow as it is, or by what the past says of the new time.
  void move_surface(bool by_flow) {
    if (!basin_.spec.surface) return;
    fluid::FreeSurface& top = basin_.top;
    if (!by_flow && conserves()) {
      std::vector<double> flux = basin_.past_flux[0];
      if (second_)
        for (std::size_t s = 0; s < flux.size(); ++s) flux[s] = 2 * flux[s] - basin_.past_flux[1][s];
      top.height = risen(top, balanced(std::move(flux)), rate(), before());
      return;
    }
    // Explicit schemes go by the levels alone.
    const std::vector<base::Vec2> now = by_flow ? velocities(basin_.flow.unknown) : std::vector<base::Vec2>{};
    top.height = fluid::advanced_height(top, levels_, dt_, 0, now);
    if (basin_.spec.surface->volume_correction) correct_volume(now);
  }

  /// Gives the surface what the equations of continuity are short of, when the flow is solved.
  void settle_volume(const std::vector<double>& defect) {
    if (!basin_.spec.surface || !conserves()) return;
    fluid::FreeSurface& top = basin_.top;
    std::vector<double> handed = handed_up(basin_.domain.under, defect, top.x.size());
    for (double& value : handed) value = -value;
    if (is_iterated(basin_.spec)) {
      top.height = risen(top, handed, rate(), std::vector<double>(top.height));
      place(basin_, tip_);
    }
    std::vector<double> flux = kinematic_flux(top, velocities(basin_.flow.unknown));
    for (std::size_t s = 0; s < flux.size(); ++s) flux[s] += handed[s];
    basin_.past_flux.insert(basin_.past_flux.begin(), std::move(flux));
  }

  /// False when there is no valid mesh for surface and pile.
  bool move_mesh() {
    objection_ = fluid::objection(basin_.top);
    if (!objection_.empty()) return false;
    // Under a fixed top, beside a pile that stands, every vertex stays.
    if (!basin_.spec.surface && tip_ == basin_.past_tip.front()) {
      fluid::set_rates(basin_.flow, basin_.past, basin_.solver.order);
      return true;
    }
    place(basin_, tip_);
    const mesh::TriangleMesh& mesh = basin_.flow.mesh;
    const auto& from = basin_.past.level[0].position;
    if (const auto inversion = mesh::first_inversion(mesh, from, mesh.position)) {
      const auto& t = mesh.triangle[inversion->triangle];
      const base::Vec2 where = (1.0 / 3) * (from[t[0]] + from[t[1]] + from[t[2]]);
      objection_ = {base::Cause::mesh, "the mesh would turn over at x = " + std::to_string(where.x) +
                                           " m, y = " + std::to_string(where.y) + " m, after " +
                                           std::to_string(std::lround(100 * inversion->at)) + " % of a step's way"};
      return false;
    }
    fluid::set_rates(basin_.flow, basin_.past, basin_.solver.order);
    return true;
  }

  /// What the moved mesh carries: grains, values at the pile, pressures from outside.
  void load_mesh() {
    if (suspension_.moved) suspension_.moved(basin_);
    move_pile();
    set_outside(basin_);
  }

  void undo() {
    basin_.top.height = old_height_;
    basin_.flow.unknown = old_unknown_;
    basin_.flow.mesh_velocity = old_mesh_velocity_;
    basin_.flow.porosity = old_porosity_;
    basin_.flow.porosity_rate = old_porosity_rate_;
    basin_.flow.mesh.position = basin_.past.level[0].position;
    set_outside(basin_);
  }

 private:
  bool conserves() const { return basin_.spec.surface->scheme == SurfaceScheme::conservative; }
  double rate() const { return (second_ ? 1.5 : 1) / dt_; }

  /// The heights that the scheme in time looks back to.
  std::vector<double> before() const {
    std::vector<double> height = levels_[0].height;
    if (second_)
      for (std::size_t s = 0; s < height.size(); ++s) height[s] += (height[s] - levels_[1].height[s]) / 3;
    return height;
  }

  /// Flux that the pile displaces [m2/s].
  double displaced() const { return basin_.spec.pile ? -2 * basin_.spec.pile->radius * pile_velocity_ : 0; }

  /// Fluxes whose sum is what the pile displaces: what extrapolation lacks of it is spread evenly.
  std::vector<double> balanced(std::vector<double> flux) const {
    const fluid::FreeSurface& top = basin_.top;
    double sum = 0;
    for (const double f : flux) sum += f;
    const double lift = (displaced() - sum) / fluid::width_of(top);
    for (std::size_t s = 0; s + 1 < flux.size(); ++s) {
      if (top.gap == s) continue;
      const double half = 0.5 * lift * (top.x[s + 1] - top.x[s]);
      flux[s] += half;
      flux[s + 1] += half;
    }
    return flux;
  }

  /// Area below the surface, above the bottom [m2].
  double area_below(const std::vector<double>& height) const {
    const fluid::FreeSurface& top = basin_.top;
    double area = 0;
    for (std::size_t s = 0; s + 1 < height.size(); ++s)
      if (top.gap != s) area += 0.5 * (top.x[s + 1] - top.x[s]) * (height[s] + height[s + 1]);
    return area;
  }

  /// Thesis (3.17): lifts v_y by as much everywhere as makes the surface rise by what the pile displaces. Heights are
  /// linear in the lift.
  void correct_volume(std::span<const base::Vec2> now) {
    fluid::FreeSurface& top = basin_.top;
    const bool implicit = second_ && top.scheme == fluid::KinematicScheme::upwinded;
    // Explicit schemes step from the last level to the next, over which the pile moves by what its places say.
    const double entered = basin_.spec.pile ? 2 * basin_.spec.pile->radius * (basin_.past_tip[0] - tip_) : 0;
    const double wanted =
        implicit ? area_below(before()) + displaced() / rate() : area_below(levels_[0].height) + entered;
    constexpr double kLift = 1;  // [m/s]
    const std::vector<double> lifted = fluid::advanced_height(top, levels_, dt_, kLift, now);
    const double share = (wanted - area_below(top.height)) / (area_below(lifted) - area_below(top.height));
    for (std::size_t s = 0; s < lifted.size(); ++s) top.height[s] += share * (lifted[s] - top.height[s]);
  }

  Basin& basin_;
  const Suspension& suspension_;
  double dt_, tip_;
  bool second_;
  double pile_velocity_ = 0;  ///< upwards, as the scheme in time makes it of the pile's places [m/s]
  std::vector<fluid::SurfaceLevel> levels_;
  std::vector<double> old_height_, old_unknown_;
  std::vector<base::Vec2> old_mesh_velocity_;
  std::vector<double> old_porosity_, old_porosity_rate_;
  base::Objection objection_;
};

}  // namespace

base::Objection step(Basin& basin, base::Profile& profile, const Suspension& suspension) {
  fluid::Flow& flow = basin.flow;
  Way way(basin, suspension);
  const auto fail = [&](base::Objection why) {
    way.undo();
    return why;
  };

  {
    const base::Stopwatch watch(profile, profile.index("domain"));
    way.move_surface(false);
    if (!way.move_mesh()) return fail(way.objection());
  }
  way.load_mesh();
  fluid::FollowFlow follow;
  if (is_iterated(basin.spec))
    follow = [&](fluid::Flow&) {
      way.move_surface(true);
      if (!way.move_mesh()) return false;
      way.load_mesh();
      return true;
    };
  const fluid::FlowReport report = fluid::advance(flow, basin.past, basin.solver, profile, follow);
  if (!report.converged) return fail(way.objection().empty() ? fluid::objection(report, basin.past) : way.objection());

  if (basin.spec.pile) feel_pile(basin, fluid::scheme_of(basin.past, basin.solver));
  if (suspension.solved) suspension.solved(basin);
  way.settle_volume(report.defect);
  basin.clock.advance();
  basin.last_iterations = report.iterations;
  basin.iterations += report.iterations;
  fluid::remember(basin.past, flow, basin.clock.size());
  basin.past_tip.insert(basin.past_tip.begin(), way.tip());
  basin.past_tip.resize(basin.past.level.size());
  basin.past_flux.resize(std::min(basin.past_flux.size(), basin.past.level.size()));
  if (!needs_new_mesh(basin)) return {};
  const base::Stopwatch watch(profile, profile.index("remesh"));
  remesh(basin, suspension.remeshed);
  return {};
}

}  // namespace seapile::basin
