#include "solver/mesh/inversion.h"

#include <cmath>
#include <stdexcept>

namespace seapile::mesh {
namespace {

double cross(base::Vec2 a, base::Vec2 b) { return a.x * b.y - a.y * b.x; }

/// Where c0 + c1 s + c2 s^2, positive at 0, is zero for the first time on [0, 1]. Of the two forms of each root the one
/// without cancellation.
std::optional<double> first_zero(double c0, double c1, double c2) {
  const double discriminant = c1 * c1 - 4 * c2 * c0;
  if ((c1 >= 0 && c2 >= 0) || discriminant < 0) return {};
  const double root = std::sqrt(discriminant);
  const double s = c1 < 0 ? 2 * c0 / (root - c1) : -(c1 + root) / (2 * c2);
  return s <= 1 ? std::optional(s) : std::nullopt;
}

/// Whether all vertices move up or down by ways that keep every triangle's area, which is then linear on the way, above
/// 0 at both ends: the usual case.
bool moves_upright(const TriangleMesh& mesh, std::span<const base::Vec2> from, std::span<const base::Vec2> to) {
  for (std::size_t v = 0; v < from.size(); ++v)
    if (from[v].x != to[v].x) return false;
  for (const auto& [a, b, c] : mesh.triangle) {
    const double start = doubled_area(from[a], from[b], from[c]), end = doubled_area(to[a], to[b], to[c]);
    const double both = start < end ? start : end;
    if (!(both > 0) || !std::isfinite(start + end)) return false;
  }
  return true;
}

}  // namespace

std::optional<Inversion> first_inversion(const TriangleMesh& mesh, std::span<const base::Vec2> from,
                                         std::span<const base::Vec2> to) {
  if (from.size() != mesh.vertices() || to.size() != mesh.vertices())
    throw std::logic_error("mesh: every vertex needs a place to come from and one to go to");
  if (moves_upright(mesh, from, to)) return {};
  std::optional<Inversion> first;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const auto& [a, b, c] = mesh.triangle[t];
    const double start = doubled_area(from[a], from[b], from[c]), end = doubled_area(to[a], to[b], to[c]);
    const auto triangle = static_cast<std::int32_t>(t);
    if (!(start > 0) || !std::isfinite(start) || !std::isfinite(end)) return Inversion{triangle, 0};
    const base::Vec2 e = from[b] - from[a], f = from[c] - from[a];
    const base::Vec2 de = (to[b] - to[a]) - e, df = (to[c] - to[a]) - f;
    std::optional<double> at = first_zero(start, cross(e, df) + cross(de, f), cross(de, df));
    if (!at && !(end > 0)) at = 1;  // By a rounding of the roots.
    if (at && (!first || *at < first->at)) first = {triangle, *at};
  }
  return first;
}

}  // namespace seapile::mesh
