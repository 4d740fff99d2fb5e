#include "runner/store/flow_file.h"

#include <utility>

#include "runner/store/arrays.h"
#include "runner/store/run_folder.h"
#include "runner/store/seal.h"
#include "runner/store/vtk_file.h"

namespace seapile::store {

namespace {

using simulation::Array;
using simulation::FlowFrame;

constexpr std::uint8_t kVtkTriangle = 5;  // vtkCellType.h
constexpr std::size_t kCorners = 3;
// What a frame's window onto its triangles is named, beside those onto the vertices' arrays.
const std::string kCorner = "corner";

struct FlowLayout {
  std::vector<double> time;
  ListLayout vertices, triangles, surface;
};

FlowLayout layout_of(const FlowFrameSource& frames) {
  FlowLayout layout;
  for (std::size_t k = 0; k < frames.count; ++k) {
    FlowFrame frame = frames.load(k);
    layout.time.push_back(frame.time);
    layout.vertices.add(std::move(frame.vertices));
    layout.triangles.add(std::move(frame.triangles));
    layout.surface.add(std::move(frame.surface));
  }
  return layout;
}

void write_time(hdf5::FileWriter& writer, const FlowLayout& layout) {
  write_per_frame(writer, "time", "s", "time of the frame", layout.time);
}

/// Writes the corners of all triangles one after the other, and the windows onto those of each frame, in rows of three.
void write_corners(hdf5::FileWriter& writer, const FlowFrameSource& frames, const FlowLayout& layout,
                   std::vector<XdmfStep>& steps) {
  const std::string source = "/VTKHDF/Connectivity";
  const ListLayout& triangles = layout.triangles;
  writer.create(source, hdf5::Number::i64, {kCorners * triangles.total_rows, 0});
  for (std::size_t k = 0; k < frames.count; ++k) {
    const Array corner = frames.load(k).triangles.front();
    const std::span<const std::int64_t> points = std::get<Integers>(corner.values);
    const std::string path = step_path("steps", k) + "/" + kCorner;
    const hdf5::Extents extents{triangles.rows[k], kCorners};
    const std::uint64_t hash = writer.append(source, points);
    writer.window(path, source, kCorners * triangles.first_row[k], extents, hash);
    describe_dataset(writer, path, corner.info, layout.vertices.arrays.size());
    steps[k].cells = {path, kCorner, hdf5::Number::i64, extents};
  }
}

/// Each step is a part. Returns what the sidecar needs.
std::vector<XdmfStep> write_mesh(hdf5::FileWriter& writer, const Stamp& stamp, const FlowFrameSource& frames,
                                 const FlowLayout& layout) {
  write_head(writer, "flow", "UnstructuredGrid", stamp);
  write_time(writer, layout);
  std::vector<XdmfStep> steps = write_values(writer, "PointData", layout.vertices, layout.time,
                                             [&](std::size_t k) { return frames.load(k).vertices; });
  write_corners(writer, frames, layout, steps);

  Integers points, cells, corners, ends;
  StepOffsets offsets;
  for (std::size_t k = 0; k < frames.count; ++k) {
    const std::size_t count = layout.triangles.rows[k];
    points.push_back(whole(layout.vertices.rows[k]));
    cells.push_back(whole(count));
    corners.push_back(whole(kCorners * count));
    for (std::size_t i = 0; i <= count; ++i) ends.push_back(whole(kCorners * i));
    offsets.parts.push_back(whole(k));
    offsets.points.push_back(whole(layout.vertices.first_row[k]));
    offsets.cells.push_back(whole(layout.triangles.first_row[k]));
    offsets.connectivities.push_back(whole(kCorners * layout.triangles.first_row[k]));
  }
  offsets.time = layout.time;
  offsets.rows = offsets.points;
  const std::size_t parts = frames.count, all = layout.triangles.total_rows;
  writer.dataset("/VTKHDF/NumberOfPoints", {parts, 0}, points);
  writer.dataset("/VTKHDF/NumberOfCells", {parts, 0}, cells);
  writer.dataset("/VTKHDF/NumberOfConnectivityIds", {parts, 0}, corners);
  writer.dataset("/VTKHDF/Offsets", {ends.size(), 0}, ends);
  writer.dataset("/VTKHDF/Types", {all, 0}, std::vector<std::uint8_t>(all, kVtkTriangle));
  write_steps(writer, "PointData", layout.vertices, offsets);
  return steps;
}

/// A frame without a free surface has no group.
void write_surface(hdf5::FileWriter& writer, const Stamp& stamp, const FlowFrameSource& frames,
                   const FlowLayout& layout) {
  write_stamp(writer, "surface", stamp);
  write_time(writer, layout);
  for (std::size_t k = 0; k < frames.count; ++k) {
    std::vector<Array> arrays = frames.load(k).surface;
    for (Array& array : arrays) array.info.name = leaf(array);
    write_arrays(writer, step_path("steps", k), arrays);
  }
}

}  // namespace

void write_flow_frames(const std::filesystem::path& folder, const Stamp& stamp, const FlowFrameSource& frames) {
  if (frames.count == 0) return;
  const FlowLayout layout = layout_of(frames);
  std::vector<XdmfStep> steps;
  seal(folder / kFlowFile, hdf5::Storage::packed,
       [&](hdf5::FileWriter& writer) { steps = write_mesh(writer, stamp, frames, layout); });
  write_text(folder / "flow.xdmf", xdmf(kFlowFile, steps));
  if (layout.surface.arrays.empty()) return;
  seal(folder / kSurfaceFile, hdf5::Storage::packed,
       [&](hdf5::FileWriter& writer) { write_surface(writer, stamp, frames, layout); });
}

std::vector<double> read_flow_times(const std::filesystem::path& folder, const Stamp& stamp) {
  hdf5::FileReader reader(folder / kFlowFile);
  check_stamp(reader, "flow", stamp);
  std::vector<double> times = reader.read<double>("/frames/time");
  reader.close();
  return times;
}

FlowFrame read_flow_frame(const std::filesystem::path& folder, const Stamp& stamp, std::size_t index,
                          bool with_surface) {
  FlowFrame frame;
  hdf5::FileReader reader(folder / kFlowFile);
  check_stamp(reader, "flow", stamp);
  frame.time = reader.read<double>("/frames/time").at(index);
  for (Array& array : read_arrays(reader, step_path("steps", index))) {
    const bool is_corner = array.info.name == kCorner;
    array.info.name = (is_corner ? "triangles/" : "vertices/") + array.info.name;
    if (is_vector_in_space(array)) to_plane(array);
    (is_corner ? frame.triangles : frame.vertices).push_back(std::move(array));
  }
  reader.close();
  if (!with_surface) return frame;

  hdf5::FileReader beside(folder / kSurfaceFile);
  check_stamp(beside, "surface", stamp);
  frame.surface = read_arrays(beside, step_path("steps", index));
  for (Array& array : frame.surface) array.info.name = "surface/" + array.info.name;
  beside.close();
  return frame;
}

}  // namespace seapile::store
