// The frames of the water, all of them in one file, in two layouts over the same bytes as frames_file.h has; the mesh
// may change from frame to frame. The free surface stands in a file of its own.
#pragma once

#include <filesystem>
#include <vector>

#include "runner/store/frame_layout.h"
#include "runner/store/stamp.h"

namespace seapile::store {

inline constexpr const char* kFlowFile = "flow.vtkhdf";  ///< has an .xdmf sidecar
inline constexpr const char* kSurfaceFile = "surface.h5";

/// Seals flow.vtkhdf with its sidecar, and surface.h5 when a frame has a free surface; none when there are no frames.
/// Throws std::logic_error when the frames differ in more than their numbers of rows.
void write_flow_frames(const std::filesystem::path& folder, const Stamp& stamp, const FlowFrameSource& frames);

/// `with_surface`: whether the run has a surface.h5. Throws StoreError::damaged when the files are not those of the
/// run.
simulation::FlowFrame read_flow_frame(const std::filesystem::path& folder, const Stamp& stamp, std::size_t index,
                                      bool with_surface);

/// Of all frames [s].
std::vector<double> read_flow_times(const std::filesystem::path& folder, const Stamp& stamp);

}  // namespace seapile::store
