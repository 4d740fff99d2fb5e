// The mesh of a frame of the water, with its arrays found and its rows checked once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "runner/present/arrays.h"
#include "solver/simulation/flow_frame.h"

namespace seapile::present {

/// Refers to the frame's arrays. Throws store::StoreError when they are not there or a corner is no vertex.
struct FlowMesh {
  explicit FlowMesh(const simulation::FlowFrame& frame)
      : positions(values<double>(frame.vertices, "vertices/position")),
        corners(values<std::int64_t>(frame.triangles, "triangles/corner")) {
    const auto count = static_cast<std::int64_t>(vertices());
    if (std::ranges::any_of(corners, [&](std::int64_t row) { return row < 0 || row >= count; })) {
      throw store::StoreError(store::StoreError::Kind::damaged,
                              "a triangle of the frame has a corner that is no vertex");
    }
  }
  std::size_t vertices() const { return positions.size() / 2; }
  std::size_t triangles() const { return corners.size() / 3; }
  base::Vec2 at(std::int64_t row) const { return vec2(positions, static_cast<std::size_t>(row)); }
  std::span<const std::int64_t> triangle(std::size_t t) const { return std::span(corners).subspan(3 * t, 3); }

  const std::vector<double>& positions;
  const std::vector<std::int64_t>& corners;
};

}  // namespace seapile::present
