#include "runner/store/segment.h"

#include <cstdio>
#include <set>
#include <stdexcept>

#include "runner/store/arrays.h"
#include "runner/store/seal.h"
#include "runner/store/series.h"

namespace seapile::store {

namespace {

using simulation::Array;
using simulation::Frame;

constexpr int kGridColumns = 5;  // x0, y0, spacing, nx, ny
constexpr std::size_t kDigestDigits = 64;

std::string frame_group(std::size_t index) {
  char name[32];
  std::snprintf(name, sizeof name, "/frame/%05zu", index);
  return name;
}

void require_list(const std::vector<Array>& arrays, const std::string& prefix, const std::string& position) {
  std::set<std::string> names;
  for (const Array& array : arrays) {
    const std::string& name = array.info.name;
    if (!name.starts_with(prefix) || name.size() == prefix.size() || name.find('/', prefix.size()) != name.npos) {
      throw std::logic_error("a frame's array \"" + name + "\" should be named " + prefix + "...");
    }
    if (!names.insert(name).second) throw std::logic_error("a frame has two arrays " + name);
    if (row_count(array) != row_count(arrays.front())) throw std::logic_error(name + " has another number of rows");
  }
  if (!position.empty() && !arrays.empty() && !names.contains(position)) {
    throw std::logic_error("a frame has no " + position);
  }
}

std::vector<Array> read_list(const hdf5::FileReader& reader, const std::string& group, const std::string& name) {
  std::vector<Array> arrays = read_arrays(reader, group + "/" + name);
  for (Array& array : arrays) array.info.name = name + "/" + array.info.name;
  return arrays;
}

}  // namespace

void require_well_formed(const Frame& frame) {
  require_list(frame.grains, "grains/", "grains/position");
  require_list(frame.contacts, "contacts/", "contacts/position");
  require_list(frame.cells, "cells/", "");
  const auto cells = static_cast<std::size_t>(frame.grid.nx) * static_cast<std::size_t>(frame.grid.ny);
  if (frame.grid.nx < 0 || frame.grid.ny < 0 || (!frame.cells.empty() && row_count(frame.cells.front()) != cells)) {
    throw std::logic_error("a frame's cells are not those of its grid");
  }
}

void write_segment(const std::filesystem::path& file, const Stamp& stamp,
                   const std::vector<simulation::Record>& records, const std::vector<Frame>& frames) {
  seal(file, hdf5::Storage::plain, [&](hdf5::FileWriter& writer) {
    write_stamp(writer, "segment", stamp);
    write_series(writer, "/series", records);
    std::vector<double> time, depth, asked, grid;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const Frame& frame = frames[i];
      time.push_back(frame.time);
      depth.push_back(frame.depth);
      asked.push_back(frame.asked);
      const Frame::Grid& g = frame.grid;
      grid.insert(grid.end(), {g.x0, g.y0, g.spacing, static_cast<double>(g.nx), static_cast<double>(g.ny)});
      for (const auto* list : {&frame.grains, &frame.contacts, &frame.cells}) {
        write_arrays(writer, frame_group(i), *list);
      }
    }
    writer.dataset("/frames/time", {frames.size(), 0}, time);
    writer.dataset("/frames/depth", {frames.size(), 0}, depth);
    writer.dataset("/frames/asked", {frames.size(), 0}, asked);
    writer.dataset("/frames/grid", {frames.size(), kGridColumns}, grid);
  });
}

std::vector<simulation::Record> segment_records(const std::filesystem::path& file, const Stamp& stamp) {
  hdf5::FileReader reader(file);
  check_stamp(reader, "segment", stamp);
  std::vector<simulation::Record> records = read_series(reader, "/series");
  reader.close();
  return records;
}

std::size_t segment_frame_count(const std::filesystem::path& file, const Stamp& stamp) {
  hdf5::FileReader reader(file);
  check_stamp(reader, "segment", stamp);
  const std::size_t count = reader.extents("/frames/time").rows;
  reader.close();
  return count;
}

Frame segment_frame(const std::filesystem::path& file, const Stamp& stamp, std::size_t index) {
  hdf5::FileReader reader(file);
  check_stamp(reader, "segment", stamp);
  const std::vector<double> grid = reader.read<double>("/frames/grid");
  const double* g = &grid.at(index * kGridColumns);
  Frame frame;
  frame.time = reader.read<double>("/frames/time").at(index);
  frame.depth = reader.read<double>("/frames/depth").at(index);
  frame.asked = reader.read<double>("/frames/asked").at(index);
  frame.grid = {g[0], g[1], g[2], static_cast<int>(g[3]), static_cast<int>(g[4])};
  frame.grains = read_list(reader, frame_group(index), "grains");
  frame.contacts = read_list(reader, frame_group(index), "contacts");
  frame.cells = read_list(reader, frame_group(index), "cells");
  reader.close();
  return frame;
}

void write_checkpoint(const std::filesystem::path& file, const Stamp& stamp, const Checkpoint& checkpoint) {
  std::vector<std::uint8_t> digests;
  for (const std::string& digest : checkpoint.segments) digests.insert(digests.end(), digest.begin(), digest.end());
  seal(file, hdf5::Storage::plain, [&](hdf5::FileWriter& writer) {
    write_stamp(writer, "checkpoint", stamp);
    writer.attribute("/", "generation", checkpoint.generation);
    writer.dataset("/segments", {checkpoint.segments.size(), kDigestDigits}, digests);
    write_arrays(writer, "/state", checkpoint.state);
  });
}

Checkpoint read_checkpoint(const std::filesystem::path& file, const Stamp& stamp) {
  hdf5::FileReader reader(file);
  check_stamp(reader, "checkpoint", stamp);
  Checkpoint checkpoint;
  checkpoint.generation = reader.attribute<std::int64_t>("/", "generation");
  const std::vector<std::uint8_t> digests = reader.read<std::uint8_t>("/segments");
  for (std::size_t i = 0; i + kDigestDigits <= digests.size(); i += kDigestDigits) {
    checkpoint.segments.emplace_back(digests.begin() + i, digests.begin() + i + kDigestDigits);
  }
  checkpoint.state = read_arrays(reader, "/state");
  reader.close();
  return checkpoint;
}

}  // namespace seapile::store
