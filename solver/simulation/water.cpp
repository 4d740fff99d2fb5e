#include "solver/simulation/water.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "solver/basin/remesh.h"
#include "solver/basin/step.h"
#include "solver/coupling/exchange.h"
#include "solver/coupling/porosity.h"
#include "solver/simulation/simulation.h"

namespace seapile::simulation {
namespace {

std::vector<base::Vec2> velocities_of(const Simulation& sim) {
  std::vector<base::Vec2> velocity(sim.grains.count());
  std::visit(
      [&](const auto& system) {
        for (std::size_t i = 0; i < velocity.size(); ++i) {
          const auto& m = system.motion(static_cast<std::int32_t>(i));
          velocity[i] = {static_cast<double>(m.vx), static_cast<double>(m.vy)};
        }
      },
      sim.contacts);
  return velocity;
}

std::span<const grains::Disc> discs_of(const Simulation& sim) { return {sim.grains.disc.data(), sim.grains.count()}; }

/// The grains on one mesh.
struct OnMesh {
  coupling::Deposit deposit;
  std::vector<double> volume;  ///< of the vertices
  coupling::Porosity porosity;
};
OnMesh put_on(const mesh::TriangleMesh& mesh, coupling::Location& location, std::span<const grains::Disc> disc,
              const coupling::PorositySpec& spec, base::InstructionSet instructions, base::Crew* crew) {
  OnMesh on{
      coupling::deposit(mesh, location, disc, spec.kernel, crew, instructions), coupling::vertex_volume(mesh), {}};
  on.porosity = coupling::porosity(coupling::solid_volume(on.deposit, on.volume.size()), on.volume, spec.least);
  return on;
}

double immersed_share(const coupling::Deposit& deposit, std::span<const grains::Disc> disc) {
  double inside = 0, all = 0;
  for (std::size_t i = 0; i < disc.size(); ++i) {
    inside += deposit.immersed[i];
    all += std::numbers::pi * disc[i].radius * disc[i].radius;
  }
  return inside / all;
}

void gather(Water& water, const OnMesh& on, std::span<const grains::Disc> disc) {
  WaterGathering& g = water.gathering;
  ++g.steps;
  for (std::size_t i = 0; i < water.drag.size(); ++i) g.grain_force = g.grain_force + water.drag[i] + water.pressure[i];
  g.lowest_porosity = std::min(g.lowest_porosity, on.porosity.lowest);
  g.clipped_volume = std::max(g.clipped_volume, on.porosity.clipped);
  g.immersed = immersed_share(on.deposit, disc);
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

}  // namespace

basin::BasinSpec basin_of(const scene::SceneSpec& scene, double tip) {
  const scene::FluidSpec& fluid = *scene.fluid;
  basin::BasinSpec basin;
  basin.width = scene.bed.domain.width;
  basin.depth = fluid.depth;
  basin.gravity = scene.bed.domain.gravity;
  basin.density = fluid.density;
  basin.viscosity = fluid.density * fluid.kinematic_viscosity;
  basin.walls = fluid.walls;
  basin.bottom = fluid.bottom;
  basin.surface = fluid.surface;
  if (scene.pile)
    basin.pile = basin::BasinPileSpec{scene.pile->radius, scene.pile->tip, scene.pile->driving, fluid.depth - tip};
  basin.mesh = {basin::UnstructuredMesh{fluid.mesh.size, fluid.mesh.pile_size, fluid.mesh.growth}, fluid.mesh.motion,
                fluid.mesh.remesh};
  basin.time.step = fluid.time.step;
  basin.time.order = fluid.time.order;
  basin.time.tolerance = fluid.time.tolerance;
  basin.time.rate = fluid.time.rate;
  // The grains are found once on the moved domain; waves of the surface are slow beside the step.
  basin.time.iterated = false;
  return basin;
}

Water water_around(const Simulation& sim, const basin::BasinSpec& spec, const coupling::CouplingSpec& coupling,
                   double grain_density) {
  basin::Basin basin = basin::filled(spec, sim.team.instructions);
  coupling::Location location(basin.flow.mesh);
  Water water{.basin = std::move(basin), .coupling = coupling, .location = std::move(location)};
  water.grain_steps = static_cast<int>(std::lround(spec.time.step / sim.clock.dt));
  water.buoyancy = spec.density / grain_density * spec.gravity;
  water.drag.assign(sim.grains.count(), {});
  water.pressure.assign(sim.grains.count(), {});
  water.velocity = velocities_of(sim);
  // The mesh's first porosity is that of the grains.
  OnMesh on = put_on(water.basin.flow.mesh, water.location, discs_of(sim), water.coupling.porosity,
                     sim.team.instructions, nullptr);
  water.basin.flow.porosity = on.porosity.phi;
  water.basin.past.level[0].porosity = std::move(on.porosity.phi);
  return water;
}

namespace {

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
        dt_(water_.basin.spec.time.step),
        in_deposit_(sim.profile.index("porosity")),
        in_exchange_(sim.profile.index("exchange")),
        velocity_(velocities_of(sim)) {
    now_ = found(water_.basin.flow.mesh, discs_of(sim_));
    water_.basin.flow.porosity = now_.porosity.phi;
    water_.basin.past.level[0].porosity = now_.porosity.phi;
    const base::Stopwatch watch(sim_.profile, in_exchange_);
    drag_ =
        coupling::drag_coefficients(water_.coupling.drag, water_.basin.flow, now_.deposit, discs_of(sim_), velocity_);
    for (std::size_t i = 0; i < drag_.size(); ++i)
      drag_[i] *= sim_.grains.mass[i] / (sim_.grains.mass[i] + dt_ * drag_[i]);
  }

  /// From where the grains are: contacts and weight do what they did in the last step.
  Outlook from_last_step() const {
    Outlook ahead = outlook();
    for (std::size_t i = 0; i < drag_.size(); ++i) {
      const double inverse = 1 / sim_.grains.mass[i];
      ahead.velocity[i] = 2 * velocity_[i] - water_.velocity[i] - (dt_ * inverse) * water_.drag[i];
      move(ahead.disc[i], dt_ * (velocity_[i] - (dt_ * inverse) * (water_.drag[i] + water_.pressure[i])));
    }
    return ahead;
  }

  /// From where the grains came with the forces of a first solve.
  Outlook from_trial(const coupling::Forces& first) const {
    Outlook ahead = outlook();
    const std::vector<base::Vec2> velocity = velocities_of(sim_);
    for (std::size_t i = 0; i < drag_.size(); ++i) {
      const double inverse = 1 / sim_.grains.mass[i];
      ahead.velocity[i] = velocity[i] - (dt_ * inverse) * first.drag[i];
      move(ahead.disc[i], (-dt_ * dt_ * inverse) * (first.drag[i] + first.pressure[i]));
    }
    return ahead;
  }

  /// Advances the fluid. Empty when it is done; otherwise nothing has changed.
  std::string solve(const Outlook& ahead) {
    const coupling::Suspended suspended = {sim_.grains.mass, drag_, ahead.velocity};
    basin::Suspension suspension;
    suspension.moved = [&](basin::Basin& moved) {
      then_ = found(moved.flow.mesh, ahead.disc);
      const base::Stopwatch watch(sim_.profile, in_exchange_);
      moved.flow.porosity = then_.porosity.phi;
      coupling::set_porosity_rate(moved.flow, moved.past, moved.solver.order);
      coupling::put_grains(moved.flow, then_.deposit, then_.volume, then_.porosity.kept, suspended, dt_);
    };
    suspension.solved = [&](const basin::Basin& solved) {
      const base::Stopwatch watch(sim_.profile, in_exchange_);
      forces_ = coupling::forces_on(then_.deposit, solved.flow, then_.volume, then_.porosity.kept, suspended);
    };
    suspension.remeshed = [&](fluid::Flow& flow) {
      water_.location = coupling::Location(flow.mesh);
      const OnMesh from = found(flow.mesh, discs_of(sim_)), to = found(flow.mesh, ahead.disc);
      flow.porosity = to.porosity.phi;
      for (std::size_t v = 0; v < flow.porosity.size(); ++v)
        flow.porosity_rate[v] = (to.porosity.phi[v] - from.porosity.phi[v]) / dt_;
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
    gather(water_, then_, discs_of(sim_));
    water_.location.spare.push_back(std::move(now_.deposit));
    water_.location.spare.push_back(std::move(then_.deposit));
  }

 private:
  OnMesh found(const mesh::TriangleMesh& mesh, std::span<const grains::Disc> disc) {
    const base::Stopwatch watch(sim_.profile, in_deposit_);
    return put_on(mesh, water_.location, disc, water_.coupling.porosity, sim_.team.instructions, sim_.team.crew.get());
  }
  Outlook outlook() const {
    const auto disc = discs_of(sim_);
    return {{disc.begin(), disc.end()}, std::vector<base::Vec2>(disc.size())};
  }
  static void move(grains::Disc& disc, base::Vec2 way) {
    disc.x += way.x;
    disc.y += way.y;
  }

  Simulation& sim_;
  Water& water_;
  double dt_;
  std::size_t in_deposit_, in_exchange_;
  std::vector<base::Vec2> velocity_;  ///< of the grains at the start
  std::vector<double> drag_;          ///< gamma_e
  OnMesh now_, then_;
  coupling::Forces forces_;
};

/// What a solve that keeps its mesh changes of a basin.
struct BasinBefore {
  explicit BasinBefore(const basin::Basin& b)
      : flow(b.flow), top(b.top), past(b.past), past_tip(b.past_tip), past_flux(b.past_flux), step(b.step) {}
  void put_back(basin::Basin& b) const {
    b.flow = flow;
    b.top = top;
    b.past = past;
    b.past_tip = past_tip;
    b.past_flux = past_flux;
    b.step = step;
  }
  fluid::Flow flow;
  fluid::FreeSurface top;
  fluid::Past past;
  std::vector<double> past_tip;
  std::vector<std::vector<double>> past_flux;
  std::int64_t step;
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
std::string solve_twice(Simulation& sim, WaterStep& step, const std::function<void(Simulation&)>& advance_grains) {
  basin::Basin& basin = sim.water->basin;
  const BasinBefore basin_before(basin);
  const auto remesh = std::exchange(basin.spec.mesh.remesh, std::nullopt);
  std::string why = step.solve(step.from_last_step());
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

std::string step_water(Simulation& sim, const std::function<void(Simulation&)>& advance_grains) {
  WaterStep step(sim);
  const std::string why = sim.water->coupling.scheme == coupling::Scheme::once ? step.solve(step.from_last_step())
                                                                               : solve_twice(sim, step, advance_grains);
  if (why.empty()) step.finish();
  return why;
}

}  // namespace seapile::simulation
