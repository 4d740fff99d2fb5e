#include "tests/runner/store/sample_run.h"

#include <limits>

#include "runner/store/sha256.h"

namespace seapile::store::sample {

namespace {

using simulation::Array;
using simulation::Entity;
using simulation::Frame;
using simulation::Record;

/// Rows of equal stream differ by their index, rows of equal index by their stream.
std::vector<double> values(std::uint64_t stream, std::size_t count, double low, double high) {
  std::vector<double> list(count);
  for (std::size_t i = 0; i < count; ++i) list[i] = low + (high - low) * uniform(stream, i);
  return list;
}

std::vector<std::int64_t> ids(std::size_t count) {
  std::vector<std::int64_t> list(count);
  for (std::size_t i = 0; i < count; ++i) list[i] = static_cast<std::int64_t>(i);
  return list;
}

constexpr const char* kBedScene =
    R"("bed":{"domain":{"gravity":9.81,"height":4,"width":5},"file":"","grains":{"count":50,"density":1500,)"
    R"("friction":{"grain":0.5,"wall":0},"radius":{"max":0.0192,"min":0.0112},"restitution":0},"preparation":)"
    R"({"contact":{"damping":10,"precision":"single","step":0.0005,"stiffness":0.125,"substeps":10},"longest":12,)"
    R"("solid_fraction":null,"tolerance":0.001},"seed":7},"contact":{"damping":10,"precision":"single",)"
    R"("step":0.0005,"stiffness":0.125,"substeps":10},"fluid":null)";

std::vector<simulation::Part> parts(bool with_pile) {
  return {
      {"grains", true, "every scene has grains"},
      {"walls", true, "every scene has a box"},
      {"pile", with_pile, with_pile ? "the scene has a pile" : "the scene has no pile"},
      {"mesh", false, "a dry scene has no mesh", scene::By::asked, scene::Criterion{"share", 0.25, 0.5, 1e-3, "mean"}},
      {"fluid", false, "the scene has no fluid"}};
}

std::vector<Array> bed_grains() {
  return {{{"grains/id", "-", "number of the grain", 1, Entity::grain}, ids(kGrains)},
          {{"grains/position", "m", "place of the centre", 2, Entity::grain}, values(1, 2 * kGrains, -2.5, 4)},
          {{"grains/radius", "m", "radius", 1, Entity::grain}, values(2, kGrains, 1.12e-2, 1.92e-2)}};
}

}  // namespace

double uniform(std::uint64_t stream, std::uint64_t index) {
  // Splitmix64.
  std::uint64_t z = stream * 0xD1B54A32D192ED03U + (index + 1) * 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

RunHeader bed_header() {
  RunHeader header;
  header.kind = "bed";
  header.canonical = R"({"file_content":"","grains":{"count":50},"seed":7})";
  header.case_id = sha256(header.canonical);
  header.scene_json = "{" + std::string(kBedScene) + R"(,"pile":null})";
  header.parts = parts(false);
  header.numerics = {{"grains", 1}, {"scene", 1}};
  return header;
}

RunHeader drive_header() {
  RunHeader header = bed_header();
  header.bed_id = header.case_id;
  header.bed_run = "0001";
  header.kind = "drive";
  header.canonical = R"({"bed":")" + header.bed_id + R"(","pile":{"radius":0.125}})";
  header.case_id = sha256(header.canonical);
  header.scene_json = "{" + std::string(kBedScene) +
                      R"(,"pile":{"depth":1.2,"driving":{"constant":{"speed":0.06}},"duration":null,"friction":0.5,)"
                      R"("radius":0.125,"tip":{"flat":{}}}})";
  header.record_json = R"({"frames":[0,0.2],"spacing":0.05,"travel":0.0005,"window":0.01})";
  header.parts = parts(true);
  header.numerics = {{"grains", 1}, {"pile", 2}, {"scene", 1}};
  return header;
}

Record record(std::size_t index) {
  Record record;
  std::uint64_t column = 0;
  columns([&](const char*, const char*, const char*, double& value) { value = uniform(100 + column++, index) * 1e4; },
          record);
  record.time = 0.05 * static_cast<double>(index + 1);
  record.depth = 5e-4 * static_cast<double>(index + 1);
  return record;
}

std::vector<Record> records(std::size_t first, std::size_t count) {
  std::vector<Record> list;
  for (std::size_t i = first; i < first + count; ++i) list.push_back(record(i));
  return list;
}

Frame frame(std::size_t index, std::size_t contacts) {
  const std::uint64_t s = 1000 * (index + 1);
  Frame frame;
  frame.time = 0.5 * static_cast<double>(index);
  frame.depth = 0.2 * static_cast<double>(index) + 1e-4;
  frame.asked = 0.2 * static_cast<double>(index);
  const auto grain = [&](const char* name, const char* unit, const char* meaning, int columns, double low,
                         double high) {
    frame.grains.push_back({{name, unit, meaning, columns, Entity::grain},
                            values(s + frame.grains.size(), kGrains * static_cast<std::size_t>(columns), low, high)});
  };
  frame.grains.push_back({{"grains/id", "-", "number of the grain", 1, Entity::grain}, ids(kGrains)});
  grain("grains/position", "m", "place of the centre", 2, -2.5, 4);
  grain("grains/radius", "m", "radius", 1, 1.12e-2, 1.92e-2);
  grain("grains/velocity", "m/s", "velocity of the centre", 2, -0.1, 0.1);
  grain("grains/spin", "rad/s", "angular velocity", 1, -1, 1);
  grain("grains/displacement", "m", "displacement since the start", 2, -0.05, 0.05);

  const auto contact = [&](const char* name, const char* unit, const char* meaning, double low, double high) {
    frame.contacts.push_back(
        {{name, unit, meaning, 2, Entity::contact}, values(s + 100 + frame.contacts.size(), 2 * contacts, low, high)});
  };
  std::vector<std::int64_t> pairs(2 * contacts);
  for (std::size_t i = 0; i < contacts; ++i) {
    pairs[2 * i] = static_cast<std::int64_t>(i % kGrains);
    pairs[2 * i + 1] = static_cast<std::int64_t>((3 * i + index) % (kGrains + 5)) - 5;
  }
  frame.contacts.push_back(
      {{"contacts/grain", "-", "the two grains; negative: wall, base or pile", 2, Entity::contact}, pairs});
  contact("contacts/position", "m", "point of contact", -2.5, 4);
  contact("contacts/normal", "-", "unit normal from the first to the second", -1, 1);
  contact("contacts/force", "N/m", "normal and tangential force", 0, 500);

  frame.grid = {-0.25, 0, 0.05, 10, 8};
  const auto cell = [&](const char* name, const char* unit, const char* meaning, int columns, double low, double high) {
    frame.cells.push_back({{name, unit, meaning, columns, Entity::cell},
                           values(s + 200 + frame.cells.size(), 80 * static_cast<std::size_t>(columns), low, high)});
  };
  cell("cells/porosity", "-", "share of the cell outside grains", 1, 0.1, 1);
  cell("cells/stress", "Pa", "stress xx, yy, xy; compression positive", 3, -1e4, 1e5);
  cell("cells/principal_stress", "Pa", "major and minor principal stress", 2, 0, 1e5);
  cell("cells/principal_direction", "rad", "angle of the major principal stress from x", 1, -1.5, 1.5);
  return frame;
}

std::vector<Array> state(std::size_t index) {
  const std::uint64_t s = 5000 + 10 * index;
  std::vector<float> impulses;
  for (const double value : values(s, 64, -1, 1)) impulses.push_back(static_cast<float>(value));
  std::vector<std::int32_t> order;
  for (const double value : values(s + 1, kGrains, 0, 50)) order.push_back(static_cast<std::int32_t>(value));
  return {{{"run/step", "-", "steps done", 1, Entity::run}, std::vector<std::uint64_t>{index}},
          {{"grains/order", "-", "place of each grain in the solver", 1, Entity::grain}, order},
          {{"grains/id", "-", "number of the grain", 1, Entity::grain}, ids(kGrains)},
          {{"grains/position", "m", "place of the centre", 2, Entity::grain}, values(s + 2, 2 * kGrains, -2.5, 4)},
          {{"contacts/impulse", "N s/m", "impulse carried along", 2, Entity::contact}, impulses}};
}

simulation::Bed bed() {
  simulation::Bed bed;
  bed.grains = bed_grains();
  bed.metrics = {{"solid_fraction", 0.8112, "-", "share of the area filled by grains"},
                 {"coordination_number", 3.62, "-", "mean number of contacts of a grain"},
                 {"surface", 1.2071, "m", "height of the bed's surface"}};
  bed.porosity_profile = values(3, 12, 0.15, 0.3);
  bed.records = records(0, 20);
  bed.profile = {{"neighbours", 0.25, 400}, {"contacts", 1.75, 4000}};
  return bed;
}

simulation::RunResult bed_result() {
  const simulation::Bed settled = bed();
  simulation::RunResult result;
  result.time = 3;
  result.depth = std::numeric_limits<double>::quiet_NaN();
  result.state_hash = 0xfedcba9876543210U;
  result.metrics = settled.metrics;
  result.profile = settled.profile;
  return result;
}

simulation::RunResult drive_result() {
  simulation::RunResult result;
  result.time = 20.01;
  result.depth = 1.2;
  result.state_hash = 0x0123456789abcdefU;
  result.metrics = {
      {"tip_resistance_mean", 81234.5, "Pa", "mean q_c over 0.2 m to 1.2 m of depth"},
      {"tip_resistance_fluctuation", 9120.25, "Pa", "standard deviation of detrended q_c"},
      {"overlap_max", 0.0132, "-", "largest overlap of the run"},
      {"tip_resistance_bin_0.25", std::numeric_limits<double>::quiet_NaN(), "Pa", "bin that was not reached"}};
  result.profile = {{"neighbours", 2.5, 4000}, {"contacts", 30.25, 40000}, {"frames", 0.5, 2}};
  return result;
}

Provenance provenance() {
  Provenance made;
  made.version = "0.1.0";
  made.commit = "0000000000000000000000000000000000000000";
  made.compiler = "GNU 12.2.0";
  made.flags = "-ffp-contract=off";
  made.build_type = "Release";
  made.libraries = "HDF5 1.10.8";
  made.host_cpu = "a processor";
  made.cores = 2;
  made.threads = 2;
  made.simd = "avx2";
  made.cpu_seconds = 41.5;
  made.wall_seconds = 21.25;
  made.peak_memory_mb = 64;
  return made;
}

Written write(const std::filesystem::path& root, std::size_t count) {
  const RunHeader of_bed = bed_header(), of_drive = drive_header();
  const Written written{case_folder(root, of_bed.case_id) / "0001", case_folder(root, of_drive.case_id) / "0001"};
  const simulation::Bed settled = bed();
  RunWriter(written.bed, of_bed).finish(bed_result(), provenance(), &settled);

  RunWriter writer(written.drive, of_drive);
  writer.add(frame(0));
  for (std::size_t i = 0; i < count; ++i) {
    writer.add(record(i));
    if (i == count / 2) writer.checkpoint(state(i));
  }
  writer.add(frame(1));
  writer.finish(drive_result(), provenance(), nullptr);
  return written;
}

std::string difference(const std::vector<Record>& a, const std::vector<Record>& b) {
  return same_bits(a, b) ? "" : "records";
}

std::string difference(const std::vector<Array>& a, const std::vector<Array>& b) {
  if (a.size() != b.size()) return "number of arrays";
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto &x = a[i].info, &y = b[i].info;
    if (x.name != y.name || x.unit != y.unit || x.meaning != y.meaning || x.columns != y.columns ||
        x.entity != y.entity || a[i].values.index() != b[i].values.index()) {
      return "what is said of " + x.name;
    }
    const bool same = std::visit(
        [&]<class T>(const std::vector<T>& v) { return same_bits(v, std::get<std::vector<T>>(b[i].values)); },
        a[i].values);
    if (!same) return "values of " + x.name;
  }
  return "";
}

std::string difference(const Frame& a, const Frame& b) {
  if (a.time != b.time || a.depth != b.depth || a.asked != b.asked) return "time or depth";
  const Frame::Grid &g = a.grid, &h = b.grid;
  if (g.x0 != h.x0 || g.y0 != h.y0 || g.spacing != h.spacing || g.nx != h.nx || g.ny != h.ny) return "grid";
  return difference(a.grains, b.grains) + difference(a.contacts, b.contacts) + difference(a.cells, b.cells);
}

std::string difference(const simulation::Bed& a, const simulation::Bed& b) {
  if (!same_bits(a.porosity_profile, b.porosity_profile) || a.profile_spacing != b.profile_spacing) return "porosity";
  if (a.metrics.size() != b.metrics.size() || a.profile.size() != b.profile.size()) return "number of metrics or parts";
  for (std::size_t i = 0; i < a.metrics.size(); ++i) {
    const auto &m = a.metrics[i], &n = b.metrics[i];
    const bool same_value = std::memcmp(&m.value, &n.value, sizeof m.value) == 0;
    if (m.name != n.name || !same_value || m.unit != n.unit || m.meaning != n.meaning) return "metric " + m.name;
  }
  for (std::size_t i = 0; i < a.profile.size(); ++i) {
    const auto &p = a.profile[i], &q = b.profile[i];
    if (p.part != q.part || p.seconds != q.seconds || p.calls != q.calls) return "cost of " + p.part;
  }
  return difference(a.grains, b.grains) + difference(a.records, b.records);
}

}  // namespace seapile::store::sample
