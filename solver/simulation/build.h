// From what is asked to what is run. The only place that decides what exists.
#pragma once

#include "solver/grains/deposit.h"
#include "solver/scene/spec.h"
#include "solver/simulation/run.h"
#include "solver/simulation/simulation.h"

namespace seapile::simulation {

/// Grains and walls at rest, no pile.
Simulation build_bed(const scene::BedSpec& bed, grains::Grains grains, double friction, const Execution& execution);

/// The pile above a settled bed. Throws std::invalid_argument when the bed is not one of this scene's.
Simulation build(const scene::SceneSpec& scene, const Bed& bed, const Execution& execution);

/// A bed's grains ("grains/id", "grains/position", "grains/radius") in the solver's order and back.
grains::Grains grains_of(const std::vector<Array>& arrays, double density);
std::vector<Array> arrays_of(const grains::Grains& grains);

}  // namespace seapile::simulation
