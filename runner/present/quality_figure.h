// How good the triangles of meshes are: each mesh with its bad triangles marked, and histograms of the shape q and of
// the smallest angle (thesis figure 4.5), on scales that all of them share.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "runner/present/flow_figure.h"

namespace seapile::present {

inline constexpr std::size_t kShapeBins = 20;  ///< of q, 0.05 each, from 0 to 1
inline constexpr std::size_t kAngleBins = 12;  ///< of the smallest angle, 5 degrees each, from 0 to 60

inline constexpr double kBadShape = 0.5;

struct QualityPanel {
  std::string title;
  std::size_t triangles = 0;
  std::vector<double> shape;  ///< share of the triangles in each bin; the lowest also holds what turned over
  std::vector<double> angle;  ///< the same of the smallest angles
  double lowest_shape = 1;    ///< q [-]
  double smallest_angle = 0;  ///< [rad]
  double below_half = 0;      ///< share of the triangles with q < 0.5
  double small_angles = 0;    ///< share of the triangles with an angle below 30 degrees
  FlowPanel mesh;             ///< its edges, in the view
  bool in_metres = true;      ///< otherwise in H
  std::vector<std::array<base::Vec2, 3>> bad;  ///< triangles with q < 0.5
};

struct QualityFigure {
  double full = 0;  ///< the largest share in a bin of any panel
  std::vector<QualityPanel> panels;
};

/// The meshes are seen in `view` or as flow_figure() shows them; the histograms are always of whole meshes. Throws
/// std::invalid_argument, in a sentence, when the view lies beside a mesh; store::StoreError when a frame lacks an
/// array or has no triangle.
QualityFigure quality_figure(const std::vector<FlowOfRun>& runs, const std::optional<View>& view = {});

}  // namespace seapile::present
