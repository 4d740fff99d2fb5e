// One time step: Algorithm 1 of the thesis (ch. 6.2), in the order that keeps volumes, mesh and grains consistent.
//
//   saturated, when a step of the fluid begins (every grain_steps steps of the grains):
//     2    pile        to its place at the end of the fluid's step            basin/step.h
//     3-6  surface and mesh follow, with one mesh velocity                    basin/step.h
//     7    porosity    of the grains' predicted places on the moved mesh      coupling/deposit.h
//     1    u, p        with drag and the grains' answer in them               coupling/exchange.h, fluid/advance.h
//     8    mesh        made anew where its triangles have become bad          basin/remesh.h
//          forces      of the fluid on the grains, for all of its step        coupling/exchange.h
//   always:
//     2    pile        along its path within the step
//     1    grains      against walls, pile and each other, under weight and the fluid's forces -> x_p, v_p, impulses
//     9    t = t + dt
//
// The thesis solves first and moves the domain afterwards, and does not say when the grains move. Within a step the
// pile is where its prescribed path has it at each sub-step, and the grains meet it there (docs/formulation.md 1).
#include "solver/simulation/step.h"

#include <cmath>

#include "solver/pile/pile.h"
#include "solver/simulation/state.h"

namespace seapile::simulation {
namespace {

/// Downward path of the pile at the end of each sub-step, counted from the start of the step [m].
std::vector<double> path_in_step(const Pile& pile, const Clock& clock, int substeps) {
  std::vector<double> path(substeps);
  const double start = pile::path(pile.spec.driving, clock.time());
  const double h = clock.size() / substeps;
  for (int k = 0; k < substeps; ++k)
    path[k] = pile::path(pile.spec.driving, clock.time() + (k + 1) * h) - start;
  return path;
}

grains::ContactReport advance_grains(Simulation& sim, bool keep_impulses) {
  // 2. Pile position -> d.
  std::vector<double> path;
  if (sim.pile) path = path_in_step(*sim.pile, sim.clock, grains::substeps(sim.law));

  // 1. Time integration of the grains against walls and pile -> x_p, v_p, impulses.
  grains::RigidBody* body = sim.pile ? &sim.pile->body : nullptr;
  const grains::ContactReport report = std::visit(
      [&](auto& system) {
        return integrate(system, sim.grains, sim.box, sim.law, body, path, keep_impulses, sim.totals, sim.team,
                         sim.profile);
      },
      sim.contacts);

  // 9. t = t + dt; the pile stands where its path has it at that time, without accumulated rounding.
  sim.clock.advance();
  if (sim.pile) {
    sim.pile->body.position.y = sim.pile->start - pile::path(sim.pile->spec.driving, sim.clock.time());
    sim.pile->travel += std::abs(path.back());
  }
  return report;
}

}  // namespace

StepReport step(Simulation& sim, bool keep_impulses) {
  StepReport report;
  if (sim.water && sim.clock.begins(sim.water->grain_steps, sim.clock.halvings)) {
    report.water = step_water(sim, [](Simulation& trial) { advance_grains(trial, false); });
    if (!report.water.empty()) return report;
    report.flowed = true;
  }
  report.contact = advance_grains(sim, keep_impulses);
  return report;
}

Trial::Trial(const Simulation& simulation) : start_(snapshot(simulation)) {}

void Trial::reject(Simulation& simulation) const { restore(simulation, start_); }

}  // namespace seapile::simulation
