// The mesher's module, with Gmsh, that goes wrong as the environment says.
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "solver/mesh/mesher.h"

/// What solver/mesh/mesher.cpp calls seapile_generate elsewhere.
extern "C" decltype(seapile_generate) real_generate;

extern "C" void seapile_generate(std::span<const seapile::mesh::Corner> polygon,
                                 const std::function<double(seapile::base::Vec2)>& size,
                                 const seapile::mesh::Method& method, seapile::mesh::TriangleMesh& mesh,
                                 std::string& error) {
  const char* given = std::getenv("SEAPILE_BROKEN");
  const std::string broken = given ? given : "";
  if (broken == "crashes") std::abort();
  if (broken == "hangs")
    for (;;) ::pause();
  if (broken == "is empty") return;
  real_generate(polygon, size, method, mesh, error);
  if (broken == "is inverted") std::swap(mesh.triangle[0][0], mesh.triangle[0][1]);
}
