// Runs with a time series and frames of the water: from the writer back, whole and interrupted.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "runner/store/catalogue.h"
#include "runner/store/durable.h"
#include "runner/store/series.h"
#include "tests/runner/store/sample_flow.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using Path = std::filesystem::path;
using sample::difference;
using simulation::FlowRecord;

/// Twelve records; a frame, each with another mesh, with every fourth of them; a checkpoint after every fifth.
class Basin : public testing::Test {
 protected:
  static constexpr std::size_t kRecords = 12;

  RunWriter open(const Path& folder) const { return {folder, sample::basin_header()}; }

  static void go_on(RunWriter& writer, std::size_t first, std::size_t last, bool checkpoints = true) {
    for (std::size_t i = first; i < last; ++i) {
      if (i % 4 == 0) writer.add(sample::flow_frame(i / 4));
      writer.add(sample::flow_record(i));
      if (checkpoints && i % 5 == 4) writer.checkpoint(sample::state(i));
    }
  }

  static void finish(RunWriter& writer) { writer.finish(sample::flow_result(), sample::provenance(), nullptr); }

  void expect_whole(const Path& folder) const {
    EXPECT_EQ(difference(read_flow_series(folder), sample::flow_records(0, kRecords)), "");
    EXPECT_TRUE(read_series(folder).empty());
    EXPECT_EQ(read_manifest(folder).flow_records, kRecords);
    EXPECT_EQ(read_manifest(folder).records, 0U);
    ASSERT_EQ(flow_frame_count(folder), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(difference(read_flow_frame(folder, k), sample::flow_frame(k)), "") << k;
    }
    EXPECT_EQ(flow_frame_times(folder), (std::vector<double>{0, 0.5, 1}));
    EXPECT_EQ(verify(folder), std::vector<std::string>{});
  }

  Scratch scratch_;
  Path folder_ = case_folder(scratch_.path(), sample::basin_header().case_id) / "0001";
};

TEST_F(Basin, GivesItsRecordsAndFramesBackBitForBit) {
  RunWriter writer = open(folder_);
  go_on(writer, 0, kRecords);
  finish(writer);
  expect_whole(folder_);
}

TEST_F(Basin, LeavesOutTheColumnsThatNoRecordHas) {
  RunWriter writer = open(folder_);
  go_on(writer, 0, kRecords);
  finish(writer);
  hdf5::FileReader reader(folder_ / "series.h5");
  EXPECT_FALSE(reader.has("/flow_series/pile_depth"));
  EXPECT_FALSE(reader.has("/flow_series/pile_force_y"));
  EXPECT_TRUE(reader.has("/flow_series/middle")) << "some records have it";
  EXPECT_FALSE(reader.has("/series/time"));
  EXPECT_EQ(reader.attribute<std::string>("/flow_series/rise", "units"), "m");
  reader.close();
  const std::vector<FlowRecord> records = read_flow_series(folder_);
  EXPECT_TRUE(std::isnan(records[3].pile_depth));
  EXPECT_TRUE(std::isnan(records[1].middle));
  EXPECT_FALSE(std::isnan(records[2].middle));
}

// Whatever NaN the solver came to.
TEST_F(Basin, EveryAbsentValueIsTheSame) {
  RunWriter writer = open(folder_);
  for (std::size_t i = 0; i < 4; ++i) {
    FlowRecord record = sample::flow_record(i);
    record.rise = i % 2 == 0 ? -std::numeric_limits<double>::quiet_NaN() : 1;
    writer.add(record);
    if (i == 1) writer.checkpoint(sample::state(i));
  }
  finish(writer);
  for (const std::size_t i : {0, 2}) {
    const double rise = read_flow_series(folder_)[i].rise, absent = FlowRecord::kAbsent;
    EXPECT_EQ(std::memcmp(&rise, &absent, sizeof rise), 0);
  }
}

TEST_F(Basin, GoesOnFromItsCheckpointWithTheRecordsBeforeIt) {
  {
    RunWriter writer = open(folder_);
    go_on(writer, 0, 11);  // The eleventh record and the third frame are in no segment.
  }
  RunWriter writer = open(folder_);
  EXPECT_EQ(difference(writer.resumable().flow_records, sample::flow_records(0, 10)), "");
  EXPECT_EQ(writer.resumable().flow_frames, 3U);
  EXPECT_TRUE(writer.resumable().records.empty());
  EXPECT_EQ(difference(writer.resumable().state, sample::state(9)), "");
}

TEST_F(Basin, LeavesTheSameFilesWhetherInterruptedOrNot) {
  {
    RunWriter writer = open(folder_);
    go_on(writer, 0, 11);
  }
  std::ofstream(folder_ / "series.h5") << "killed while it finished";
  {
    RunWriter writer = open(folder_);
    go_on(writer, 10, kRecords);
    finish(writer);
  }
  expect_whole(folder_);
  for (const bool checkpoints : {true, false}) {
    const Path other = scratch_.path() / (checkpoints ? "undisturbed" : "at_once") / "0001";
    RunWriter writer = open(other);
    go_on(writer, 0, kRecords, checkpoints);
    finish(writer);
    EXPECT_EQ(read_text(other / "manifest.json"), read_text(folder_ / "manifest.json"));
  }
}

TEST_F(Basin, ThatDivergedKeepsItsSegmentsAndItsSeries) {
  RunWriter writer = open(folder_);
  go_on(writer, 0, kRecords);
  simulation::RunResult result = sample::flow_result();
  result.outcome = simulation::Outcome::diverged;
  result.reason = "a triangle turned over";
  writer.finish(result, sample::provenance(), nullptr);
  expect_whole(folder_);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "segment" / "000002.h5"));
}

TEST_F(Basin, WithADamagedSeriesIsNotRead) {
  RunWriter writer = open(folder_);
  go_on(writer, 0, kRecords);
  finish(writer);
  std::string damaged = read_text(folder_ / "series.h5");
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 8);
  std::ofstream(folder_ / "series.h5", std::ios::binary) << damaged;
  EXPECT_THROW(read_flow_series(folder_), StoreError);
}

TEST_F(Basin, MayHaveRecordsOfGrainsBesideThoseOfTheWater) {
  const Path drive = scratch_.path() / "drive" / "0001";
  RunWriter writer(drive, sample::drive_header());
  writer.add(sample::record(0));
  writer.add(sample::flow_record(0));
  writer.checkpoint(sample::state(0));
  writer.add(sample::record(1));
  finish(writer);
  EXPECT_EQ(difference(read_series(drive), sample::records(0, 2)), "");
  EXPECT_EQ(difference(read_flow_series(drive), sample::flow_records(0, 1)), "");
}

TEST_F(Basin, CountsItsRecordsInTheCatalogue) {
  RunWriter writer = open(folder_);
  go_on(writer, 0, kRecords);
  finish(writer);
  Catalogue catalogue = Catalogue::open(scratch_.path());
  catalogue.ingest(folder_);
  const Table table = catalogue.query("", {"kind = flow", "basin.width = 1"}, {"jet_thickness"});
  EXPECT_EQ(table.rows.size(), 1U);
}

}  // namespace
}  // namespace seapile::store
