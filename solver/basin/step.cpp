#include "solver/basin/step.h"

#include <cmath>
#include <string>

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

/// The pile, surface and mesh of one step on their way to the new time.
class Way {
 public:
  explicit Way(Basin& basin)
      : basin_(basin),
        dt_(basin.spec.time.step),
        tip_(tip_at(basin.spec, static_cast<double>(basin.step + 1) * dt_)),
        second_(basin.solver.order == fluid::TimeOrder::second && basin.past.level.size() == 2),
        old_height_(basin.top.height),
        old_unknown_(basin.flow.unknown),
        old_mesh_velocity_(basin.flow.mesh_velocity) {
    const std::vector<double>& past = basin.past_tip;
    pile_velocity_ = (second_ ? 1.5 * (tip_ - past[0]) - 0.5 * (past[0] - past[1]) : tip_ - past[0]) / dt_;
    for (std::size_t k = 0; k < (second_ ? 2u : 1u); ++k) {
      fluid::SurfaceLevel level{basin.past.level[k].interstitial, {}};
      for (const std::int32_t v : basin.top.vertex) level.height.push_back(basin.past.level[k].position[v].y);
      levels_.push_back(std::move(level));
    }
  }

  double tip() const { return tip_; }
  const std::string& objection() const { return objection_; }

  void move_pile() {
    for (const std::int32_t v : basin_.domain.wetted)
      if (basin_.flow.held[3 * v + kVelocityY]) basin_.flow.u(v, kVelocityY) = pile_velocity_;
  }

  /// The surface by velocities that are extrapolated from the past, or by those of the flow.
  void move_surface(bool by_flow) {
    if (!basin_.spec.surface) return;
    std::vector<double> unknown = by_flow ? basin_.flow.unknown : basin_.past.level[0].unknown;
    if (!by_flow && second_)
      for (std::size_t i = 0; i < unknown.size(); ++i) unknown[i] = 2 * unknown[i] - basin_.past.level[1].unknown[i];
    if (basin_.spec.surface->scheme == SurfaceScheme::conservative)
      by_sections(unknown);
    else
      by_kinematics(velocities(unknown), by_flow);
  }

  /// False when there is no valid mesh for surface and pile.
  bool move_mesh() {
    objection_ = fluid::objection(basin_.top);
    if (!objection_.empty()) return false;
    place(basin_, tip_);
    const mesh::TriangleMesh& mesh = basin_.flow.mesh;
    const auto& from = basin_.past.level[0].position;
    if (const auto inversion = mesh::first_inversion(mesh, from, mesh.position)) {
      const auto& t = mesh.triangle[inversion->triangle];
      const base::Vec2 where = (1.0 / 3) * (from[t[0]] + from[t[1]] + from[t[2]]);
      objection_ = "the mesh would turn over at x = " + std::to_string(where.x) + " m, y = " + std::to_string(where.y) +
                   " m, after " + std::to_string(std::lround(100 * inversion->at)) + " % of a step's way";
      return false;
    }
    fluid::set_rates(basin_.flow, basin_.past, basin_.solver.order);
    set_outside(basin_);
    return true;
  }

  void undo() {
    basin_.top.height = old_height_;
    basin_.flow.unknown = old_unknown_;
    basin_.flow.mesh_velocity = old_mesh_velocity_;
    basin_.flow.mesh.position = basin_.past.level[0].position;
    set_outside(basin_);
  }

 private:
  void by_sections(const std::vector<double>& unknown) {
    std::vector<double> flux = fluxes(basin_.domain.flux, basin_.flow.mesh, unknown);
    if (const auto& gap = basin_.top.gap)
      for (const std::size_t s : {*gap, *gap + 1}) flux[s] -= pile_velocity_ * basin_.spec.pile->radius;
    std::vector<double> before = levels_[0].height;
    if (second_)
      for (std::size_t s = 0; s < before.size(); ++s) before[s] += (before[s] - levels_[1].height[s]) / 3;
    basin_.top.height = risen(basin_.top, flux, (second_ ? 1.5 : 1) / dt_, before);
  }

  void by_kinematics(const std::vector<base::Vec2>& velocity, bool by_flow) {
    fluid::FreeSurface& top = basin_.top;
    double lift = 0;
    if (basin_.spec.surface->volume_correction) {
      const double displaced = basin_.spec.pile ? -2 * basin_.spec.pile->radius * pile_velocity_ : 0;
      lift = fluid::volume_correction(
          top, top.scheme == fluid::KinematicScheme::upwinded ? velocity : levels_[0].interstitial, displaced);
    }
    top.height = fluid::advanced_height(
        top, levels_, dt_, lift, by_flow ? std::span<const base::Vec2>(velocity) : std::span<const base::Vec2>{});
  }

  Basin& basin_;
  double dt_, tip_;
  bool second_;
  double pile_velocity_ = 0;  ///< upwards, as the scheme in time makes it of the pile's places [m/s]
  std::vector<fluid::SurfaceLevel> levels_;
  std::vector<double> old_height_, old_unknown_;
  std::vector<base::Vec2> old_mesh_velocity_;
  std::string objection_;
};

/// Whether surface and flow are found together.
bool is_iterated(const BasinSpec& spec) {
  return spec.time.iterated && spec.surface &&
         (spec.surface->scheme == SurfaceScheme::conservative || spec.surface->scheme == SurfaceScheme::upwinded);
}

}  // namespace

std::string step(Basin& basin, base::Profile& profile) {
  fluid::Flow& flow = basin.flow;
  Way way(basin);
  const auto fail = [&](std::string why) {
    way.undo();
    return why;
  };

  way.move_pile();
  {
    const base::Stopwatch watch(profile, profile.index("domain"));
    way.move_surface(false);
    if (!way.move_mesh()) return fail(way.objection());
  }
  fluid::FollowFlow follow;
  if (is_iterated(basin.spec))
    follow = [&](fluid::Flow&) {
      way.move_surface(true);
      return way.move_mesh();
    };
  const fluid::FlowReport report = fluid::advance(flow, basin.past, basin.solver, profile, follow);
  if (!report.converged) return fail(way.objection().empty() ? report.reason : way.objection());

  if (basin.spec.pile)
    basin.pile_force =
        fluid::force_on(flow, fluid::scheme_of(basin.past, basin.solver), basin.domain.at_pile, basin.domain.of_pile);
  ++basin.step;
  basin.last_iterations = report.iterations;
  basin.iterations += report.iterations;
  fluid::remember(basin.past, flow, basin.spec.time.step);
  basin.past_tip.insert(basin.past_tip.begin(), way.tip());
  basin.past_tip.resize(basin.past.level.size());
  if (!needs_new_mesh(basin)) return {};
  const base::Stopwatch watch(profile, profile.index("remesh"));
  remesh(basin);
  return {};
}

}  // namespace seapile::basin
