// How good the triangles of meshes are, as histograms: for each mesh one of the shape q and one of the smallest angle
// (thesis figure 4.5), on scales that all of them share.
#pragma once

#include <string>
#include <vector>

#include "runner/present/flow_figure.h"

namespace seapile::present {

inline constexpr std::size_t kShapeBins = 20;  ///< of q, 0.05 each, from 0 to 1
inline constexpr std::size_t kAngleBins = 12;  ///< of the smallest angle, 5 degrees each, from 0 to 60

struct QualityPanel {
  std::string title;
  std::size_t triangles = 0;
  std::vector<double> shape;  ///< share of the triangles in each bin; the lowest also holds what turned over
  std::vector<double> angle;  ///< the same of the smallest angles
  double lowest_shape = 1;    ///< q [-]
  double smallest_angle = 0;  ///< [rad]
  double below_half = 0;      ///< share of the triangles with q < 0.5
  double small_angles = 0;    ///< share of the triangles with an angle below 30 degrees
};

struct QualityFigure {
  double full = 0;  ///< the largest share in a bin of any panel
  std::vector<QualityPanel> panels;
};

/// Throws store::StoreError when a frame lacks an array or has no triangle.
QualityFigure quality_figure(const std::vector<FlowOfRun>& runs);

}  // namespace seapile::present
