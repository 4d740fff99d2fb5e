#include "solver/mesh/generate.h"

#include <dlfcn.h>

#include "solver/mesh/mesher.h"

namespace seapile::mesh {
namespace {

/// The function of the module, which stays loaded.
decltype(&seapile_generate) mesher_function() {
  static void* const module = dlopen("libseapile_mesher.so", RTLD_NOW | RTLD_LOCAL);
  void* const function = module ? dlsym(module, "seapile_generate") : nullptr;
  if (!function) throw NoMesh(std::string("mesh: the mesher cannot be loaded: ") + dlerror());
  return reinterpret_cast<decltype(&seapile_generate)>(function);
}

}  // namespace

TriangleMesh generate(std::span<const Corner> polygon, const std::function<double(base::Vec2)>& size,
                      const Method& method) {
  TriangleMesh mesh;
  std::string error;
  mesher_function()(polygon, size, method, mesh, error);
  if (!error.empty()) throw NoMesh("mesh: Gmsh could not mesh the domain: " + error);
  check(mesh);
  return mesh;
}

}  // namespace seapile::mesh
