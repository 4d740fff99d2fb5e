// Runs with frames of the water: from the writer to the catalogue.
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "runner/store/catalogue.h"
#include "runner/store/durable.h"
#include "tests/runner/store/sample_flow.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using Path = std::filesystem::path;
using sample::difference;
using sample::flow_frame;

std::set<std::string> names(const Path& folder) {
  std::set<std::string> list;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) list.insert(entry.path().filename());
  return list;
}

class Flow : public testing::Test {
 protected:
  RunWriter open() const { return {folder_, sample::flow_header()}; }
  static void finish(RunWriter& writer) { writer.finish(sample::flow_result(), sample::provenance(), nullptr); }

  void expect_frames(std::size_t count) const {
    ASSERT_EQ(flow_frame_count(folder_), count);
    for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(difference(read_flow_frame(folder_, k), flow_frame(k)), "") << k;
    EXPECT_THROW(read_flow_frame(folder_, count), std::out_of_range);
    EXPECT_EQ(verify(folder_), std::vector<std::string>{});
  }

  Scratch scratch_;
  Path folder_ = case_folder(scratch_.path(), sample::flow_header().case_id) / "0001";
};

TEST_F(Flow, GivesItsFramesBackBitForBit) {
  EXPECT_EQ(sample::write_flow(scratch_.path()), folder_);
  expect_frames(sample::kFlowFrames);
  EXPECT_EQ(frame_count(folder_), 0U);
  EXPECT_TRUE(asked_depths(folder_).empty());
  EXPECT_EQ(read_manifest(folder_).header.kind, "flow");
}

TEST_F(Flow, WithoutRecordsHasNoSeries) {
  sample::write_flow(scratch_.path());
  EXPECT_EQ(names(folder_), (std::set<std::string>{"flow.vtkhdf", "flow.xdmf", "manifest.json", "surface.h5"}));
  EXPECT_TRUE(read_series(folder_).empty());
  EXPECT_TRUE(read_flow_series(folder_).empty());
  EXPECT_EQ(read_manifest(folder_).records, 0U);
}

TEST_F(Flow, WithRecordsHasTheirSeries) {
  RunWriter writer = open();
  for (std::size_t i = 0; i < 10; ++i) writer.add(sample::record(i));
  writer.add(flow_frame(0));
  finish(writer);
  EXPECT_EQ(difference(read_series(folder_), sample::records(0, 10)), "");
  expect_frames(1);
}

TEST_F(Flow, WithoutFramesOrFreeSurfaceHasNoFileForThem) {
  {
    RunWriter writer = open();
    finish(writer);
  }
  EXPECT_EQ(names(folder_), (std::set<std::string>{"manifest.json"}));
  expect_frames(0);

  const Path bare = folder_.parent_path() / "0002";
  RunWriter writer(bare, sample::flow_header());
  writer.add(flow_frame(1));
  finish(writer);
  EXPECT_EQ(names(bare), (std::set<std::string>{"flow.vtkhdf", "flow.xdmf", "manifest.json"}));
  EXPECT_EQ(difference(read_flow_frame(bare, 0), flow_frame(1)), "");
}

TEST_F(Flow, CanHaveGrainsBesideTheWater) {
  const Path drive = scratch_.path() / "drive" / "0001";
  RunWriter writer(drive, sample::drive_header());
  for (std::size_t k = 0; k < 2; ++k) {
    writer.add(sample::record(k));
    writer.add(sample::frame(k));
    writer.add(flow_frame(k));
    writer.checkpoint(sample::state(k));
  }
  writer.finish(sample::drive_result(), sample::provenance(), nullptr);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(difference(read_frame(drive, k), sample::frame(k)), "");
    EXPECT_EQ(difference(read_flow_frame(drive, k), flow_frame(k)), "");
  }
  EXPECT_EQ(difference(read_series(drive), sample::records(0, 2)), "");
}

TEST_F(Flow, LeavesTheSameFilesWhetherInterruptedOrNot) {
  {
    RunWriter writer = open();
    writer.add(flow_frame(0));
    writer.checkpoint(sample::state(0));
    writer.add(flow_frame(1));
    writer.checkpoint(sample::state(1));
    writer.add(flow_frame(2));  // Never sealed.
  }
  // Killed while it finished, it had merged files already.
  std::ofstream(folder_ / "flow.vtkhdf") << "whole";
  std::ofstream(folder_ / "surface.h5") << "whole";
  {
    RunWriter writer = open();
    EXPECT_EQ(writer.resumable().flow_frames, 2U);
    EXPECT_EQ(writer.resumable().frames, 0U);
    EXPECT_EQ(difference(writer.resumable().state, sample::state(1)), "");
    EXPECT_EQ(names(folder_), (std::set<std::string>{"checkpoint", "segment"}));
    writer.add(flow_frame(2));
    finish(writer);
  }
  expect_frames(3);

  const Path other = scratch_.path() / "undisturbed" / "0001";
  RunWriter writer(other, sample::flow_header());
  for (std::size_t k = 0; k < 3; ++k) {
    writer.add(flow_frame(k));
    if (k < 2) writer.checkpoint(sample::state(k));
  }
  finish(writer);
  EXPECT_EQ(read_text(other / "manifest.json"), read_text(folder_ / "manifest.json"));
  // Nor does it show how the frames were shared out between checkpoints.
  const Path at_once = scratch_.path() / "at_once" / "0001";
  RunWriter third(at_once, sample::flow_header());
  for (std::size_t k = 0; k < 3; ++k) third.add(flow_frame(k));
  finish(third);
  EXPECT_EQ(read_text(at_once / "manifest.json"), read_text(folder_ / "manifest.json"));
}

TEST_F(Flow, WithADamagedFileIsNotRead) {
  sample::write_flow(scratch_.path());
  for (const char* name : {"flow.vtkhdf", "surface.h5"}) {
    const std::string whole = read_text(folder_ / name);
    std::string damaged = whole;
    damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 8);
    std::ofstream(folder_ / name, std::ios::binary) << damaged;
    ASSERT_EQ(verify(folder_).size(), 1U) << name;
    EXPECT_NE(verify(folder_)[0].find(std::string(name) + " has another SHA-256"), std::string::npos);
    for (std::size_t k = 0; k < sample::kFlowFrames; ++k) EXPECT_THROW(read_flow_frame(folder_, k), StoreError) << name;
    std::ofstream(folder_ / name, std::ios::binary) << whole;
  }
  expect_frames(sample::kFlowFrames);
}

TEST_F(Flow, RefusesFramesThatAreNotWhatTheyPromise) {
  RunWriter writer = open();
  const auto refused = [&](const auto& change) {
    simulation::FlowFrame frame = flow_frame(0);
    change(frame);
    try {
      writer.add(frame);
      return false;
    } catch (const std::logic_error&) {
      return true;
    }
  };
  using Rows = std::vector<std::int64_t>;
  const auto rows = [](simulation::Array& array) -> Rows& { return std::get<Rows>(array.values); };
  const auto vertices =
      static_cast<std::int64_t>(std::get<std::vector<double>>(flow_frame(0).vertices[2].values).size());

  EXPECT_FALSE(refused([](auto&) {}));
  EXPECT_FALSE(refused([](auto& f) { f.surface.clear(); }));
  // Rows that do not fit.
  EXPECT_TRUE(refused([](auto& f) { std::get<std::vector<double>>(f.vertices[2].values).pop_back(); }));
  EXPECT_TRUE(refused([](auto& f) { std::get<std::vector<double>>(f.surface[1].values).pop_back(); }));
  EXPECT_TRUE(refused([&](auto& f) { rows(f.triangles[0]).pop_back(); }));
  // Vertices that are none.
  EXPECT_TRUE(refused([&](auto& f) { rows(f.triangles[0])[4] = vertices; }));
  EXPECT_TRUE(refused([&](auto& f) { rows(f.triangles[0])[4] = -1; }));
  EXPECT_FALSE(refused([&](auto& f) { rows(f.triangles[0])[4] = vertices - 1; }));
  EXPECT_TRUE(refused([&](auto& f) { rows(f.surface[0])[0] = vertices; }));
  EXPECT_TRUE(refused([&](auto& f) { rows(f.surface[0])[0] = -1; }));
  // Numbers of another kind, and shapes.
  EXPECT_TRUE(refused([](auto& f) { f.triangles[0].values = std::vector<std::int32_t>{0, 1, 2}; }));
  EXPECT_TRUE(refused([](auto& f) { f.triangles[0].info.columns = 6; }));
  EXPECT_TRUE(refused([](auto& f) {
    f.vertices[0].info.columns = 4;
    f.vertices.resize(1);
  }));
  // Names and what must be there.
  EXPECT_TRUE(refused([](auto& f) { f.vertices[1].info.name = "velocity"; }));
  EXPECT_TRUE(refused([](auto& f) { f.vertices[1].info.name = "vertices/corner"; }));
  EXPECT_TRUE(refused([](auto& f) { f.vertices.push_back(f.vertices[1]); }));
  EXPECT_TRUE(refused([](auto& f) { f.vertices.erase(f.vertices.begin()); }));
  EXPECT_TRUE(refused([](auto& f) { f.vertices.clear(); }));
  EXPECT_TRUE(refused([](auto& f) { f.triangles.clear(); }));
  EXPECT_TRUE(refused([&](auto& f) { rows(f.triangles[0]).clear(); }));
  EXPECT_TRUE(refused([](auto& f) {
    f.triangles.push_back(f.triangles[0]);
    f.triangles[1].info.name = "triangles/other";
  }));
  EXPECT_TRUE(refused([](auto& f) { f.surface.erase(f.surface.begin()); }));
}

TEST_F(Flow, IsFoundInTheCatalogueByParameterAndMetric) {
  const sample::Written written = sample::write(scratch_.path());
  sample::write_flow(scratch_.path());
  Catalogue catalogue = Catalogue::open(scratch_.path());
  for (const Path& run : {written.bed, written.drive, folder_}) catalogue.ingest(run);
  const auto expect_found = [&] {
    const std::string id = sample::flow_header().case_id.substr(0, 10);
    const std::vector<std::string> columns = {"jet_thickness", "mesh.size", "inflow", "inflow.parabola.speed",
                                              "bed:case"};
    for (const char* condition : {"kind = flow", "mesh.size = 0.05", "jet_thickness < 0.02", "inflow = parabola"}) {
      const Table table = catalogue.query("", {condition}, columns);
      ASSERT_EQ(table.rows.size(), 1U) << condition;
      EXPECT_EQ(table.rows[0],
                (std::vector<Cell>{id, "0001", "flow", "completed", 0.0125, 0.05, "parabola", 0.5, Cell{}}));
    }
    EXPECT_EQ(catalogue.query("", {"kind = drive"}, {"tip_resistance_mean"}).rows.size(), 1U);
    EXPECT_EQ(catalogue.query("", {"bed:solid_fraction = null"}, {"kind"}).rows.size(), 2U);  // The bed and the flow.
    EXPECT_EQ(catalogue.find(id), folder_);
  };
  expect_found();
  EXPECT_EQ(catalogue.rebuild(), 3U);
  expect_found();
}

}  // namespace
}  // namespace seapile::store
