// The solid at the vertices when grains stand a little off the places that they were deposited at: what they carried
// over the hat functions' slopes, by the equation of continuity of the solid,
//
//   S_j(x + d) = S_j(x) + int grad N_j . q,   q_k = sum_i V_ik d_i/m_k
//
// q linear in between: V_i d_i spread like the grain itself. As the deposit does, it keeps the area, sum_j S_j, and the
// centre, sum_j S_j x_j, which moves by sum_i V_i d_i. First order in d. Neglected: what of a disc comes out of the
// mesh by the way, or into it; and what is finer than the mesh, of ways that differ from grain to grain.
#pragma once

#include <span>
#include <vector>

#include "solver/coupling/deposit.h"

namespace seapile::coupling {

/// S_j [m2], (vertices), of grains that were deposited at `from`, there with `solid`, and stand at `to`.
std::vector<double> moved_solid(const mesh::TriangleMesh& mesh, std::span<const double> vertex_volume,
                                const Deposit& deposit, std::span<const double> solid,
                                std::span<const grains::Disc> from, std::span<const grains::Disc> to);

}  // namespace seapile::coupling
