// How much of each grain belongs to each vertex of the water's mesh.
//
//   disc   V_ij = int N_j over the part of disc i that lies in the mesh      [m2]
//   hat    V_ij = pi r_i^2 N_j(x_i), 0 when the centre lies outside          (the literature's)
//
// N_j is the linear function of vertex j. Both keep the area, sum_j V_ij = pi r^2, and the centre, sum_j V_ij x_j =
// pi r^2 x_i. But N_j has kinks at edges. When a centre crosses one, the solid's rate in `hat` jumps, and with it the
// divergence of the flow; the pressure, which goes with its rate, is kicked by 1/dt. Smeared over the disc the kink is
// a bounded second derivative. `disc` is besides the true area at a free surface and beside the pile: of a disc that
// floats it is the share under water, by Archimedes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/base/crew.h"
#include "solver/base/instruction_set.h"
#include "solver/coupling/coupling_spec.h"
#include "solver/coupling/edges.h"
#include "solver/grains/grains.h"
#include "solver/mesh/elements.h"
#include "solver/mesh/triangle_mesh.h"

namespace seapile::coupling {

/// V_ij by grain, as a sparse matrix by rows.
struct Deposit {
  std::vector<std::int32_t> first;   ///< (grains + 1) where a grain's entries begin
  std::vector<std::int32_t> vertex;  ///< (entries) each once within a grain
  std::vector<double> volume;        ///< V_ij >= 0 [m2], (entries)
  std::vector<double> immersed;      ///< V_i = sum_j V_ij, a grain's area in the mesh [m2], (grains)
};

/// What is kept from one call to the next. Belongs to the triangles of one mesh, whose vertices may move.
struct Location {
  explicit Location(const mesh::TriangleMesh& mesh);

  std::vector<std::array<std::int32_t, 3>> triangle;  ///< of the mesh
  Edges edges;
  std::vector<base::Vec2> measured;  ///< where the vertices were when the edges were measured; empty: never
  mesh::Buckets buckets;             ///< of the mesh with its vertices at `position`
  std::vector<base::Vec2> position;
  std::vector<Deposit> spare;      ///< deposits that are no longer wanted, for their memory
  std::vector<std::int32_t> last;  ///< (grains) a triangle to look into first, or -1; for speed alone
};

/// A disc that is nowhere, with a number that is not finite, deposits nothing. The result depends on mesh and discs
/// alone, bit for bit. Throws std::logic_error when `location` belongs to another mesh.
Deposit deposit(const mesh::TriangleMesh& mesh, Location& location, std::span<const grains::Disc> discs,
                Kernel kernel = Kernel::disc, base::Crew* crew = nullptr,
                base::InstructionSet instructions = base::fastest());

/// S_j = sum_i V_ij in the order of the grains [m2], (vertices).
std::vector<double> solid_volume(const Deposit& deposit, std::size_t vertices);

}  // namespace seapile::coupling
