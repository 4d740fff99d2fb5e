// What the transient VTKHDF 2.0 files of a run have in common: the values of all frames one after the other, windows
// onto those of each frame, and where each drawn step begins.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runner/store/frame_layout.h"
#include "runner/store/hdf5_file.h"
#include "runner/store/stamp.h"
#include "runner/store/xdmf.h"

namespace seapile::store {

using Integers = std::vector<std::int64_t>;

inline std::int64_t whole(std::size_t number) { return static_cast<std::int64_t>(number); }

/// "/steps/00012" for the name "steps".
std::string step_path(const char* name, std::size_t index);

/// Begins a file: its stamp and its type.
void write_head(hdf5::FileWriter& writer, const std::string& content, const std::string& type, const Stamp& stamp);

/// One number per frame, /frames/`name`.
void write_per_frame(hdf5::FileWriter& writer, const std::string& name, const std::string& unit,
                     const std::string& meaning, const std::vector<double>& values);

/// One frame's list of arrays.
using ListSource = std::function<std::vector<simulation::Array>(std::size_t)>;

/// Writes the values of all frames one after the other to /VTKHDF/`data_group`, positions to /VTKHDF/Points, and the
/// windows /steps/NNNNN onto each. Returns what the sidecar needs of them, one step per frame.
std::vector<XdmfStep> write_values(hdf5::FileWriter& writer, const std::string& data_group, const ListLayout& layout,
                                   const std::vector<double>& time, const ListSource& load);

/// Where the parts, points, cells and connectivities of each drawn step begin.
struct StepOffsets {
  std::vector<double> time;
  Integers rows;  ///< first row of the step in its arrays
  Integers parts, points;
  Integers cells, connectivities;  ///< one column per topology
};

void write_steps(hdf5::FileWriter& writer, const std::string& data_group, const ListLayout& layout,
                 const StepOffsets& offsets);

}  // namespace seapile::store
