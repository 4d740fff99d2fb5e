#include "tests/runner/store/sample_flow.h"

#include <limits>

#include "runner/store/sha256.h"

namespace seapile::store::sample {

namespace {

using simulation::Array;
using simulation::ArrayInfo;
using simulation::Entity;
using simulation::FlowFrame;
using simulation::FlowRecord;

/// Values of an array with so many rows, others for every stream.
Array filled(ArrayInfo info, std::uint64_t stream, std::size_t rows, double low, double high) {
  std::vector<double> values(rows * static_cast<std::size_t>(info.columns));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = low + (high - low) * uniform(stream, i);
  return {std::move(info), std::move(values)};
}

/// The rectangles of a grid, each cut into two triangles, counter-clockwise.
std::vector<std::int64_t> corners(std::int64_t nx, std::int64_t ny) {
  std::vector<std::int64_t> rows;
  for (std::int64_t j = 0; j < ny; ++j) {
    for (std::int64_t i = 0; i < nx; ++i) {
      const std::int64_t corner = j * (nx + 1) + i, above = corner + nx + 1;
      rows.insert(rows.end(), {corner, corner + 1, above + 1, corner, above + 1, above});
    }
  }
  return rows;
}

std::vector<double> positions(std::int64_t nx, std::int64_t ny, std::uint64_t stream) {
  std::vector<double> places;
  for (std::int64_t j = 0; j <= ny; ++j) {
    for (std::int64_t i = 0; i <= nx; ++i) {
      places.push_back(-1 +
                       (2 * static_cast<double>(i) + 0.2 * uniform(stream, places.size())) / static_cast<double>(nx));
      places.push_back((static_cast<double>(j) + 0.2 * uniform(stream, places.size())) / static_cast<double>(ny));
    }
  }
  return places;
}

}  // namespace

RunHeader flow_header() {
  RunHeader header;
  header.kind = "flow";
  header.canonical = R"({"flow":{"gap":0.02}})";
  header.case_id = sha256(header.canonical);
  header.scene_json =
      R"({"domain":{"height":1,"width":2},"inflow":{"parabola":{"speed":0.5}},"mesh":{"size":0.05},"surface":null})";
  header.record_json = R"({"frames":[0,0.5,1]})";
  header.parts = {{"mesh", true, "a flow has a mesh"}, {"fluid", true, "a flow has a fluid"}};
  header.numerics = {{"fluid", 1}, {"mesh", 3}};
  return header;
}

RunHeader basin_header() {
  RunHeader header = flow_header();
  header.canonical = R"({"basin":{"width":1}})";
  header.case_id = sha256(header.canonical);
  header.scene_json = header.canonical;
  header.record_json = R"({"interval":0.05,"times":[0.5]})";
  header.numerics.push_back({"basin", 1});
  return header;
}

FlowRecord saturated_record(std::size_t index) {
  FlowRecord record;
  std::uint64_t column = 0;
  columns([&](const char*, const char*, const char*,
              double& value) { value = uniform(80'000 + column++, index) * 2e-3 - 1e-3; },
          record);
  record.time = 0.05 * static_cast<double>(index);
  return record;
}

FlowRecord flow_record(std::size_t index) {
  FlowRecord record = saturated_record(index);
  bool of_bed = false;  // From the first column of a saturated bed on.
  columns(
      [&](const std::string& name, const char*, const char*, double& value) {
        of_bed = of_bed || name == "tip_force_x";
        if (of_bed || name.starts_with("pile_")) value = FlowRecord::kAbsent;
      },
      record);
  if (index % 4 == 1) record.middle = FlowRecord::kAbsent;
  return record;
}

std::vector<FlowRecord> flow_records(std::size_t first, std::size_t count) {
  std::vector<FlowRecord> list;
  for (std::size_t i = first; i < first + count; ++i) list.push_back(flow_record(i));
  return list;
}

simulation::RunResult flow_result() {
  simulation::RunResult result;
  result.time = 1;
  result.depth = std::numeric_limits<double>::quiet_NaN();
  result.state_hash = 0x0f1e2d3c4b5a6978U;
  result.metrics = {{"jet_thickness", 0.0125, "m", "thickness of the jet far downstream"},
                    {"iterations", 7, "-", "of the solver"}};
  result.profile = {{"flow", 12.5, 200}};
  return result;
}

FlowFrame flow_frame(std::size_t index) {
  const std::uint64_t s = 90'000 + 100 * index;
  const auto nx = static_cast<std::int64_t>(5 + 3 * index), ny = static_cast<std::int64_t>(4 + index % 2);
  const auto vertices = static_cast<std::size_t>((nx + 1) * (ny + 1));
  FlowFrame frame;
  frame.time = 0.5 * static_cast<double>(index);
  frame.vertices.push_back(
      {{"vertices/position", "m", "place of the vertex", 2, Entity::vertex}, positions(nx, ny, s)});
  const auto add = [&](ArrayInfo info, double low, double high) {
    frame.vertices.push_back(filled(std::move(info), s + frame.vertices.size(), vertices, low, high));
  };
  add({"vertices/velocity", "m/s", "superficial velocity", 2, Entity::vertex}, -1, 1);
  add({"vertices/pressure", "Pa", "pressure", 1, Entity::vertex}, -1e3, 1e4);
  add({"vertices/porosity", "-", "share that is outside grains", 1, Entity::vertex}, 0.2, 1);
  add({"vertices/mesh_velocity", "m/s", "velocity of the vertex", 2, Entity::vertex}, -0.1, 0.1);
  frame.triangles.push_back(
      {{"triangles/corner", "-", "rows of its vertices, counterclockwise", 3, Entity::triangle}, corners(nx, ny)});
  if (index % 3 == 1) return frame;

  const auto points = static_cast<std::size_t>(nx) + 1;
  std::vector<std::int64_t> top(points);
  for (std::size_t i = 0; i < points; ++i) top[i] = static_cast<std::int64_t>(vertices - points + i);
  frame.surface.push_back({{"surface/vertex", "-", "row of the vertex", 1, Entity::surface}, top});
  const auto add_to_surface = [&](ArrayInfo info, double low, double high) {
    frame.surface.push_back(filled(std::move(info), s + 50 + frame.surface.size(), points, low, high));
  };
  add_to_surface({"surface/x", "m", "place", 1, Entity::surface}, -1, 1);
  add_to_surface({"surface/height", "m", "height", 1, Entity::surface}, 0.9, 1.1);
  add_to_surface({"surface/curvature", "1/m", "curvature", 1, Entity::surface}, -20, 20);
  add_to_surface({"surface/normal_velocity", "m/s", "velocity along the outward normal", 1, Entity::surface}, -1, 1);
  return frame;
}

std::filesystem::path write_flow(const std::filesystem::path& root) {
  std::filesystem::path folder = case_folder(root, flow_header().case_id) / "0001";
  RunWriter writer(folder, flow_header());
  for (std::size_t k = 0; k < kFlowFrames; ++k) {
    writer.add(flow_frame(k));
    if (k == 1) writer.checkpoint(state(k));
  }
  writer.finish(flow_result(), provenance(), nullptr);
  return folder;
}

std::string difference(const std::vector<FlowRecord>& a, const std::vector<FlowRecord>& b) {
  return same_bits(a, b) ? "" : "records of the water";
}

std::string difference(const FlowFrame& a, const FlowFrame& b) {
  if (a.time != b.time) return "time";
  return difference(a.vertices, b.vertices) + difference(a.triangles, b.triangles) + difference(a.surface, b.surface);
}

}  // namespace seapile::store::sample
