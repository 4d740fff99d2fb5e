// A small trial of what every run leans on.
#pragma once

#include <cstddef>
#include <string>

namespace seapile::execute {

struct MesherTrial {
  std::size_t triangles = 0;
  std::string trouble;  ///< why there is no mesh; "" when there is one
};

/// Meshes the unit square, as the solver meshes a domain: by the module, in a child process.
MesherTrial trial_of_mesher();

}  // namespace seapile::execute
