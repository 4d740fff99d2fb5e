#include "solver/simulation/simulation.h"

namespace seapile::simulation {

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

}  // namespace seapile::simulation
