// Grains on a mesh: where they were found there, and what they fill of it.
#pragma once

#include <vector>

#include "solver/base/crew.h"
#include "solver/base/instruction_set.h"
#include "solver/coupling/coupling_spec.h"
#include "solver/coupling/deposit.h"
#include "solver/coupling/porosity.h"

namespace seapile::coupling {

struct OnMesh {
  std::vector<grains::Disc> disc;  ///< where they were found, (grains)
  Deposit deposit;
  std::vector<double> vertex_volume;  ///< m_j [m2], (vertices)
  std::vector<double> solid;          ///< S_j [m2], (vertices)
  Porosity porosity;
};

/// Finds the grains; what they fill is left open.
OnMesh found_on(const mesh::TriangleMesh& mesh, Location& location, std::vector<grains::Disc> disc, Kernel kernel,
                base::InstructionSet instructions, base::Crew* crew);

/// Fills the mesh with the solid S_j [m2], (vertices).
void fill(OnMesh& on, std::vector<double> solid, double least);

/// Both, with the solid of the deposit.
OnMesh put_on(const mesh::TriangleMesh& mesh, Location& location, std::vector<grains::Disc> disc,
              const PorositySpec& spec, base::InstructionSet instructions, base::Crew* crew);

}  // namespace seapile::coupling
