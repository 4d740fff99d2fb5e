// What the frames of a run have in common, and how their arrays are laid out in files.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "runner/store/hdf5_file.h"
#include "solver/simulation/flow_frame.h"
#include "solver/simulation/frame.h"

namespace seapile::store {

/// Frames on demand, so that not all of them need to be in memory.
template <class F>
struct OnDemand {
  std::size_t count = 0;
  std::function<F(std::size_t)> load;
};
using FrameSource = OnDemand<simulation::Frame>;
using FlowFrameSource = OnDemand<simulation::FlowFrame>;

/// One of a frame's lists of arrays: &Frame::grains, &Frame::contacts or &Frame::cells.
using FrameList = std::vector<simulation::Array> simulation::Frame::*;

/// A list of arrays in all frames.
struct ListLayout {
  std::vector<simulation::Array> arrays;  ///< of every frame, without values
  std::vector<std::size_t> rows;          ///< of each frame
  std::vector<std::size_t> first_row;     ///< of each frame, when the frames are put one after the other
  std::size_t total_rows = 0;

  /// Takes the next frame's list in. Throws std::logic_error when it differs from the others in more than its number of
  /// rows. A frame without a row may leave its arrays out.
  void add(std::vector<simulation::Array> list);
};

struct FrameLayout : ListLayout {
  std::vector<double> time, depth, asked;
  simulation::Frame::Grid grid;
};

/// Throws std::logic_error when the frames differ in more than their numbers of rows.
FrameLayout layout_of(const FrameSource& frames, FrameList list);

/// The part of an array's name behind "grains/".
std::string leaf(const simulation::Array& array);

/// Whether an array is a vector in space. VTK wants those with three components: position, velocity, mesh_velocity,
/// displacement and normal get a z of zero in files.
bool is_vector_in_space(const simulation::Array& array);
simulation::Array in_space(const simulation::Array& array);
void to_plane(simulation::Array& array);

/// Extents of so many rows of an array in a file.
hdf5::Extents extents_in_file(const simulation::Array& array, std::size_t rows);

}  // namespace seapile::store
