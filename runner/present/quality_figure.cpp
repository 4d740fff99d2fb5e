#include "runner/present/quality_figure.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "runner/present/flow_mesh.h"
#include "solver/mesh/quality.h"

namespace seapile::present {
namespace {

/// Shares of the values in equal bins from 0 to `top`; what is beyond an end is in the bin there. A value on a limit is
/// in the bin above it, and so is one that is below it by rounding alone: the angles of a regular mesh are such.
std::vector<double> histogram(const std::vector<double>& values, double top, std::size_t bins) {
  constexpr double kRounding = 1e-9;
  std::vector<double> shares(bins, 0);
  for (const double value : values) {
    const double at = value / top * static_cast<double>(bins) + kRounding;
    const auto bin = at > 0 ? std::min(static_cast<std::size_t>(at), bins - 1) : 0;
    shares[bin] += 1 / static_cast<double>(values.size());
  }
  return shares;
}

mesh::TriangleMesh triangles_of(const FlowOfRun& run) {
  const FlowMesh flow(run.frame);
  mesh::TriangleMesh mesh;
  for (std::size_t v = 0; v < flow.vertices(); ++v) mesh.position.push_back(flow.at(static_cast<std::int64_t>(v)));
  for (std::size_t t = 0; t < flow.triangles(); ++t) {
    const auto corner = flow.triangle(t);
    mesh.triangle.push_back({static_cast<std::int32_t>(corner[0]), static_cast<std::int32_t>(corner[1]),
                             static_cast<std::int32_t>(corner[2])});
  }
  if (mesh.triangle.empty()) {
    throw store::StoreError(store::StoreError::Kind::damaged, "the frame has no triangles");
  }
  return mesh;
}

}  // namespace

QualityFigure quality_figure(const std::vector<FlowOfRun>& runs, const std::optional<View>& view) {
  QualityFigure figure;
  for (const FlowOfRun& run : runs) {
    const mesh::TriangleMesh triangles = triangles_of(run);
    const mesh::Quality quality = mesh::quality_of(triangles);
    const mesh::QualitySummary summary = mesh::summary_of(quality);
    QualityPanel panel{title_of(run),
                       quality.shape.size(),
                       histogram(quality.shape, 1, kShapeBins),
                       histogram(quality.smallest_angle, std::numbers::pi / 3, kAngleBins),
                       summary.lowest_shape,
                       summary.smallest_angle,
                       summary.below_half,
                       summary.small_angles,
                       std::move(flow_figure(FlowFigureKind::mesh, {run}, view).panels.at(0)),
                       !run.scene.jet,
                       {}};
    for (std::size_t t = 0; t < triangles.triangle.size(); ++t) {
      if (!(quality.shape[t] < kBadShape)) continue;
      std::array<base::Vec2, 3> corners;
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = triangles.position[static_cast<std::size_t>(triangles.triangle[t][k])];
      panel.bad.push_back(corners);
    }
    figure.full =
        std::max({figure.full, *std::ranges::max_element(panel.shape), *std::ranges::max_element(panel.angle)});
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace seapile::present
