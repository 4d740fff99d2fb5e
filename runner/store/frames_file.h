// The frames of a run, all of them in one file per kind of entity, in two layouts over the same bytes:
//
//   /VTKHDF          transient VTKHDF 2.0 (the frames one after the other), for ParaView >= 5.12
//   /steps/NNNNN     windows onto the rows of frame NNNNN, for h5py, for this program, and for the XDMF sidecar, which
//                    older ParaViews read
//
// What is drawn leaves out a frame without a point or cell: readers stop there, or misplace what follows.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "runner/store/frame_layout.h"
#include "runner/store/stamp.h"

namespace seapile::store {

/// What holds the frames' numbers; each has an .xdmf sidecar.
inline constexpr std::array kFrameFiles = {"grains.vtkhdf", "contacts.vtkhdf", "fields.vtkhdf"};

/// Seals grains.vtkhdf, contacts.vtkhdf and fields.vtkhdf with their .xdmf sidecars; none when there are no frames.
void write_frames(const std::filesystem::path& folder, const Stamp& stamp, const FrameSource& frames);

/// Throws StoreError::damaged when the files are not those of the run.
simulation::Frame read_frame(const std::filesystem::path& folder, const Stamp& stamp, std::size_t index);

/// The depths that the frames were asked for [m]; of a run with frames. Throws like read_frame().
std::vector<double> read_asked_depths(const std::filesystem::path& folder, const Stamp& stamp);

}  // namespace seapile::store
