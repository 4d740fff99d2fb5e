// A bed comes to rest.
#pragma once

#include <functional>
#include <vector>

#include "solver/simulation/execution.h"
#include "solver/simulation/record.h"
#include "solver/simulation/simulation.h"

namespace seapile::simulation {

/// How a bed rests.
struct Settled {
  double time = 0;        ///< [s] until then
  double base_error = 0;  ///< of the force on the base, by the weight [-]
  double rms_speed = 0;   ///< [m/s]
};

/// Steps until at rest: the rms speed of the grains below 1e-4 m/s, and their weight on the base within 0.1 %, both
/// over 50 ms. Adds a record for each 10 ms. Throws std::runtime_error with one sentence when that takes longer than
/// `longest` [s], or when a step is objected to and smaller ones are too (stepping.h).
Settled settle(Simulation& simulation, double longest, const Trying& trying, std::vector<Record>& records,
               const std::function<void(double)>& progress);

}  // namespace seapile::simulation
