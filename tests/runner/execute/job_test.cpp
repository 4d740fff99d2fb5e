// One worker by itself, started as a batch system would start it.
#include "runner/execute/job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <csignal>
#include <fstream>

#include "runner/execute/exit_codes.h"
#include "runner/execute/history.h"
#include "runner/store/run_folder.h"
#include "runner/study/study.h"
#include "tests/runner/commands/program.h"

namespace seapile::execute {
namespace {

namespace fs = std::filesystem;
using commands::content;
using commands::Finished;
using commands::small_study;
using commands::Workplace;
using testing::HasSubstr;

struct JobTest : testing::Test {
  Workplace place;
  study::Case drive_case;

  JobTest() {
    place.write("small.json", small_study("small"));
    const study::Study study = study::read(place.folder() / "small.json");
    drive_case = study.cases[0];
    record = study.record;
  }
  Request bed() const {
    Request request;
    request.root = place.results().string();
    request.kind = "bed";
    request.case_id = drive_case.bed_id;
    request.canonical = drive_case.bed_canonical;
    request.scene = drive_case.scene;
    request.scene.pile.reset();
    return request;
  }
  Request drive() const {
    Request request = bed();
    request.kind = "drive";
    request.case_id = drive_case.id;
    request.canonical = drive_case.canonical;
    request.scene = drive_case.scene;
    request.record = record;
    request.bed_id = drive_case.bed_id;
    request.bed_run = "0001";
    return request;
  }
  Finished exec(const Request& request) const { return place.run({"exec", "-"}, to_json(request)); }
  fs::path run_of(const std::string& case_id, const char* run = "0001") const {
    return store::case_folder(place.results(), case_id) / run;
  }

  scene::RecordSpec record;
};

TEST_F(JobTest, ABedAndADriveAreSealedWithEverythingThatIsKnownOfThem) {
  ASSERT_EQ(exec(bed()).exit_code, kDone);
  const Finished finished = exec(drive());
  ASSERT_EQ(finished.exit_code, kDone) << finished.out;
  EXPECT_THAT(finished.out, HasSubstr("\"run\":\"0001\""));

  const store::Manifest manifest = store::read_manifest(run_of(drive_case.id));
  EXPECT_EQ(manifest.header.kind, "drive");
  EXPECT_EQ(manifest.header.bed_run, "0001");
  EXPECT_EQ(study::scene_from_json(manifest.header.scene_json), drive_case.scene);
  EXPECT_EQ(study::record_from_json(manifest.header.record_json), record);
  EXPECT_FALSE(manifest.header.numerics.empty());
  const auto fluid = std::ranges::find(manifest.header.parts, "fluid", &simulation::Part::name);
  ASSERT_NE(fluid, manifest.header.parts.end());
  EXPECT_FALSE(fluid->built);
  EXPECT_NE(fluid->reason, "");
  EXPECT_EQ(manifest.provenance.attempts, 1);
  EXPECT_EQ(manifest.provenance.threads, 1);
  EXPECT_GT(manifest.provenance.cpu_seconds, 0);
  EXPECT_GT(manifest.provenance.peak_memory_mb, 1);
  for (const std::string& text :
       {manifest.provenance.commit, manifest.provenance.compiler, manifest.provenance.flags,
        manifest.provenance.libraries, manifest.provenance.host_cpu, manifest.provenance.simd}) {
    EXPECT_NE(text, "");
  }
  EXPECT_THAT(manifest.provenance.flags, HasSubstr("-ffp-contract=off"));
  EXPECT_THAT(content(run_of(drive_case.id) / "log.txt"), HasSubstr("ended with code 0"));
  EXPECT_FALSE(fs::exists(run_of(drive_case.id) / "attempt.json"));
}

TEST_F(JobTest, WhatIsFreshIsNotRunAgain) {
  ASSERT_EQ(exec(bed()).exit_code, kDone);
  const Finished again = exec(bed());
  EXPECT_EQ(again.exit_code, kDone);
  EXPECT_EQ(again.out, "");
  EXPECT_FALSE(fs::exists(run_of(drive_case.bed_id, "0002")));
}

TEST_F(JobTest, ACaseThatSomebodyElseHoldsIsLeftAlone) {
  const auto claim = store::Claim::take(store::case_folder(place.results(), drive_case.bed_id));
  ASSERT_TRUE(claim);
  EXPECT_TRUE(is_claimed(place.results(), drive_case.bed_id));
  const Finished finished = exec(bed());
  EXPECT_EQ(finished.exit_code, kClaimHeld);
  EXPECT_FALSE(fs::exists(run_of(drive_case.bed_id)));
}

TEST_F(JobTest, AWorkerWhoseRunnerIsGoneDoesNotStart) {
  Request request = bed();
  request.parent = 1;  // not the parent of a process that this test starts
  EXPECT_EQ(exec(request).exit_code, kStoppedResumable);
  EXPECT_FALSE(fs::exists(place.results()));
}

TEST_F(JobTest, AStoreThatCannotBeWrittenIsAnInputOutputError) {
  place.write("results", "a file in the way");
  const Finished finished = exec(bed());
  EXPECT_EQ(finished.exit_code, kIoFailed);
  EXPECT_THAT(finished.out, HasSubstr("\"trouble\""));
}

TEST_F(JobTest, ADamagedBedIsNoticedBeforeAnythingIsBuiltOnIt) {
  ASSERT_EQ(exec(bed()).exit_code, kDone);
  const fs::path file = run_of(drive_case.bed_id) / "bed.h5";
  std::string bytes = content(file);
  bytes.resize(bytes.size() / 2);
  std::ofstream(file, std::ios::binary) << bytes;
  EXPECT_EQ(exec(drive()).exit_code, kVerifyFailed);
  EXPECT_TRUE(store::complete_runs(store::case_folder(place.results(), drive_case.id)).empty());
}

TEST_F(JobTest, ABedThatDoesNotSettleIsSealedWithItsReason) {
  Request request = bed();
  request.scene.bed.preparation.longest = 0.02;
  request.canonical = study::canonical_text(request.scene.bed);
  request.case_id = study::case_id(request.canonical);
  const Finished finished = exec(request);
  EXPECT_EQ(finished.exit_code, kDiverged);
  const store::Manifest manifest = store::read_manifest(run_of(request.case_id));
  EXPECT_EQ(manifest.result.outcome, simulation::Outcome::diverged);
  EXPECT_THAT(manifest.result.reason, HasSubstr("rest"));
  const History history = read_history(place.results(), request.case_id);
  ASSERT_TRUE(history.past);
  EXPECT_EQ(history.past->outcome, simulation::Outcome::diverged);
}

TEST_F(JobTest, AResumedRunIsTheSameToTheLastBitAndCountsItsAttempts) {
  ASSERT_EQ(exec(bed()).exit_code, kDone);
  ASSERT_EQ(exec(drive()).exit_code, kDone);
  const store::Manifest whole = store::read_manifest(run_of(drive_case.id));

  Request other = drive();
  other.checkpoint_every = 0;  // one checkpoint per record
  const Workplace second;
  fs::copy(place.results(), second.results(), fs::copy_options::recursive);
  fs::remove_all(store::case_folder(second.results(), drive_case.id));
  other.root = second.results().string();
  second.write("in", to_json(other));
  const pid_t worker = second.start({"exec", "-"});
  const fs::path checkpoint = store::case_folder(second.results(), drive_case.id) / "0001" / "checkpoint" / "b.h5";
  while (!fs::exists(checkpoint) && ::kill(worker, 0) == 0) ::usleep(500);
  ::kill(worker, SIGTERM);
  ASSERT_EQ(commands::wait_for(worker), kStoppedResumable) << content(second.folder() / "out");

  const History history = read_history(second.results(), drive_case.id);
  ASSERT_TRUE(history.interrupted);
  EXPECT_TRUE(history.interrupted->checkpoint);
  const Finished resumed = second.run({"exec", "-"}, to_json(other));
  ASSERT_EQ(resumed.exit_code, kDone);
  EXPECT_THAT(resumed.out, HasSubstr("\"resumed\":true"));
  const fs::path run = store::case_folder(second.results(), drive_case.id) / "0001";
  const store::Manifest manifest = store::read_manifest(run);
  EXPECT_EQ(manifest.provenance.attempts, 2);
  EXPECT_EQ(manifest.result.state_hash, whole.result.state_hash);
  EXPECT_EQ(manifest.records, whole.records);
  EXPECT_EQ(manifest.frames, whole.frames);
}

}  // namespace
}  // namespace seapile::execute
