// A jet that develops in time.
//
// One step, in the order of docs/formulation.md: the surface moves (with the velocity extrapolated to the new time),
// the mesh below follows with one velocity, and the flow is solved on the moved domain, with the film's tension as a
// pressure from outside.
#pragma once

#include "solver/base/clock.h"
#include "solver/base/objection.h"
#include "solver/base/profile.h"
#include "solver/fluid/advance.h"
#include "solver/fluid/jet.h"

namespace seapile::fluid {

struct JetInTime {
  Jet jet;
  Past past;
  FlowSolver solver;
  base::Clock clock;  ///< [H/U]
  std::int64_t iterations = 0;
};

/// A flat jet that flows everywhere as in the die, as if the die had ended at once. (Fluid at rest before the lip would
/// dam up.)
JetInTime started(const JetSpec& spec, const TransientMethod& method, base::InstructionSet instructions);

/// One step. Says why when it cannot be done; surface, mesh and flow are then as before.
base::Objection step(JetInTime& run, base::Profile& profile);

/// Makes the step dt/2^halvings. The past is one of the old step: what comes next begins anew, as an Euler step.
void set_halvings(JetInTime& run, int halvings);

}  // namespace seapile::fluid
