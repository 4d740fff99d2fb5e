#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "solver/base/clock.h"
#include "solver/base/profile.h"
#include "solver/base/vec2.h"
#include "solver/grains/brute_force.h"
#include "solver/grains/contact_solver.h"
#include "solver/grains/grains.h"
#include "solver/grains/rigid_body.h"
#include "solver/scene/spec.h"
#include "solver/simulation/execution.h"
#include "solver/simulation/stepping.h"
#include "solver/simulation/water.h"

namespace seapile::simulation {

using base::Clock;

/// The pile in the run: a body of the contact problem with a prescribed motion.
struct Pile {
  pile::PileSpec spec;
  grains::RigidBody body;
  double start = 0;   ///< height of the tip at t = 0 [m]
  double travel = 0;  ///< length of its path so far [m]
};

/// What has been gathered since the last record; part of the state, so that a resumed run writes the same records.
struct Gathering {
  double time = 0;            ///< of the last record [s]
  double travel = 0;          ///< of the pile at the last record [m]
  double position = 0;        ///< height of the tip at the last record [m]
  double residual = 0;        ///< sum of squared residuals of the steps since [m2/s2]
  double overlap = 0;         ///< largest overlap of a step since [-]
  std::int64_t steps = 0;     ///< since the last record
};

/// One run: everything that a step reads and writes. Movable; no pointer into itself.
struct Simulation {
  Clock clock;
  Stepping stepping;
  grains::Box box;
  grains::ContactLaw law;
  grains::Grains grains;
  std::variant<grains::ContactSystem<float>, grains::ContactSystem<double>, grains::AllPairs> contacts;
  std::optional<Pile> pile;              ///< absent: a bed
  std::optional<Water> water;            ///< absent: a dry scene
  grains::ContactTotals totals;          ///< impulses since the last record; work since the start
  Gathering gathering;
  double surface = 0;                    ///< of the initial bed [m]; depths count from here
  std::vector<base::Vec2> origin;        ///< places at the start [m], (count)

  grains::Team team;                     ///< how it is executed: no part of the state
  base::Profile profile;
};

/// Velocities of the grains [m/s], (grains).
std::vector<base::Vec2> velocities_of(const Simulation& simulation);

}  // namespace seapile::simulation
