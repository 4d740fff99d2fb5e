#include "solver/mesh/quality.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

Quality quality_of(const TriangleMesh& mesh) {
  Quality quality;
  quality.shape.reserve(mesh.triangles());
  quality.smallest_angle.reserve(mesh.triangles());
  for (const auto& t : mesh.triangle) {
    const base::Vec2 p[3] = {mesh.position[t[0]], mesh.position[t[1]], mesh.position[t[2]]};
    const base::Vec2 edge[3] = {p[2] - p[1], p[0] - p[2], p[1] - p[0]};
    const double squares[3] = {dot(edge[0], edge[0]), dot(edge[1], edge[1]), dot(edge[2], edge[2])};
    const double doubled = doubled_area(p[0], p[1], p[2]), sum = squares[0] + squares[1] + squares[2];
    // The smallest angle lies opposite the shortest edge; sine and cosine together are exact for every angle.
    const auto k = std::min_element(squares, squares + 3) - squares;
    const double q = 2 * std::numbers::sqrt3 * doubled / sum;
    const double angle = std::atan2(doubled, 0 - dot(edge[(k + 1) % 3], edge[(k + 2) % 3]));
    quality.shape.push_back(std::isfinite(q) ? q : 0);
    quality.smallest_angle.push_back(std::isfinite(q) ? angle : 0);
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

}  // namespace seapile::mesh
