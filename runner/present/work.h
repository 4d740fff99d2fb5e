// How much there is to do in a case, to scale what another one cost.
#pragma once

#include "solver/scene/spec.h"

namespace seapile::present {

/// Of a drive grains times seconds until its depth or its duration, of a basin its seconds, of a jet 1: each is in
/// proportion to the cost at one level of fidelity, and to that of scenes of its own kind alone.
double work_of(const scene::SceneSpec& scene);

}  // namespace seapile::present
