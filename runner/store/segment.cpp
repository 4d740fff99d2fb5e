#include "runner/store/segment.h"

#include <cstdio>

#include "runner/store/arrays.h"
#include "runner/store/seal.h"
#include "runner/store/series.h"

namespace seapile::store {

namespace {

using simulation::Array;
using simulation::FlowFrame;
using simulation::Frame;

constexpr int kGridColumns = 5;  // x0, y0, spacing, nx, ny
constexpr std::size_t kDigestDigits = 64;
const std::string kFlowTime = "/flow_frames/time";  // Only where there are frames of the water.

std::string frame_group(const char* kind, std::size_t index) {
  char name[64];
  std::snprintf(name, sizeof name, "/%s/%05zu", kind, index);
  return name;
}

void write_frames(hdf5::FileWriter& writer, const std::vector<Frame>& frames) {
  std::vector<double> time, depth, asked, grid;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Frame& frame = frames[i];
    time.push_back(frame.time);
    depth.push_back(frame.depth);
    asked.push_back(frame.asked);
    const Frame::Grid& g = frame.grid;
    grid.insert(grid.end(), {g.x0, g.y0, g.spacing, static_cast<double>(g.nx), static_cast<double>(g.ny)});
    for (const auto* list : {&frame.grains, &frame.contacts, &frame.cells}) {
      write_arrays(writer, frame_group("frame", i), *list);
    }
  }
  writer.dataset("/frames/time", {frames.size(), 0}, time);
  writer.dataset("/frames/depth", {frames.size(), 0}, depth);
  writer.dataset("/frames/asked", {frames.size(), 0}, asked);
  writer.dataset("/frames/grid", {frames.size(), kGridColumns}, grid);
}

void write_frames(hdf5::FileWriter& writer, const std::vector<FlowFrame>& frames) {
  std::vector<double> time;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    time.push_back(frames[i].time);
    for (const auto* list : {&frames[i].vertices, &frames[i].triangles, &frames[i].surface}) {
      write_arrays(writer, frame_group("flow_frame", i), *list);
    }
  }
  writer.dataset(kFlowTime, {frames.size(), 0}, time);
  writer.attribute(kFlowTime, "units", "s");
}

std::vector<Array> read_list(const hdf5::FileReader& reader, const std::string& group, const std::string& name) {
  std::vector<Array> arrays = read_arrays(reader, group + "/" + name);
  for (Array& array : arrays) array.info.name = name + "/" + array.info.name;
  return arrays;
}

}  // namespace

void write_segment(const std::filesystem::path& file, const Stamp& stamp, const Segment& segment) {
  seal(file, hdf5::Storage::plain, [&](hdf5::FileWriter& writer) {
    write_stamp(writer, "segment", stamp);
    write_series(writer, segment.records);
    write_frames(writer, segment.frames);
    if (!segment.flow_records.empty()) write_series(writer, segment.flow_records);
    if (!segment.flow_frames.empty()) write_frames(writer, segment.flow_frames);
  });
}

template <class R>
std::vector<R> segment_records(const std::filesystem::path& file, const Stamp& stamp) {
  hdf5::FileReader reader(file);
  check_stamp(reader, "segment", stamp);
  std::vector<R> records;
  if (has_series<R>(reader)) records = read_series<R>(reader);
  reader.close();
  return records;
}
template std::vector<simulation::Record> segment_records(const std::filesystem::path&, const Stamp&);
template std::vector<simulation::FlowRecord> segment_records(const std::filesystem::path&, const Stamp&);

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
  const std::string group = frame_group("frame", index);
  Frame frame;
  frame.time = reader.read<double>("/frames/time").at(index);
  frame.depth = reader.read<double>("/frames/depth").at(index);
  frame.asked = reader.read<double>("/frames/asked").at(index);
  frame.grid = {g[0], g[1], g[2], static_cast<int>(g[3]), static_cast<int>(g[4])};
  frame.grains = read_list(reader, group, "grains");
  frame.contacts = read_list(reader, group, "contacts");
  frame.cells = read_list(reader, group, "cells");
  reader.close();
  return frame;
}

std::size_t segment_flow_frame_count(const std::filesystem::path& file, const Stamp& stamp) {
  hdf5::FileReader reader(file);
  check_stamp(reader, "segment", stamp);
  const std::size_t count = reader.has(kFlowTime) ? reader.extents(kFlowTime).rows : 0;
  reader.close();
  return count;
}

FlowFrame segment_flow_frame(const std::filesystem::path& file, const Stamp& stamp, std::size_t index) {
  hdf5::FileReader reader(file);
  check_stamp(reader, "segment", stamp);
  const std::string group = frame_group("flow_frame", index);
  FlowFrame frame;
  frame.time = reader.read<double>(kFlowTime).at(index);
  frame.vertices = read_list(reader, group, "vertices");
  frame.triangles = read_list(reader, group, "triangles");
  frame.surface = read_list(reader, group, "surface");
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

void write_post_mortem(const std::filesystem::path& file, const Stamp& stamp, const std::vector<Array>& rejected,
                       const std::string& reason) {
  seal(file, hdf5::Storage::packed, [&](hdf5::FileWriter& writer) {
    write_stamp(writer, "post_mortem", stamp);
    writer.attribute("/", "reason", reason);
    write_arrays(writer, "/state", rejected);
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
