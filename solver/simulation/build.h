// From what is asked to what is run. The only place that decides what exists.
#pragma once

#include <functional>

#include "solver/grains/deposit.h"
#include "solver/scene/spec.h"
#include "solver/simulation/run.h"
#include "solver/simulation/simulation.h"

namespace seapile::simulation {

/// Grains and walls at rest, no pile.
Simulation build_bed(const scene::BedSpec& bed, grains::Grains grains, double friction, const Execution& execution);

/// Whether a drive's soft contacts are of another stiffness than those on which its bed came to rest. (Non-smooth ones
/// have none: what soft ones leave of overlaps is taken back at `correction`, and unfinished sweeps do not let a bed
/// rest.)
bool has_other_contacts(const scene::SceneSpec& scene);

/// The pile above a settled bed, at its start or where `resume_from` (a snapshot of the same scene) left it. The grains
/// of a scene with other contacts than the bed's, or saturated, are settled once more on these and under their weight
/// in the fluid, which is put around them. Throws std::invalid_argument when the bed or the snapshot is not one of this
/// scene's, std::runtime_error when the grains do not settle, and mesh::NoMesh. Parts that the scene's analysis or its
/// `model` leaves out are not built. `settling`: called every 10 ms of settling; what it throws ends it.
Simulation build(const scene::SceneSpec& asked, const Bed& bed, const Execution& execution,
                 const std::vector<Array>& resume_from = {}, const std::function<void()>& settling = {});

/// A bed's grains ("grains/id", "grains/position", "grains/radius") in the solver's order and back.
grains::Grains grains_of(const std::vector<Array>& arrays, double density);
std::vector<Array> arrays_of(const grains::Grains& grains);

}  // namespace seapile::simulation
