// A step of the water with the grains in it.
#include <algorithm>
#include <numbers>
#include <utility>

#include "solver/basin/step.h"
#include "solver/coupling/moved_solid.h"
#include "solver/simulation/simulation.h"
#include "solver/simulation/water.h"

namespace seapile::simulation {
namespace {

std::span<const grains::Disc> discs_of(const Simulation& sim) { return {sim.grains.disc.data(), sim.grains.count()}; }

void gather(Water& water, const coupling::OnMesh& on) {
  WaterGathering& g = water.gathering;
  ++g.steps;
  for (std::size_t i = 0; i < water.drag.size(); ++i) g.grain_force = g.grain_force + water.drag[i] + water.pressure[i];
  g.lowest_porosity = std::min(g.lowest_porosity, on.porosity.lowest);
  g.clipped_volume = std::max(g.clipped_volume, on.porosity.clipped);
  if (!water.basin.spec.pile) return;
  g.tip_force = g.tip_force + water.basin.tip_force;
  g.sleeve_force = g.sleeve_force + water.basin.sleeve_force;
  const basin::PorePressure pore = basin::pore_pressure(water.basin);
  g.face += pore.face;
  g.shoulder += pore.shoulder;
  if (!pore.sleeve) return;
  g.sleeve += *pore.sleeve;
  ++g.sleeve_steps;
}

/// The grains as the fluid's step expects them at its end, if its exchange is none.
struct Outlook {
  std::vector<grains::Disc> disc;
  std::vector<base::Vec2> velocity;  ///< v* [m/s], (grains)
};

/// A step of the fluid, once or twice.
class WaterStep {
 public:
  explicit WaterStep(Simulation& sim)
      : sim_(sim),
        water_(*sim.water),
        dt_(water_.basin.clock.size()),
        in_deposit_(sim.profile.index("porosity")),
        in_exchange_(sim.profile.index("exchange")),
        velocity_(velocities_of(sim)) {
    const coupling::OnMesh& expected = water_.expected;
    {
      const base::Stopwatch watch(sim_.profile, in_deposit_);
      const std::vector<double> solid =
          coupling::moved_solid(water_.basin.flow.mesh, expected.vertex_volume, expected.deposit, expected.solid,
                                expected.disc, discs_of(sim_));
      water_.basin.past.level[0].porosity =
          coupling::porosity(solid, expected.vertex_volume, water_.coupling.porosity.least).phi;
    }
    const base::Stopwatch watch(sim_.profile, in_exchange_);
    drag_ = coupling::drag_coefficients(water_.coupling.drag, water_.basin.flow.fluid, water_.around,
                                        expected.deposit.immersed, discs_of(sim_), velocity_);
    for (std::size_t i = 0; i < drag_.size(); ++i)
      drag_[i] *= sim_.grains.mass[i] / (sim_.grains.mass[i] + dt_ * drag_[i]);
  }

  /// From where the grains are: contacts and weight do what they did in the last step.
  Outlook from_last_step() const {
    return ahead(velocity_, [&](std::size_t i, base::Vec2 v, double per_mass) {
      return Next{2 * v - water_.velocity[i] - per_mass * water_.drag[i],
                  dt_ * (v - per_mass * (water_.drag[i] + water_.pressure[i]))};
    });
  }

  /// From where the grains came with the forces of a first solve.
  Outlook from_trial(const coupling::Forces& first) const {
    return ahead(velocities_of(sim_), [&](std::size_t i, base::Vec2 v, double per_mass) {
      return Next{v - per_mass * first.drag[i], (-dt_ * per_mass) * (first.drag[i] + first.pressure[i])};
    });
  }

  /// Advances the fluid. Empty when it is done; otherwise nothing has changed.
  base::Objection solve(Outlook ahead) {
    const coupling::Suspended suspended = {sim_.grains.mass, drag_, ahead.velocity};
    then_.disc = std::move(ahead.disc);
    renewed_.reset();
    basin::Suspension suspension;
    suspension.moved = [&](basin::Basin& moved) {
      {
        const base::Stopwatch watch(sim_.profile, in_deposit_);
        then_ = coupling::found_on(moved.flow.mesh, water_.location, std::move(then_.disc),
                                   water_.coupling.porosity.kernel, sim_.team.instructions, sim_.team.crew.get());
      }
      const base::Stopwatch watch(sim_.profile, in_exchange_);
      const auto load = coupling::load(then_.deposit, suspended, dt_, moved.flow.mesh.vertices());
      std::vector<double> solid(load.size());
      std::ranges::transform(load, solid.begin(), &coupling::Load::solid);
      coupling::fill(then_, std::move(solid), water_.coupling.porosity.least);
      moved.flow.porosity = then_.porosity.phi;
      coupling::set_porosity_rate(moved.flow, moved.past, moved.solver.order,
                                  {then_.vertex_volume, water_.expected.vertex_volume});
      coupling::put_grains(moved.flow, load, then_.vertex_volume, then_.porosity.kept);
    };
    suspension.solved = [&](const basin::Basin& solved) {
      const base::Stopwatch watch(sim_.profile, in_exchange_);
      forces_ = coupling::forces_on(then_.deposit, solved.flow, then_.vertex_volume, then_.porosity.kept, suspended);
    };
    suspension.remeshed = [&](fluid::Flow& flow) {
      water_.location = coupling::Location(flow.mesh);
      const auto disc = discs_of(sim_);
      const coupling::OnMesh from = found(flow.mesh, {disc.begin(), disc.end()});
      renewed_ = found(flow.mesh, then_.disc);
      flow.porosity = renewed_->porosity.phi;
      for (std::size_t v = 0; v < flow.porosity.size(); ++v)
        flow.porosity_rate[v] = (flow.porosity[v] - from.porosity.phi[v]) / dt_;
    };
    return basin::step(water_.basin, sim_.profile, suspension);
  }

  const coupling::Forces& forces() const { return forces_; }

  /// Gives the grains the forces of the solve.
  void push() {
    const std::size_t count = sim_.grains.count();
    sim_.grains.push.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double radius = sim_.grains.disc[i].radius, area = std::numbers::pi * radius * radius,
                   outside = std::max(0.0, 1 - then_.deposit.immersed[i] / area);
      sim_.grains.push[i] = (1 / sim_.grains.mass[i]) * (forces_.drag[i] + forces_.pressure[i]) -
                            base::Vec2{0, water_.buoyancy * outside};
    }
  }

  void finish() {
    push();
    water_.drag = std::move(forces_.drag);
    water_.pressure = std::move(forces_.pressure);
    water_.velocity = std::move(velocity_);
    gather(water_, then_);
    water_.location.spare.push_back(std::move(water_.expected.deposit));
    if (renewed_) {
      water_.expected = std::move(*renewed_);
      water_.around = coupling::surroundings(water_.basin.flow, water_.expected.deposit);
    } else {
      water_.expected = std::move(then_);
      water_.around = std::move(forces_.around);
    }
  }

 private:
  coupling::OnMesh found(const mesh::TriangleMesh& mesh, std::vector<grains::Disc> disc) {
    const base::Stopwatch watch(sim_.profile, in_deposit_);
    return coupling::put_on(mesh, water_.location, std::move(disc), water_.coupling.porosity, sim_.team.instructions,
                            sim_.team.crew.get());
  }
  /// Of one grain: v* and its way from where it is.
  struct Next {
    base::Vec2 velocity, way;
  };
  /// `next`: of a grain with its velocity and dt/m.
  template <class F>
  Outlook ahead(const std::vector<base::Vec2>& velocity, const F& next) const {
    const auto disc = discs_of(sim_);
    Outlook ahead{std::vector<grains::Disc>(disc.size()), std::vector<base::Vec2>(disc.size())};
    for (std::size_t i = 0; i < disc.size(); ++i) {
      const Next after = next(i, velocity[i], dt_ / sim_.grains.mass[i]);
      ahead.disc[i] = {disc[i].x + after.way.x, disc[i].y + after.way.y, disc[i].radius, 0};
      ahead.velocity[i] = after.velocity;
    }
    return ahead;
  }

  Simulation& sim_;
  Water& water_;
  double dt_;
  std::size_t in_deposit_, in_exchange_;
  std::vector<base::Vec2> velocity_;  ///< of the grains at the start
  std::vector<double> drag_;          ///< gamma_e
  coupling::OnMesh then_;
  std::optional<coupling::OnMesh> renewed_;  ///< on a new mesh, if one was made
  coupling::Forces forces_;
};

/// What a solve that keeps its mesh changes of a basin.
struct BasinBefore {
  explicit BasinBefore(const basin::Basin& b)
      : flow(b.flow), top(b.top), past(b.past), past_tip(b.past_tip), past_flux(b.past_flux), clock(b.clock) {}
  void put_back(basin::Basin& b) const {
    b.flow = flow;
    b.top = top;
    b.past = past;
    b.past_tip = past_tip;
    b.past_flux = past_flux;
    b.clock = clock;
  }
  fluid::Flow flow;
  fluid::FreeSurface top;
  fluid::Past past;
  std::vector<double> past_tip;
  std::vector<std::vector<double>> past_flux;
  base::Clock clock;
};

/// What the grains are before a trial of theirs.
struct GrainsBefore {
  explicit GrainsBefore(const Simulation& s)
      : clock(s.clock), grains(s.grains), contacts(s.contacts), pile(s.pile), totals(s.totals) {}
  void put_back(Simulation& s) const {
    s.clock = clock;
    s.grains = grains;
    s.contacts = contacts;
    s.pile = pile;
    s.totals = totals;
  }
  Clock clock;
  grains::Grains grains;
  decltype(Simulation::contacts) contacts;
  std::optional<Pile> pile;
  grains::ContactTotals totals;
};

/// Solves, lets the grains go on trial, and solves again with what they did.
base::Objection solve_twice(Simulation& sim, WaterStep& step, const std::function<void(Simulation&)>& advance_grains) {
  basin::Basin& basin = sim.water->basin;
  const BasinBefore basin_before(basin);
  const auto remesh = std::exchange(basin.spec.mesh.remesh, std::nullopt);
  base::Objection why = step.solve(step.from_last_step());
  basin.spec.mesh.remesh = remesh;
  if (!why.empty()) return why;

  const GrainsBefore grains_before(sim);
  step.push();
  for (int k = 0; k < sim.water->grain_steps; ++k) advance_grains(sim);
  const Outlook ahead = step.from_trial(step.forces());
  grains_before.put_back(sim);
  basin_before.put_back(basin);
  return step.solve(ahead);
}

}  // namespace

base::Objection step_water(Simulation& sim, const std::function<void(Simulation&)>& advance_grains) {
  WaterStep step(sim);
  const base::Objection why = sim.water->coupling.scheme == coupling::Scheme::once
                                  ? step.solve(step.from_last_step())
                                  : solve_twice(sim, step, advance_grains);
  if (why.empty()) step.finish();
  return why;
}

}  // namespace seapile::simulation
