// `runner gc`: what goes, what stays, and that nothing looks complete that is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "runner/store/manifest.h"
#include "runner/store/run_folder.h"
#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// Two tips in one bed, each run twice: the second time with another frame. Run once, copied for each test.
struct Gc : testing::Test {
  static void SetUpTestSuite() {
    ran = new Workplace;
    ran->write("small.json", small_study("small"));
    ASSERT_EQ(ran->run({"small.json", "--set", "record.frames=[0.05]"}).exit_code, 0);
    ASSERT_EQ(ran->run({"small.json"}).exit_code, 0);
  }
  static void TearDownTestSuite() { delete ran; }

  void SetUp() override {
    fs::copy(ran->results(), place.results(), fs::copy_options::recursive);
    place.write("small.json", small_study("small"));
  }

  /// The folders of runs of a kind that have a manifest, by their number.
  std::vector<fs::path> runs(const std::string& kind, const std::string& number) const {
    std::vector<fs::path> found;
    for (const auto& folder : fs::directory_iterator(place.results() / "cases")) {
      if (!fs::exists(folder.path() / number / "manifest.json")) continue;
      if (store::read_manifest(folder.path() / number).header.kind == kind) found.push_back(folder.path() / number);
    }
    return found;
  }
  json plan(std::vector<std::string> more) const {
    more.insert(more.begin(), {"gc", "--dry-run", "--format", "json"});
    return json::parse(place.run(more).out).at("rows");
  }
  static std::uint64_t bytes(const fs::path& folder) {
    std::uint64_t sum = 0;
    for (const auto& [name, text] : everything(folder)) sum += text.size();
    return sum;
  }

  static Workplace* ran;
  const Workplace place;
};
Workplace* Gc::ran;

TEST_F(Gc, SupersededRunsGoAndEveryAnswerStays) {
  ASSERT_EQ(runs("drive", "0001").size(), 2u);
  const std::string before = place.run({"query", "small", "--format", "csv"}).out;
  const Finished finished = place.run({"gc"});
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  EXPECT_TRUE(runs("drive", "0001").empty());
  EXPECT_EQ(runs("drive", "0002").size(), 2u);
  EXPECT_EQ(place.run({"query", "small", "--format", "csv"}).out, before);
  EXPECT_EQ(place.run({"verify"}).exit_code, 0);
  EXPECT_EQ(place.run({"reindex"}).exit_code, 0);
  EXPECT_EQ(place.run({"query", "small", "--format", "csv"}).out, before);
  EXPECT_THAT(place.run({"small.json"}).error, HasSubstr("nothing to run"));
  EXPECT_TRUE(plan({}).empty());
}

TEST_F(Gc, ARunThatADriveNeedsIsNeverRemoved) {
  // The bed is computed once more: its first run is superseded, but both drives were built on it.
  const fs::path bed = runs("bed", "0001").at(0);
  store::Manifest newer = store::read_manifest(bed);
  fs::copy(bed, bed.parent_path() / "0002", fs::copy_options::recursive);
  std::string text = content(bed / "manifest.json");
  {
    // A copy under another number, sealed anew.
    newer.run = "0002";
    std::ofstream(bed.parent_path() / "0002" / "manifest.json") << store::manifest_text(newer);
  }
  EXPECT_EQ(place.run({"gc"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(bed / "manifest.json"));
  EXPECT_EQ(content(bed / "manifest.json"), text);
  // Without drives it goes.
  for (const fs::path& drive : runs("drive", "0002")) fs::remove_all(drive.parent_path());
  EXPECT_EQ(place.run({"gc"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(bed));
  EXPECT_TRUE(fs::exists(bed.parent_path() / "0002" / "manifest.json"));
}

TEST_F(Gc, ADryRunPrintsThePlanAndRemovesNothing) {
  const auto before = everything(place.results());
  const Finished dry = place.run({"gc", "--dry-run", "--drop", "fields"});
  EXPECT_EQ(dry.exit_code, 0);
  EXPECT_EQ(everything(place.results()), before);
  EXPECT_THAT(dry.error, HasSubstr("would remove"));
  const Finished real = place.run({"gc", "--drop", "fields"});
  EXPECT_EQ(real.out, dry.out);
  EXPECT_NE(everything(place.results()), before);
}

TEST_F(Gc, DroppedFieldsAreGoneOnPurposeAndAStudyThatAsksForThemRunsAgain) {
  ASSERT_EQ(place.run({"gc", "--drop", "fields"}).exit_code, 0);
  const std::vector<fs::path> drives = runs("drive", "0002");
  ASSERT_EQ(drives.size(), 2u);
  for (const fs::path& drive : drives) {
    EXPECT_TRUE(fs::exists(drive / "dropped.json"));
    EXPECT_FALSE(fs::exists(drive / "grains.vtkhdf"));
    EXPECT_TRUE(fs::exists(drive / "series.h5"));
    EXPECT_EQ(store::frame_count(drive), 0u);
  }
  EXPECT_EQ(place.run({"verify"}).exit_code, 0);
  const Finished reindexed = place.run({"reindex"});
  EXPECT_EQ(reindexed.exit_code, 0) << reindexed.out;
  EXPECT_EQ(place.run({"curve", "small"}).exit_code, 0);
  const Finished asks = place.run({"small.json", "--dry-run"});
  EXPECT_THAT(asks.error, HasSubstr("frame at 0 m not recorded"));
  const Finished asks_for_none = place.run({"small.json", "--set", "record.frames=[]"});
  EXPECT_EQ(asks_for_none.exit_code, 0);
  EXPECT_THAT(asks_for_none.error, HasSubstr("nothing to run"));
}

TEST_F(Gc, ADroppedFileListThatWasChangedIsDamage) {
  ASSERT_EQ(place.run({"gc", "--drop", "fields"}).exit_code, 0);
  const fs::path list = runs("drive", "0002").at(0) / "dropped.json";
  std::string text = content(list);
  text.replace(text.find("grains.vtkhdf"), 6, "gravel");
  std::ofstream(list) << text;
  EXPECT_EQ(place.run({"verify"}).exit_code, 3);
}

TEST_F(Gc, ADroppedSeriesMakesItsCaseRunAgain) {
  ASSERT_EQ(place.run({"gc", "--drop", "series"}).exit_code, 0);
  EXPECT_EQ(place.run({"verify"}).exit_code, 0);
  EXPECT_THAT(place.run({"small.json", "--dry-run"}).error, HasSubstr("the series of run 0002 was dropped"));
}

TEST_F(Gc, TheLargestGoFirstAndNoMoreThanTheBudgetAsks) {
  const json all = plan({});
  ASSERT_EQ(all.size(), 2u);
  const double first = all.at(0).at("size"), second = all.at(1).at("size");
  EXPECT_GE(first, second);
  const std::uint64_t total = bytes(place.results());
  const std::string just = std::to_string(total - static_cast<std::uint64_t>(first));
  EXPECT_EQ(plan({"--budget", just}).size(), 1u);
  EXPECT_EQ(plan({"--budget", std::to_string(total)}).size(), 0u);
  EXPECT_EQ(plan({"--budget", "1G"}).size(), 0u);
  EXPECT_EQ(place.run({"gc", "--budget", just}).exit_code, 0);
  EXPECT_EQ(runs("drive", "0001").size(), 1u);
}

TEST_F(Gc, ABudgetThatCannotBeMetIsSaidWithItsFigure) {
  const Finished finished = place.run({"gc", "--budget", "1K"});
  EXPECT_EQ(finished.exit_code, 3);
  EXPECT_THAT(finished.error, HasSubstr("more than the budget of 1 KiB"));
  EXPECT_EQ(runs("drive", "0002").size(), 2u);
  for (const char* wrong : {"much", "-1G", "5X", "", "1e30"})
    EXPECT_EQ(place.run({"gc", std::string("--budget=") + wrong}).exit_code, 2) << wrong;
  EXPECT_EQ(place.run({"gc", "--keep", "0"}).exit_code, 2);
  EXPECT_EQ(place.run({"gc", "--drop", "grains"}).exit_code, 2);
  EXPECT_EQ(place.run({"gc", "--store", "nowhere"}).exit_code, 4);
}

TEST_F(Gc, WhatIsNotOursAndWhatALinkPointsToIsLeftAlone) {
  const std::vector<fs::path> old = runs("drive", "0001");
  const fs::path notes = old.at(0) / "notes.txt", outside = place.write("outside.txt", "mine");
  std::ofstream(notes) << "do not lose this";
  fs::create_symlink(outside, old.at(1) / "series.h5.aside");
  const Finished finished = place.run({"gc"});
  EXPECT_EQ(finished.exit_code, 0);
  EXPECT_THAT(finished.error, HasSubstr("notes.txt, which is none of ours"));
  EXPECT_TRUE(fs::exists(old[0] / "manifest.json"));
  EXPECT_TRUE(fs::exists(old[1] / "manifest.json"));
  EXPECT_EQ(content(notes), "do not lose this");
  EXPECT_EQ(content(outside), "mine");
}

TEST_F(Gc, ACaseThatIsWorkedOnIsLeftAlone) {
  const fs::path old = runs("drive", "0001").at(0);
  const auto claim = store::Claim::take(old.parent_path());
  ASSERT_TRUE(claim);
  const Finished finished = place.run({"gc"});
  EXPECT_THAT(finished.error, HasSubstr("another process works on case"));
  EXPECT_TRUE(fs::exists(old / "manifest.json"));
}

TEST_F(Gc, LeftoversGoAndARunThatCanGoOnStays) {
  const fs::path of_case = runs("drive", "0002").at(0).parent_path();
  fs::create_directories(of_case / "0003" / "checkpoint");  // interrupted, then another run was begun
  std::ofstream(of_case / "0003" / "checkpoint" / "a.h5") << "a state";
  fs::create_directories(of_case / "0004" / "checkpoint");  // goes on the next time
  std::ofstream(of_case / "0004" / "checkpoint" / "a.h5") << "a state";
  std::ofstream(of_case / "0004" / "checkpoint" / "b.h5.aside") << "a damaged state";
  std::ofstream(of_case / "0002" / ".series.h5.1.0.12345678.temporary") << "half";
  EXPECT_EQ(place.run({"gc"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(of_case / "0003"));
  EXPECT_TRUE(fs::exists(of_case / "0004" / "checkpoint" / "a.h5"));
  EXPECT_FALSE(fs::exists(of_case / "0004" / "checkpoint" / "b.h5.aside"));
  EXPECT_FALSE(fs::exists(of_case / "0002" / ".series.h5.1.0.12345678.temporary"));
}

TEST_F(Gc, AfterACrashAnywhereInARemovalNothingLooksCompleteThatIsNot) {
  // A run is taken apart manifest first: what a crash leaves is an interrupted run that a newer one has replaced.
  const fs::path old = runs("drive", "0001").at(0);
  fs::remove(old / "manifest.json");
  EXPECT_EQ(place.run({"verify"}).exit_code, 0);
  EXPECT_EQ(place.run({"reindex"}).exit_code, 0);
  EXPECT_THAT(place.run({"small.json"}).error, HasSubstr("nothing to run"));
  EXPECT_EQ(place.run({"gc"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(old));
  // Files are dropped list first: what a crash leaves no longer counts, and goes the next time.
  const fs::path drive = runs("drive", "0002").at(0);
  const auto before = content(drive / "grains.vtkhdf");
  ASSERT_EQ(place.run({"gc", "--drop", "fields"}).exit_code, 0);
  std::ofstream(drive / "grains.vtkhdf") << before;
  EXPECT_EQ(store::frame_count(drive), 0u);
  EXPECT_EQ(place.run({"verify"}).exit_code, 0);
  EXPECT_EQ(place.run({"gc"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(drive / "grains.vtkhdf"));
}

}  // namespace
}  // namespace seapile::commands
