// A bed comes to rest.
#pragma once

#include <functional>
#include <optional>
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

/// The compliance of soft contacts, 1/k, falls evenly to the law's: grains that rest with the overlaps of one stiffness
/// would be thrown apart by a larger one (the thesis' bed with 5 kJ/m, by a sub-step of a sixteenth). A smaller one
/// needs none: its contacts are so damped that the grains sink.
struct Easing {
  double from;        ///< f h at its start [-]
  double time = 0.2;  ///< [s]
};

/// Steps until at rest, after the easing where there is one: the rms speed of the grains below 1e-4 m/s, and their
/// weight on the base within 0.1 %, both over 50 ms. Adds a record for each 10 ms. Throws std::runtime_error with one
/// sentence when that takes longer than `longest` [s], or when a step is objected to and smaller ones are too
/// (stepping.h).
Settled settle(Simulation& simulation, double longest, const Trying& trying, std::vector<Record>& records,
               const std::function<void(double)>& progress, const std::optional<Easing>& easing = {});

}  // namespace seapile::simulation
