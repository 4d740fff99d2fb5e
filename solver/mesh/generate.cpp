#include "solver/mesh/generate.h"

#include <dlfcn.h>

#include <cstring>

#include "solver/mesh/in_child.h"
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

/// What one try gave.
struct Try {
  TriangleMesh mesh;
  std::string error;  ///< why there is none; empty when there is
  bool in_time = true;
};

/// Calls visit with each array of a try, in the order in which they follow one another in a child's answer.
template <class Given, class Visit>
void for_each_array(Given& given, const Visit& visit) {
  visit(given.error);
  visit(given.mesh.position);
  visit(given.mesh.triangle);
  visit(given.mesh.boundary);
}

/// Each array's count and bytes.
std::string packed(const Try& given) {
  std::string bytes;
  for_each_array(given, [&](const auto& array) {
    const std::size_t count = array.size();
    bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
    if (count > 0) bytes.append(reinterpret_cast<const char*>(array.data()), count * sizeof array[0]);
  });
  return bytes;
}

Try unpacked(const std::string& bytes) {
  Try given;
  std::size_t at = 0;
  bool whole = true;
  for_each_array(given, [&](auto& array) {
    std::size_t count = 0;
    whole = whole && bytes.size() - at >= sizeof count;
    if (!whole) return;
    std::memcpy(&count, bytes.data() + at, sizeof count);
    at += sizeof count;
    whole = count <= (bytes.size() - at) / sizeof array[0];
    if (!whole || count == 0) return;
    array.resize(count);
    std::memcpy(array.data(), bytes.data() + at, count * sizeof array[0]);
    at += count * sizeof array[0];
  });
  if (!whole || at != bytes.size()) return {{}, "Gmsh's answer is not whole"};
  return given;
}

/// Why a mesh is none; empty when it is one.
std::string objection(const TriangleMesh& mesh) {
  if (mesh.triangles() == 0) return "Gmsh made no elements";
  try {
    check(mesh);
  } catch (const std::logic_error& error) {
    return std::string("Gmsh made no valid mesh (") + error.what() + ")";
  }
  return "";
}

Try tried(std::span<const Corner> polygon, const std::function<double(base::Vec2)>& size, const Method& method) {
  const auto mesher = mesher_function();  // loaded here, so that each child has it already
  const Ending ending = in_child(
      [&] {
        Try given;
        mesher(polygon, size, method, given.mesh, given.error);
        if (!given.error.empty()) given.error = "Gmsh could not mesh the domain: " + given.error;
        return packed(given);
      },
      method.patience);
  if (!ending.trouble.empty()) return {{}, "Gmsh " + ending.trouble, ending.in_time};
  Try given = unpacked(ending.answer);
  if (given.error.empty()) given.error = objection(given.mesh);
  return given;
}

}  // namespace

TriangleMesh generate(std::span<const Corner> polygon, const std::function<double(base::Vec2)>& size,
                      const Method& method) {
  Try first = tried(polygon, size, method);
  if (first.error.empty()) return std::move(first.mesh);
  // By another seed the clock would decide which mesh a run has.
  if (!first.in_time) throw NoAnswer("mesh: " + first.error);
  Method other = method;
  ++other.seed;
  Try second = tried(polygon, size, other);
  if (second.error.empty()) return std::move(second.mesh);
  const std::string why = "mesh: " + first.error + ", and with another seed" +
                          (second.error == first.error ? " again" : ": " + second.error);
  if (!second.in_time) throw NoAnswer(why);
  throw NoMesh(why);
}

}  // namespace seapile::mesh
