#include "solver/coupling/on_mesh.h"

#include <utility>

namespace seapile::coupling {

OnMesh found_on(const mesh::TriangleMesh& mesh, Location& location, std::vector<grains::Disc> disc, Kernel kernel,
                base::InstructionSet instructions, base::Crew* crew) {
  OnMesh on;
  on.disc = std::move(disc);
  on.deposit = deposit(mesh, location, on.disc, kernel, crew, instructions);
  on.vertex_volume = vertex_volume(mesh);
  return on;
}

void fill(OnMesh& on, std::vector<double> solid, double least) {
  on.solid = std::move(solid);
  on.porosity = porosity(on.solid, on.vertex_volume, least);
}

OnMesh put_on(const mesh::TriangleMesh& mesh, Location& location, std::vector<grains::Disc> disc,
              const PorositySpec& spec, base::InstructionSet instructions, base::Crew* crew) {
  OnMesh on = found_on(mesh, location, std::move(disc), spec.kernel, instructions, crew);
  fill(on, solid_volume(on.deposit, mesh.vertices()), spec.least);
  return on;
}

}  // namespace seapile::coupling
