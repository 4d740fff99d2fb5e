#include "solver/mesh/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace seapile::mesh {
namespace {

constexpr double kSmallAngle = std::numbers::pi / 6;

/// Share of the values that `is_such` [-].
template <class Such>
double share_of(const std::vector<double>& values, Such is_such) {
  return values.empty()
             ? 0
             : static_cast<double>(std::ranges::count_if(values, is_such)) / static_cast<double>(values.size());
}

/// A triangle's shape, and sine and cosine of its smallest angle times the edges beside it.
struct Corners {
  double shape, sine, cosine;
};

Corners corners_of(const TriangleMesh& mesh, const std::array<std::int32_t, 3>& t) {
  const base::Vec2 p[3] = {mesh.position[t[0]], mesh.position[t[1]], mesh.position[t[2]]};
  const base::Vec2 edge[3] = {p[2] - p[1], p[0] - p[2], p[1] - p[0]};
  const double squares[3] = {dot(edge[0], edge[0]), dot(edge[1], edge[1]), dot(edge[2], edge[2])};
  const double doubled = doubled_area(p[0], p[1], p[2]), sum = squares[0] + squares[1] + squares[2];
  // The smallest angle lies opposite the shortest edge.
  const auto k = std::min_element(squares, squares + 3) - squares;
  const double q = 2 * std::numbers::sqrt3 * doubled / sum;
  if (!std::isfinite(q)) return {0, 0, 1};
  return {q, doubled, 0 - dot(edge[(k + 1) % 3], edge[(k + 2) % 3])};
}

}  // namespace

Quality quality_of(const TriangleMesh& mesh) {
  Quality quality;
  quality.shape.reserve(mesh.triangles());
  quality.smallest_angle.reserve(mesh.triangles());
  for (const auto& t : mesh.triangle) {
    const Corners c = corners_of(mesh, t);
    quality.shape.push_back(c.shape);
    // Sine and cosine together are exact for every angle.
    const double angle = std::atan2(c.sine, c.cosine);
    quality.smallest_angle.push_back(std::isfinite(angle) ? angle : 0);
  }
  return quality;
}

QualitySummary summary_of(const Quality& quality) {
  QualitySummary summary;
  for (const double q : quality.shape) summary.lowest_shape = std::min(summary.lowest_shape, q);
  for (const double angle : quality.smallest_angle) summary.smallest_angle = std::min(summary.smallest_angle, angle);
  summary.below_half = share_of(quality.shape, [](double q) { return q < 0.5; });
  summary.small_angles = share_of(quality.smallest_angle, [](double angle) { return angle < kSmallAngle; });
  return summary;
}

bool asks_for_new_mesh(const RemeshRule& rule, const Quality& quality) {
  return std::ranges::any_of(quality.shape, [&](double q) { return q < rule.shape; }) ||
         (!quality.shape.empty() &&
          share_of(quality.smallest_angle, [&](double angle) { return angle < rule.angle; }) >= rule.share);
}

bool asks_for_new_mesh(const RemeshRule& rule, const TriangleMesh& mesh) {
  const double sine = std::sin(rule.angle), cosine = std::cos(rule.angle);
  std::size_t small = 0;
  for (const auto& t : mesh.triangle) {
    const Corners c = corners_of(mesh, t);
    if (c.shape < rule.shape) return true;
    if (sine * c.cosine > cosine * c.sine) ++small;
  }
  const auto all = static_cast<double>(mesh.triangles());
  return all > 0 && static_cast<double>(small) / all >= rule.share;
}

}  // namespace seapile::mesh
