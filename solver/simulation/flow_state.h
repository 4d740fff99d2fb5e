// A flow as named arrays: the frame that is kept of it, and the state that it can be continued from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/fluid/advance.h"
#include "solver/fluid/free_surface.h"
#include "solver/simulation/array.h"
#include "solver/simulation/flow_frame.h"

namespace seapile::simulation {

/// What a frame's meanings say of their scales: ", in H"; empty where numbers are in SI.
struct FrameScales {
  std::string length, velocity, pressure, curvature;
};

/// `surface`: null when there is none.
FlowFrame frame_of(const fluid::Flow& flow, const fluid::FreeSurface* surface, double time, const FrameScales& scales);

/// XXH3 of a frame's arrays.
std::uint64_t hash_of(const FlowFrame& frame);

/// x, y, x, y, ... of vectors, and back.
std::vector<double> flat(const std::vector<base::Vec2>& vectors);
std::vector<base::Vec2> vectors(const std::vector<double>& values);

/// Whether a state has an array.
bool has_array(const std::vector<Array>& state, const std::string& name);
/// The array `name`, of so many values (-1: any number). Throws std::invalid_argument when it is missing or does not
/// fit.
template <class T>
const std::vector<T>& array_of(const std::vector<Array>& state, const std::string& name, std::ptrdiff_t count = -1);

/// Triangles, places, unknowns, past, and the matrix of the kept factor: everything of the flow that the next step
/// reads and that the scene does not say.
void add_flow(std::vector<Array>& state, const fluid::Flow& flow, const fluid::Past& past,
              const fluid::FlowSolver& solver);

/// The vertices of the triangles, three for each.
std::vector<std::int32_t> corners_of(const mesh::TriangleMesh& mesh);

/// Puts back what add_flow() took, into a flow on the same mesh. Throws std::invalid_argument when an array is missing
/// or does not fit.
void restore_flow(fluid::Flow& flow, fluid::Past& past, fluid::FlowSolver& solver, const std::vector<Array>& state);

}  // namespace seapile::simulation
