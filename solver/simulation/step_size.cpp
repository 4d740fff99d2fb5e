// A step of another size.
#include "solver/simulation/step.h"

namespace seapile::simulation {
namespace {

template <class Real>
void scale_impulses(grains::ContactSystem<Real>& system, double by) {
  const auto factor = static_cast<Real>(by);
  for (auto& block : system.blocks.block)
    for (int lane = 0; lane < grains::kLanes; ++lane) {
      block.pn[lane] *= factor;
      block.pt[lane] *= factor;
    }
}

void scale_impulses(grains::AllPairs& system, double by) {
  for (grains::KeptContact& c : system.kept) {
    c.pn *= by;
    c.pt *= by;
  }
}

}  // namespace

void take_halvings(Simulation& sim, int halvings) {
  sim.law.stiffness = std::ldexp(sim.law.stiffness, sim.clock.halvings - halvings);
  sim.clock.halvings = halvings;
  sim.law.step = sim.clock.size();
}

void set_halvings(Simulation& sim, int halvings) {
  if (halvings == sim.clock.halvings) return;
  sim.stepping.calm = 0;
  sim.stepping.smallest = std::max(sim.stepping.smallest, halvings);
  const double by = std::ldexp(1, sim.clock.halvings - halvings);
  take_halvings(sim, halvings);
  std::visit([&](auto& system) { scale_impulses(system, by); }, sim.contacts);
  if (sim.pile)
    for (auto& c : sim.pile->body.contact) {
      c.pn *= by;
      c.pt *= by;
    }
  if (!sim.water) return;
  set_halvings(sim.water->basin, halvings);
  const std::vector<base::Vec2> now = velocities_of(sim);
  for (std::size_t i = 0; i < now.size(); ++i) sim.water->velocity[i] = now[i] - by * (now[i] - sim.water->velocity[i]);
}

}  // namespace seapile::simulation
