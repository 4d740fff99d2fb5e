#pragma once

#include "solver/grains/contact_solver.h"
#include "solver/simulation/array.h"
#include "solver/simulation/simulation.h"

namespace seapile::simulation {

/// What a step admits about itself.
struct StepReport {
  grains::ContactReport contact;
  std::string water;  ///< why the fluid could not be advanced, one sentence; empty when it was, or was not due
};

/// One time step. `keep_impulses`: so that touching_contacts() can be asked afterwards.
StepReport step(Simulation& simulation, bool keep_impulses = false);

/// Why a step cannot be accepted; empty when it can.
std::string objection(const Simulation& simulation, const StepReport& report);

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
