// What tells whether one case says something of another: how much there is to do in it, and whether it is fast.
#pragma once

#include "solver/scene/spec.h"

namespace seapile::present {

/// Of a drive grains times seconds until its depth or its duration, of a basin its seconds, of a jet 1: each is in
/// proportion to the cost at one level of fidelity, and to that of scenes of its own kind alone.
double work_of(const scene::SceneSpec& scene);

/// Whether a drive's pile throws grains ahead of it: it goes faster than a grain falls by half its size, V^2 > g d, and
/// the drive is no sequence of states at rest any more.
bool is_fast(const scene::SceneSpec& scene);

}  // namespace seapile::present
