// Drives in a saturated bed: series and frames of the grains and of the fluid in one run folder.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "runner/store/catalogue.h"
#include "runner/store/durable.h"
#include "runner/store/seal.h"
#include "runner/store/series.h"
#include "runner/store/stamp.h"
#include "tests/runner/store/sample_flow.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using Path = std::filesystem::path;
using sample::difference;
using simulation::FlowRecord;

std::vector<FlowRecord> fluid_records(std::size_t first, std::size_t count) {
  std::vector<FlowRecord> list;
  for (std::size_t i = first; i < first + count; ++i) list.push_back(sample::saturated_record(i));
  return list;
}

/// Twelve records of both; a frame of both, the fluid's each with another mesh, with every fourth of them; a checkpoint
/// after every fifth.
class Saturated : public testing::Test {
 protected:
  static constexpr std::size_t kRecords = 12, kFrames = 3;

  static void go_on(RunWriter& writer, std::size_t first, std::size_t last, bool checkpoints = true) {
    for (std::size_t i = first; i < last; ++i) {
      if (i % 4 == 0) {
        writer.add(sample::frame(i / 4));
        writer.add(sample::flow_frame(i / 4));
      }
      writer.add(sample::record(i));
      writer.add(sample::saturated_record(i));
      if (checkpoints && i % 5 == 4) writer.checkpoint(sample::state(i));
    }
  }

  static void finish(RunWriter& writer) { writer.finish(sample::drive_result(), sample::provenance(), nullptr); }

  static void expect_whole(const Path& folder) {
    EXPECT_EQ(difference(read_series(folder), sample::records(0, kRecords)), "");
    EXPECT_EQ(difference(read_flow_series(folder), fluid_records(0, kRecords)), "");
    const Manifest manifest = read_manifest(folder);
    EXPECT_EQ(manifest.header.kind, "drive");
    EXPECT_EQ(manifest.records, kRecords);
    EXPECT_EQ(manifest.flow_records, kRecords);
    EXPECT_EQ(manifest.frames, kFrames);
    EXPECT_EQ(manifest.flow_frames, kFrames);
    for (std::size_t k = 0; k < kFrames; ++k) {
      EXPECT_EQ(difference(read_frame(folder, k), sample::frame(k)), "") << k;
      EXPECT_EQ(difference(read_flow_frame(folder, k), sample::flow_frame(k)), "") << k;
    }
    EXPECT_EQ(verify(folder), std::vector<std::string>{});
    EXPECT_FALSE(std::filesystem::exists(folder / "segment"));
  }

  Scratch scratch_;
  Path folder_ = case_folder(scratch_.path(), sample::drive_header().case_id) / "0001";
};

TEST_F(Saturated, GivesBothSeriesAndBothKindsOfFramesBackBitForBit) {
  RunWriter writer(folder_, sample::drive_header());
  go_on(writer, 0, kRecords);
  finish(writer);
  expect_whole(folder_);
  std::vector<std::string> files;
  for (const FileEntry& file : read_manifest(folder_).files) files.push_back(file.path);
  EXPECT_EQ(files,
            (std::vector<std::string>{"contacts.vtkhdf", "contacts.xdmf", "fields.vtkhdf", "fields.xdmf", "flow.vtkhdf",
                                      "flow.xdmf", "grains.vtkhdf", "grains.xdmf", "series.h5", "surface.h5"}));
}

TEST_F(Saturated, GoesOnFromItsCheckpointWithBothKindsOfRecordsBeforeIt) {
  {
    RunWriter writer(folder_, sample::drive_header());
    go_on(writer, 0, 11);  // The eleventh record of both is in no segment.
  }
  const RunWriter writer(folder_, sample::drive_header());
  EXPECT_EQ(difference(writer.resumable().records, sample::records(0, 10)), "");
  EXPECT_EQ(difference(writer.resumable().flow_records, fluid_records(0, 10)), "");
  EXPECT_EQ(writer.resumable().frames, kFrames);
  EXPECT_EQ(writer.resumable().flow_frames, kFrames);
  EXPECT_EQ(difference(writer.resumable().state, sample::state(9)), "");
}

TEST_F(Saturated, LeavesTheSameFilesWhetherInterruptedOrNot) {
  {
    RunWriter writer(folder_, sample::drive_header());
    go_on(writer, 0, 7);
  }
  {
    RunWriter writer(folder_, sample::drive_header());
    go_on(writer, 5, 11);
  }
  for (const char* file : {"series.h5", "flow.vtkhdf", "grains.vtkhdf"})
    std::ofstream(folder_ / file) << "killed while it finished";
  {
    RunWriter writer(folder_, sample::drive_header());
    go_on(writer, 10, kRecords);
    finish(writer);
  }
  expect_whole(folder_);
  const Path other = scratch_.path() / "at_once" / "0001";
  RunWriter writer(other, sample::drive_header());
  go_on(writer, 0, kRecords, false);
  finish(writer);
  EXPECT_EQ(read_text(other / "manifest.json"), read_text(folder_ / "manifest.json"));
}

TEST_F(Saturated, ThatDivergedKeepsBoth) {
  RunWriter writer(folder_, sample::drive_header());
  go_on(writer, 0, 7);
  simulation::RunResult result = sample::drive_result();
  result.outcome = simulation::Outcome::diverged;
  result.reason = "a triangle turned over";
  writer.finish(result, sample::provenance(), nullptr);
  EXPECT_EQ(difference(read_series(folder_), sample::records(0, 7)), "");
  EXPECT_EQ(difference(read_flow_series(folder_), fluid_records(0, 7)), "");
  EXPECT_EQ(read_manifest(folder_).flow_frames, 2U);
}

TEST_F(Saturated, IsADriveInACatalogueMadeAnew) {
  RunWriter writer(folder_, sample::drive_header());
  go_on(writer, 0, kRecords);
  finish(writer);
  for (const bool anew : {false, true}) {
    Catalogue catalogue = Catalogue::open(scratch_.path());
    if (anew) {
      EXPECT_EQ(catalogue.rebuild(), 1U);
    } else {
      catalogue.ingest(folder_);
    }
    EXPECT_EQ(catalogue.query("", {"kind = drive"}, {"tip_resistance_mean"}).rows.size(), 1U);
  }
}

/// A series of the water as it was written when its records had no columns of a saturated bed.
TEST_F(Saturated, AColumnThatCameLaterIsNoNumberInAnOlderSeries) {
  const Path file = scratch_.path() / "older.h5";
  seal(file, hdf5::Storage::packed, [](hdf5::FileWriter& writer) {
    write_stamp(writer, "series", {"", "0001"});
    writer.dataset("/flow_series/time", {2, 0}, std::vector<double>{0, 1});
    writer.dataset("/flow_series/volume", {2, 0}, std::vector<double>{3, 4});
  });
  hdf5::FileReader reader(file);
  const std::vector<FlowRecord> records = read_series<FlowRecord>(reader);
  reader.close();
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[1].volume, 4);
  EXPECT_TRUE(std::isnan(records[1].shoulder_pressure));
  EXPECT_TRUE(std::isnan(records[1].element_ratio));
}

}  // namespace
}  // namespace seapile::store
