// The wedges of a disc that holds a vertex, side by side.
#pragma once

#include <array>

namespace seapile::coupling {

/// Rays from the vertex, of which `count` are; the others may be anything.
struct Rays {
  static constexpr int kMost = 16;
  int count = 0;
  std::array<double, kMost> x{}, y{};  ///< the ray's direction along and across the way from the centre to the vertex
  std::array<double, kMost> beyond;    ///< of each ray, as in beyond_ray [m3]
};

/// Sets `beyond` of a disc of radius r whose vertex is away r from its centre. The same bits with all instruction sets.
using WedgeKernel = void (*)(double r, double away, Rays& rays);

extern const WedgeKernel kWedgeKernel_generic, kWedgeKernel_avx2, kWedgeKernel_avx512;

}  // namespace seapile::coupling
