// The time loop of a pile's drive, dry or saturated.
#pragma once

#include "solver/scene/spec.h"
#include "solver/simulation/run.h"
#include "solver/simulation/simulation.h"
#include "solver/simulation/tip_measures.h"

namespace seapile::simulation {

/// From a simulation's present state to its end: run() without what it builds. `measuring`: what frames have measured
/// before.
RunResult drive(Simulation& simulation, const scene::SceneSpec& scene, const scene::RecordSpec& record,
                const Trying& trying, Measuring measuring, const RecordsSoFar& so_far, const RunHooks& hooks);

}  // namespace seapile::simulation
