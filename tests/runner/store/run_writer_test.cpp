#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "runner/store/durable.h"
#include "runner/store/run_folder.h"
#include "tests/runner/store/sample_run.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using Path = std::filesystem::path;
using sample::difference;

void flip_a_bit(const Path& file) {
  const auto middle = static_cast<std::streamoff>(std::filesystem::file_size(file) / 2);
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(middle);
  const int byte = stream.get();
  stream.seekp(middle);
  stream.put(static_cast<char>(byte ^ 4));
}

std::set<std::string> names(const Path& folder) {
  std::set<std::string> list;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) list.insert(entry.path().filename());
  return list;
}

class Writer : public testing::Test {
 protected:
  /// Records [first, last), one frame with the first of each ten, and a checkpoint at the end.
  static void go_on(RunWriter& writer, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (i % 10 == 0) writer.add(sample::frame(i / 10));
      writer.add(sample::record(i));
    }
    writer.checkpoint(sample::state(last));
  }

  RunWriter open() const { return {folder_, sample::drive_header()}; }

  /// Four checkpoints, after 10, 20, 30 and 40 records.
  void interrupt() const {
    RunWriter writer = open();
    for (const std::size_t first : {0, 10, 20, 30}) go_on(writer, first, first + 10);
    writer.add(sample::record(40));
  }

  void expect_resumable(std::size_t records) const {
    const RunWriter writer = open();
    const Resumable& resumable = writer.resumable();
    EXPECT_EQ(difference(resumable.records, sample::records(0, records)), "");
    EXPECT_EQ(resumable.frames, records / 10);
    const auto state = records == 0 ? std::vector<simulation::Array>{} : sample::state(records);
    EXPECT_EQ(difference(resumable.state, state), "");
  }

  void finish_from(std::size_t records) const {
    RunWriter writer = open();
    go_on(writer, records, 50);
    writer.finish(sample::drive_result(), sample::provenance(), nullptr);
    EXPECT_EQ(difference(read_series(folder_), sample::records(0, 50)), "");
    ASSERT_EQ(frame_count(folder_), 5U);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(difference(read_frame(folder_, k), sample::frame(k)), "");
    EXPECT_EQ(verify(folder_), std::vector<std::string>{});
  }

  Scratch scratch_;
  Path folder_ = case_folder(scratch_.path(), sample::drive_header().case_id) / "0001";
};

TEST_F(Writer, BeginsWithNothing) {
  expect_resumable(0);
  finish_from(0);
}

TEST_F(Writer, GoesOnFromTheNewestCheckpoint) {
  interrupt();
  expect_resumable(40);
  finish_from(40);
}

TEST_F(Writer, LeavesTheSameFilesWhetherInterruptedOrNot) {
  interrupt();
  finish_from(40);
  const Path other = scratch_.path() / "undisturbed" / "0001";
  RunWriter writer(other, sample::drive_header());
  for (const std::size_t first : {0, 10, 20, 30, 40}) go_on(writer, first, first + 10);
  writer.finish(sample::drive_result(), sample::provenance(), nullptr);
  EXPECT_EQ(read_text(other / "manifest.json"), read_text(folder_ / "manifest.json"));
}

TEST_F(Writer, FallsBackToTheOtherCheckpointWhenTheNewestIsDamaged) {
  interrupt();
  flip_a_bit(folder_ / "checkpoint" / "b.h5");  // The fourth.
  expect_resumable(30);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "checkpoint" / "b.h5.aside"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "segment" / "000004.h5.aside"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "segment" / "000004.h5"));
  finish_from(30);
}

TEST_F(Writer, FallsBackWhenTheNewestCheckpointIsEmptyOrMissing) {
  interrupt();
  std::filesystem::resize_file(folder_ / "checkpoint" / "b.h5", 0);
  expect_resumable(30);
  std::filesystem::remove(folder_ / "checkpoint" / "b.h5.aside");
  expect_resumable(30);
  finish_from(30);
}

TEST_F(Writer, FallsBackWhenASegmentOfTheNewestCheckpointIsDamaged) {
  interrupt();
  flip_a_bit(folder_ / "segment" / "000004.h5");
  expect_resumable(30);
  finish_from(30);
}

TEST_F(Writer, BeginsAgainWhenAnEarlySegmentIsDamaged) {
  interrupt();
  flip_a_bit(folder_ / "segment" / "000002.h5");
  expect_resumable(0);
  finish_from(0);
}

TEST_F(Writer, DoesNotMixTheSegmentsOfTwoAttempts) {
  // Killed between a segment and its checkpoint, the second attempt seals its checkpoints elsewhere.
  interrupt();
  const std::string newest = read_text(folder_ / "checkpoint" / "b.h5");
  flip_a_bit(folder_ / "checkpoint" / "b.h5");
  {
    RunWriter writer = open();
    for (std::size_t i = 30; i < 35; ++i) writer.add(sample::record(i));
    writer.checkpoint(sample::state(35));
  }
  // The old checkpoint comes back, whole; its fourth segment has become another.
  std::ofstream(folder_ / "checkpoint" / "b.h5", std::ios::binary) << newest;
  expect_resumable(30);
}

TEST_F(Writer, SetsAsideWhatAnotherSceneOrVersionLeft) {
  interrupt();
  RunHeader header = sample::drive_header();
  header.numerics[0].version = 2;
  EXPECT_TRUE(RunWriter(folder_, header).resumable().records.empty());
  EXPECT_EQ(names(folder_ / "checkpoint"), (std::set<std::string>{"a.h5.aside", "b.h5.aside"}));
}

TEST_F(Writer, RemovesWhatAKilledWriterWasAboutToSeal) {
  interrupt();
  for (const Path& place : {folder_, folder_ / "segment", folder_ / "checkpoint"}) {
    std::ofstream(temporary_name(place / "x.h5")) << "half";
  }
  // And what a run that was killed while it finished had merged.
  std::ofstream(folder_ / "contacts.vtkhdf") << "whole";
  expect_resumable(40);
  EXPECT_EQ(names(folder_), (std::set<std::string>{"checkpoint", "segment"}));
  EXPECT_EQ(names(folder_ / "checkpoint"), (std::set<std::string>{"a.h5", "b.h5"}));
}

TEST_F(Writer, LeavesOnlyTheResultWhenTheRunIsCompleted) {
  std::filesystem::create_directories(folder_);
  std::ofstream(folder_ / "log.txt") << "begun\n";
  finish_from(0);
  EXPECT_EQ(names(folder_),
            (std::set<std::string>{"contacts.vtkhdf", "contacts.xdmf", "fields.vtkhdf", "fields.xdmf", "grains.vtkhdf",
                                   "grains.xdmf", "log.txt", "manifest.json", "series.h5"}));
  // The log goes on, and is none of the manifest's.
  std::ofstream(folder_ / "log.txt", std::ios::app) << "ended\n";
  EXPECT_EQ(verify(folder_), std::vector<std::string>{});
}

TEST_F(Writer, KeepsCheckpointsAndSegmentsOfARunThatDiverged) {
  RunWriter writer = open();
  go_on(writer, 0, 10);
  simulation::RunResult result = sample::drive_result();
  result.outcome = simulation::Outcome::diverged;
  result.reason = "a grain left the box";
  writer.post_mortem(sample::state(2), result.reason);
  writer.finish(result, sample::provenance(), nullptr);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "checkpoint" / "a.h5"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "segment" / "000001.h5"));
  const Manifest manifest = read_manifest(folder_);
  EXPECT_EQ(manifest.result.reason, "a grain left the box");
  std::set<std::string> paths;
  for (const FileEntry& file : manifest.files) paths.insert(file.path);
  EXPECT_TRUE(paths.contains("checkpoint/a.h5") && paths.contains("segment/000001.h5") &&
              paths.contains("post_mortem.h5"));
  EXPECT_EQ(verify(folder_), std::vector<std::string>{});
}

TEST_F(Writer, HandlesARunWithoutRecordsAndFrames) {
  open().finish(sample::drive_result(), sample::provenance(), nullptr);
  EXPECT_TRUE(read_series(folder_).empty());
  EXPECT_EQ(frame_count(folder_), 0U);
  EXPECT_EQ(names(folder_), (std::set<std::string>{"manifest.json", "series.h5"}));
}

TEST_F(Writer, HandlesFramesWithoutContactsAndWithoutAGrid) {
  RunWriter writer = open();
  std::vector<simulation::Frame> frames = {sample::frame(0, 0), sample::frame(1), sample::frame(2, 0)};
  for (simulation::Frame& frame : frames) {
    frame.grid = {0, 0, 0.05, 0, 0};
    for (simulation::Array& array : frame.cells) array.values = std::vector<double>{};
    writer.add(frame);
  }
  writer.checkpoint(sample::state(0));
  writer.finish(sample::drive_result(), sample::provenance(), nullptr);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(difference(read_frame(folder_, k), frames[k]), "");
}

TEST_F(Writer, GivesAFrameThatLeftItsContactArraysOutEmptyOnes) {
  RunWriter writer = open();
  simulation::Frame bare = sample::frame(0, 0);
  bare.contacts.clear();
  writer.add(bare);
  writer.add(sample::frame(1));
  writer.finish(sample::drive_result(), sample::provenance(), nullptr);
  EXPECT_EQ(difference(read_frame(folder_, 0), sample::frame(0, 0)), "");
  EXPECT_EQ(difference(read_frame(folder_, 1), sample::frame(1)), "");
}

TEST_F(Writer, RefusesFramesThatAreNotWhatTheyPromise) {
  RunWriter writer = open();
  simulation::Frame frame = sample::frame(0);
  frame.grains[0].info.name = "id";
  EXPECT_THROW(writer.add(frame), std::logic_error);
  frame = sample::frame(0);
  std::get<std::vector<double>>(frame.grains[2].values).pop_back();
  EXPECT_THROW(writer.add(frame), std::logic_error);
  frame = sample::frame(0);
  frame.grid.nx = 11;
  EXPECT_THROW(writer.add(frame), std::logic_error);
  frame = sample::frame(0);
  frame.contacts.push_back(frame.contacts[1]);
  EXPECT_THROW(writer.add(frame), std::logic_error);
}

TEST_F(Writer, RefusesToFinishAStoppedRunOrToOpenACompleteOne) {
  RunWriter writer = open();
  simulation::RunResult result = sample::drive_result();
  result.outcome = simulation::Outcome::stopped;
  EXPECT_THROW(writer.finish(result, sample::provenance(), nullptr), std::logic_error);
  EXPECT_TRUE(complete_runs(folder_.parent_path()).empty());
  result.outcome = simulation::Outcome::completed;
  writer.finish(result, sample::provenance(), nullptr);
  EXPECT_THROW(open(), std::logic_error);
}

TEST_F(Writer, TakesABedsRecordsFromTheBed) {
  const simulation::Bed bed = sample::bed();
  const Path folder = scratch_.path() / "bed" / "0001";
  RunWriter writer(folder, sample::bed_header());
  for (const simulation::Record& record : bed.records) writer.add(record);
  writer.finish(sample::bed_result(), sample::provenance(), &bed);
  EXPECT_EQ(difference(read_bed(folder), bed), "");
  EXPECT_EQ(read_manifest(folder).records, bed.records.size());

  RunWriter other(scratch_.path() / "other" / "0001", sample::bed_header());
  other.add(sample::record(3));
  EXPECT_THROW(other.finish(sample::bed_result(), sample::provenance(), &bed), std::logic_error);
}

}  // namespace
}  // namespace seapile::store
