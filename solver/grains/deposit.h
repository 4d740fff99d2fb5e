// Grains drawn at random and laid out to be dropped: the start of a bed.
//
// Radii are uniform in [r_min, r_max] (the thesis gives only the bounds). The grains stand on a square lattice a little
// wider than the largest grain, each displaced at random within its cell, so that none overlap; rows fill from the base
// up and may stand above the walls' height, because walls have no top.
#pragma once

#include <cstdint>

#include "solver/grains/contact_solver.h"
#include "solver/grains/grains.h"
#include "solver/grains/grains_spec.h"

namespace seapile::grains {

/// Grains of ids 0..count-1, in the solver's order.
Grains deposit(const GrainsSpec& spec, const Box& box, std::uint64_t seed);

/// Grains from rows of id, x, y, radius, in the solver's order: along a Hilbert curve, ties by id; within each tile, those
/// with neighbours across a cut between regions first, the largest regions' before the others'.
struct GivenGrain {
  std::int64_t id;
  double x, y, radius;
};
Grains arrange(std::vector<GivenGrain> given, double density);

}  // namespace seapile::grains
