#include "solver/mesh/rectangle.h"

#include <stdexcept>

namespace seapile::mesh {

std::vector<double> even(double first, double last, int count) {
  std::vector<double> values(count + 1);
  for (int i = 0; i <= count; ++i) values[i] = i == count ? last : first + (last - first) * i / count;
  return values;
}

TriangleMesh rectangle(std::span<const double> x, std::span<const double> y, Diagonals diagonals) {
  const auto nx = static_cast<std::int32_t>(x.size()), ny = static_cast<std::int32_t>(y.size());
  if (nx < 2 || ny < 2) throw std::logic_error("mesh: a rectangle needs two values on each axis");
  if (diagonals == Diagonals::mirrored && nx % 2 == 0)
    throw std::logic_error("mesh: mirrored diagonals need an even number of columns");
  TriangleMesh mesh;
  mesh.position.reserve(x.size() * y.size());
  for (std::int32_t j = 0; j < ny; ++j)
    for (std::int32_t i = 0; i < nx; ++i) mesh.position.push_back({x[i], y[j]});
  for (std::int32_t j = 0; j + 1 < ny; ++j)
    for (std::int32_t i = 0; i + 1 < nx; ++i) {
      const std::int32_t a = i + j * nx, b = a + 1, c = b + nx, d = a + nx;
      if (diagonals == Diagonals::alike || 2 * i < nx - 1) {
        mesh.triangle.push_back({a, b, c});
        mesh.triangle.push_back({a, c, d});
      } else {
        mesh.triangle.push_back({a, b, d});
        mesh.triangle.push_back({b, c, d});
      }
    }
  mesh.boundary = boundary_of(mesh.triangle, mesh.position, [&](base::Vec2 from, base::Vec2 to) {
    if (from.y == y[0] && to.y == y[0]) return kBottom;
    if (from.y == y.back() && to.y == y.back()) return kTop;
    return from.x == x[0] && to.x == x[0] ? kLeft : kRight;
  });
  return mesh;
}

}  // namespace seapile::mesh
