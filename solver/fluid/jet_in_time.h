// A jet that develops in time.
//
// One step, in the order of docs/formulation.md: the surface moves (with the velocity extrapolated to the new time),
// the mesh below follows with one velocity, and the flow is solved on the moved domain, with the film's tension as a
// pressure from outside.
#pragma once

#include <string>

#include "solver/base/profile.h"
#include "solver/fluid/advance.h"
#include "solver/fluid/jet.h"

namespace seapile::fluid {

struct JetInTime {
  Jet jet;
  Past past;
  FlowSolver solver;
  double dt = 0;          ///< [H/U]
  std::int64_t step = 0;  ///< steps done
  std::int64_t iterations = 0;
};

/// A flat jet that flows everywhere as in the die, as if the die had ended at once. (Fluid at rest before the lip would
/// dam up.)
JetInTime started(const JetSpec& spec, const TransientMethod& method, base::InstructionSet instructions);

/// One step. Returns one sentence when it cannot be done; the jet is then as before.
std::string step(JetInTime& run, base::Profile& profile);

}  // namespace seapile::fluid
