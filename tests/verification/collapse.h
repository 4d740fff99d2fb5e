// A column of grains between two smooth walls that vanish at once, and the heap that it becomes.
#pragma once

#include <cstdint>

#include "tests/verification/solver_under_test.h"

namespace seapile::verification {

struct Collapse {
  double half_width = 0;    ///< L0, of the column [m]
  double aspect = 0;        ///< a = H0 / L0, with H0 twice the height of the settled column's centre of mass
  double half_length = 0;   ///< L, of the heap: its grains touch or nearly so; those that rolled off do not count [m]
  double angle = 0;         ///< of its flanks, from lines through the tops of columns [rad]
  double centre_shift = 0;  ///< sideways, of the centre of mass of all grains [m]
  double tip_shift = 0;     ///< sideways, of the heap's middle [m]
  double kinetic = 0;       ///< energy of the heap's grains at the end, over the potential energy at the start
};

/// `aspect`: wanted; `friction`: of the grains, and of the floor once the walls are gone. The same question is computed
/// once per program.
const Collapse& collapse(const Solver& solver, double aspect, double friction, int count, std::uint64_t seed);

/// A frictionless column in a box three times as wide, at rest: slope of its surface [rad].
double frictionless_slope(const Solver& solver, int count, std::uint64_t seed);

}  // namespace seapile::verification
