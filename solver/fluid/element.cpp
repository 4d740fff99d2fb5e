#include "solver/fluid/element.h"

namespace seapile::fluid {
namespace {

constexpr QuadraturePoint kDegreeTwo[] = {{{2.0 / 3, 1.0 / 6, 1.0 / 6}, 1.0 / 3},
                                          {{1.0 / 6, 2.0 / 3, 1.0 / 6}, 1.0 / 3},
                                          {{1.0 / 6, 1.0 / 6, 2.0 / 3}, 1.0 / 3}};

constexpr double kA = 0.445948490915965, kAWeight = 0.223381589678011, kB = 0.091576213509771,
                 kBWeight = 0.109951743655322;
constexpr QuadraturePoint kDegreeFour[] = {{{1 - 2 * kA, kA, kA}, kAWeight}, {{kA, 1 - 2 * kA, kA}, kAWeight},
                                           {{kA, kA, 1 - 2 * kA}, kAWeight}, {{1 - 2 * kB, kB, kB}, kBWeight},
                                           {{kB, 1 - 2 * kB, kB}, kBWeight}, {{kB, kB, 1 - 2 * kB}, kBWeight}};

}  // namespace

std::span<const QuadraturePoint> quadrature(Geometry geometry) {
  if (geometry == Geometry::planar) return kDegreeTwo;
  return kDegreeFour;
}

}  // namespace seapile::fluid
