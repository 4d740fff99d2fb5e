#pragma once

#include "solver/grains/contact_solver.h"
#include "solver/simulation/array.h"
#include "solver/simulation/simulation.h"

namespace seapile::simulation {

/// What a step admits about itself.
struct StepReport {
  grains::ContactReport contact;
  Objection water;      ///< why the fluid could not be advanced; empty when it was, or was not due
  bool flowed = false;  ///< it was
};

/// One time step. `keep_impulses`: so that touching_contacts() can be asked afterwards.
StepReport step(Simulation& simulation, bool keep_impulses = false);

/// Says of clock and contacts that the step is dt/2^halvings. Contacts keep their stiffness in N/m, which a law gives
/// by its sub-step: what was at rest stays at rest.
void take_halvings(Simulation& simulation, int halvings);

/// Makes the step dt/2^halvings, of the grains and of the fluid: so often was it halved. What a step hands to the next
/// in proportion to its size, kept impulses and the change of the grains' velocities, goes with it. The clock stands
/// where such a step begins.
void set_halvings(Simulation& simulation, int halvings);

/// A stretch of steps on trial: the state at its start, to go back to when a step of it is not acceptable.
class Trial {
 public:
  explicit Trial(const Simulation& simulation);
  /// The whole state returns to that of the trial's start.
  void reject(Simulation& simulation) const;
  const std::vector<Array>& start() const { return start_; }

 private:
  std::vector<Array> start_;
};

}  // namespace seapile::simulation
