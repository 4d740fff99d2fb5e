// What the module with Gmsh offers to generate().
//
// Gmsh comes with a hundred libraries: a program that links it takes 0.1 s and 45 MB more to start, also where a scene
// has no mesh, and every worker is a program. It is therefore a module of its own, loaded when it is needed. It is
// loaded once and called in children of the process alone (in_child.h): Gmsh starts anew for each mesh.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "solver/mesh/generate.h"

/// One try of generate(), without its checks; a sentence in `error` when it cannot, and nothing is thrown.
extern "C" void seapile_generate(std::span<const seapile::mesh::Corner> polygon,
                                 const std::function<double(seapile::base::Vec2)>& size,
                                 const seapile::mesh::Method& method, seapile::mesh::TriangleMesh& mesh,
                                 std::string& error);
