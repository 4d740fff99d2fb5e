#include "runner/store/frames_file.h"

#include <array>

#include "runner/store/arrays.h"
#include "runner/store/durable.h"
#include "runner/store/run_folder.h"
#include "runner/store/seal.h"
#include "runner/store/vtk_file.h"

namespace seapile::store {

namespace {

using simulation::Array;
using simulation::Frame;

constexpr std::uint8_t kVtkQuad = 9;  // vtkCellType.h
// The order of the topologies in the columns of a step's offsets, as VTKHDF defines it.
constexpr std::array kTopologies = {"Vertices", "Lines", "Polygons", "Strips"};

/// Begins the file, and says at which depths its frames are.
void write_head(hdf5::FileWriter& writer, const std::string& content, const std::string& type, const Stamp& stamp,
                const FrameLayout& layout) {
  write_head(writer, content, type, stamp);
  write_per_frame(writer, "time", "s", "time of the frame", layout.time);
  write_per_frame(writer, "depth", "m", "depth d of the tip below the initial bed surface", layout.depth);
  write_per_frame(writer, "asked", "m", "depth that was asked for", layout.asked);
}

/// One of the lists of each frame.
ListSource list_of(const FrameSource& frames, FrameList list) {
  return [&frames, list](std::size_t k) { return frames.load(k).*list; };
}

/// A file of points, one vertex cell each. Each drawn step is a part.
std::vector<XdmfStep> write_points(hdf5::FileWriter& writer, const std::string& content, const Stamp& stamp,
                                   const FrameSource& frames, FrameList list) {
  const FrameLayout layout = layout_of(frames, list);
  write_head(writer, content, "PolyData", stamp, layout);
  std::vector<XdmfStep> steps = write_values(writer, "PointData", layout, layout.time, list_of(frames, list));
  if (layout.arrays.empty()) writer.dataset("/VTKHDF/Points", {0, 3}, std::vector<double>{});

  const std::string vertices = std::string("/VTKHDF/") + kTopologies.front();
  writer.create(vertices + "/Connectivity", hdf5::Number::i64, {layout.total_rows, 0});
  Integers counts, ends;
  StepOffsets offsets;
  for (std::size_t k = 0; k < frames.count; ++k) {
    const std::size_t count = layout.rows[k];
    Integers points(count + 1);
    for (std::size_t i = 0; i <= count; ++i) points[i] = whole(i);
    const std::uint64_t hash =
        writer.append(vertices + "/Connectivity", std::span<const std::int64_t>(points).first(count));
    const std::string cells = step_path("vertices", k);
    writer.window(cells, vertices + "/Connectivity", layout.first_row[k], {count, 0}, hash);
    steps[k].cells = {cells, "vertices", hdf5::Number::i64, {count, 0}};
    if (count == 0) continue;
    const std::int64_t first = whole(layout.first_row[k]);
    offsets.time.push_back(layout.time[k]);
    offsets.parts.push_back(whole(counts.size()));
    offsets.points.push_back(first);
    offsets.rows.push_back(first);
    offsets.cells.insert(offsets.cells.end(), {first, 0, 0, 0});
    counts.push_back(whole(count));
    ends.insert(ends.end(), points.begin(), points.end());
  }
  offsets.connectivities = offsets.cells;  // A vertex has one point.

  const std::size_t parts = counts.size();
  writer.dataset("/VTKHDF/NumberOfPoints", {parts, 0}, counts);
  for (const std::string topology : kTopologies) {
    const bool is_used = topology == kTopologies.front();
    const std::string group = "/VTKHDF/" + topology;
    writer.dataset(group + "/NumberOfCells", {parts, 0}, is_used ? counts : Integers(parts, 0));
    writer.dataset(group + "/NumberOfConnectivityIds", {parts, 0}, is_used ? counts : Integers(parts, 0));
    writer.dataset(group + "/Offsets", {is_used ? ends.size() : parts, 0}, is_used ? ends : Integers(parts, 0));
    if (!is_used) writer.dataset(group + "/Connectivity", {0, 0}, Integers{});
  }
  write_steps(writer, "PointData", layout, offsets);
  return steps;
}

/// The grid's points, row by row, and the four corners of each cell, counter-clockwise.
std::vector<double> grid_points(const Frame::Grid& grid) {
  std::vector<double> points;
  for (int j = 0; j <= grid.ny; ++j) {
    for (int i = 0; i <= grid.nx; ++i) {
      points.insert(points.end(), {grid.x0 + i * grid.spacing, grid.y0 + j * grid.spacing, 0});
    }
  }
  return points;
}

Integers grid_corners(const Frame::Grid& grid) {
  Integers corners;
  const std::int64_t row = grid.nx + 1;
  for (std::int64_t j = 0; j < grid.ny; ++j) {
    for (std::int64_t i = 0; i < grid.nx; ++i) {
      const std::int64_t corner = j * row + i;
      corners.insert(corners.end(), {corner, corner + 1, corner + row + 1, corner + row});
    }
  }
  return corners;
}

/// A file of the grid's cells: one mesh, which is the one part of every step.
std::vector<XdmfStep> write_cells(hdf5::FileWriter& writer, const Stamp& stamp, const FrameSource& frames) {
  const FrameLayout layout = layout_of(frames, &Frame::cells);
  const Frame::Grid& grid = layout.grid;
  write_head(writer, "fields", "UnstructuredGrid", stamp, layout);
  writer.dataset("/grid/corner", {2, 0}, std::vector<double>{grid.x0, grid.y0});
  writer.dataset("/grid/spacing", {1, 0}, std::vector<double>{grid.spacing});
  writer.dataset("/grid/cells", {2, 0}, Integers{grid.nx, grid.ny});
  std::vector<XdmfStep> steps = write_values(writer, "CellData", layout, layout.time, list_of(frames, &Frame::cells));

  const std::vector<double> points = grid_points(grid);
  const Integers corners = grid_corners(grid);
  const std::size_t point_count = points.size() / 3, cell_count = corners.size() / 4;
  Integers ends;
  for (std::size_t i = 0; i <= cell_count; ++i) ends.push_back(whole(4 * i));
  writer.dataset("/VTKHDF/NumberOfPoints", {1, 0}, Integers{whole(point_count)});
  writer.dataset("/VTKHDF/NumberOfCells", {1, 0}, Integers{whole(cell_count)});
  writer.dataset("/VTKHDF/NumberOfConnectivityIds", {1, 0}, Integers{whole(corners.size())});
  writer.dataset("/VTKHDF/Points", {point_count, 3}, points);
  writer.dataset("/VTKHDF/Connectivity", {corners.size(), 0}, corners);
  writer.dataset("/VTKHDF/Offsets", {ends.size(), 0}, ends);
  writer.dataset("/VTKHDF/Types", {cell_count, 0}, std::vector<std::uint8_t>(cell_count, kVtkQuad));
  // The sidecar wants the corners of a cell in a row.
  writer.dataset("/grid/corners", {cell_count, 4}, corners);

  StepOffsets offsets;
  for (std::size_t k = 0; k < frames.count; ++k) {
    steps[k].points = {"/VTKHDF/Points", "points", hdf5::Number::f64, {point_count, 3}};
    steps[k].cells = {"/grid/corners", "corners", hdf5::Number::i64, {cell_count, 4}};
    steps[k].of_cells = true;
    if (cell_count == 0) continue;
    offsets.time.push_back(layout.time[k]);
    offsets.rows.push_back(whole(layout.first_row[k]));
  }
  offsets.parts = offsets.points = offsets.cells = offsets.connectivities = Integers(offsets.time.size(), 0);
  write_steps(writer, "CellData", layout, offsets);
  return steps;
}

/// One kind of entity of a frame; its file also says what belongs to the whole frame.
std::vector<Array> read_list(const std::filesystem::path& folder, const std::string& content, const std::string& prefix,
                             const Stamp& stamp, std::size_t index, Frame& frame) {
  hdf5::FileReader reader(folder / (content + ".vtkhdf"));
  check_stamp(reader, content, stamp);
  frame.time = reader.read<double>("/frames/time").at(index);
  frame.depth = reader.read<double>("/frames/depth").at(index);
  frame.asked = reader.read<double>("/frames/asked").at(index);
  if (content == "fields") {
    const auto corner = reader.read<double>("/grid/corner");
    const auto cells = reader.read<std::int64_t>("/grid/cells");
    frame.grid = {corner.at(0), corner.at(1), reader.read<double>("/grid/spacing").at(0), static_cast<int>(cells.at(0)),
                  static_cast<int>(cells.at(1))};
  }
  std::vector<Array> arrays = read_arrays(reader, step_path("steps", index));
  reader.close();
  for (Array& array : arrays) {
    array.info.name = prefix + "/" + array.info.name;
    if (is_vector_in_space(array)) to_plane(array);
  }
  return arrays;
}

}  // namespace

void write_frames(const std::filesystem::path& folder, const Stamp& stamp, const FrameSource& frames) {
  if (frames.count == 0) return;
  const auto write = [&](const std::string& content, const auto& fill) {
    const std::string name = content + ".vtkhdf";
    std::vector<XdmfStep> steps;
    seal(folder / name, hdf5::Storage::packed, [&](hdf5::FileWriter& writer) { steps = fill(writer); });
    write_text(folder / (content + ".xdmf"), xdmf(name, steps));
  };
  write("grains", [&](auto& writer) { return write_points(writer, "grains", stamp, frames, &Frame::grains); });
  write("contacts", [&](auto& writer) { return write_points(writer, "contacts", stamp, frames, &Frame::contacts); });
  write("fields", [&](auto& writer) { return write_cells(writer, stamp, frames); });
}

Frame read_frame(const std::filesystem::path& folder, const Stamp& stamp, std::size_t index) {
  Frame frame;
  frame.grains = read_list(folder, "grains", "grains", stamp, index, frame);
  frame.contacts = read_list(folder, "contacts", "contacts", stamp, index, frame);
  frame.cells = read_list(folder, "fields", "cells", stamp, index, frame);
  return frame;
}

std::vector<double> read_asked_depths(const std::filesystem::path& folder, const Stamp& stamp) {
  hdf5::FileReader reader(folder / kFrameFiles.front());
  check_stamp(reader, "grains", stamp);
  std::vector<double> depths = reader.read<double>("/frames/asked");
  reader.close();
  return depths;
}

}  // namespace seapile::store
