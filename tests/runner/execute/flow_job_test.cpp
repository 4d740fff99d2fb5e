// A flow through the real program: sealed, killed and continued, checked, and refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "runner/execute/exit_codes.h"
#include "runner/store/run_folder.h"
#include "runner/study/study.h"
#include "tests/runner/commands/program.h"

namespace seapile::execute {
namespace {

namespace fs = std::filesystem;
using commands::content;
using commands::Finished;
using commands::wait_for;
using commands::Workplace;
using testing::HasSubstr;
using namespace std::chrono_literals;

/// A coarse jet; `more` goes into it.
std::string jet_study(const std::string& more, const std::string& top = "") {
  return fmt::format(R"({{"study": "jet", {} "base": {{"jet": {{"lip_size": 0.05, "growth": 0.2, "largest_size": 0.4,
    "downstream": 6{}}}}}}})",
                     top, more);
}

const std::string kInTime = R"(, "method": {"transient": {"step": 0.02, "duration": 30}})";

struct FlowJob : testing::Test {
  Workplace place;

  store::Manifest result() const {
    const study::Study study = study::read(place.folder() / "jet.json");
    const fs::path folder = store::case_folder(place.results(), study.cases.at(0).id);
    return store::read_manifest(folder / store::complete_runs(folder).back());
  }
  bool has_checkpoint() const {
    std::error_code changing;
    for (fs::recursive_directory_iterator entry(place.results(), changing), end; entry != end && !changing;
         entry.increment(changing))
      if (entry->path().filename() == "a.h5") return true;
    return false;
  }
};

TEST_F(FlowJob, AJetIsSealedWithItsPartsAndItsFrame) {
  place.write("jet.json", jet_study(""));
  const Finished finished = place.run({"jet.json"});
  ASSERT_EQ(finished.exit_code, kDone) << finished.error;
  EXPECT_THAT(finished.out, HasSubstr("swell ratio"));
  const store::Manifest manifest = result();
  EXPECT_EQ(manifest.header.kind, "flow");
  for (const simulation::Part& part : manifest.header.parts)
    EXPECT_EQ(part.built, part.name == "mesh" || part.name == "fluid" || part.name == "free_surface") << part.name;
  const fs::path run = store::case_folder(place.results(), manifest.header.case_id) / manifest.run;
  EXPECT_EQ(store::flow_frame_count(run), 1u);
  EXPECT_TRUE(store::verify(run).empty());
  // What is fresh is not run again.
  EXPECT_THAT(place.run({"jet.json"}).error, HasSubstr("nothing to run"));
}

TEST_F(FlowJob, KilledAndContinuedItEndsInTheSameBits) {
  place.write("jet.json", jet_study(kInTime));
  ASSERT_EQ(place.run({"jet.json", "--store", "whole"}).exit_code, kDone);
  const study::Study study = study::read(place.folder() / "jet.json");
  const std::uint64_t expected =
      store::read_manifest(store::case_folder(place.folder() / "whole", study.cases.at(0).id) / "0001")
          .result.state_hash;

  const pid_t runner = place.start({"jet.json", "--checkpoint", "0"});
  while (!has_checkpoint() && ::kill(runner, 0) == 0) std::this_thread::sleep_for(1ms);
  ::kill(runner, SIGKILL);
  wait_for(runner);
  const Finished again = place.run({"jet.json"});
  ASSERT_EQ(again.exit_code, kDone) << again.error;
  EXPECT_THAT(again.error, HasSubstr("was interrupted after a checkpoint"));
  EXPECT_EQ(result().provenance.attempts, 2);
  EXPECT_EQ(result().result.state_hash, expected);
}

TEST_F(FlowJob, ItsSwellRatioIsChecked) {
  const std::string checks =
      R"("checks": [{{"metric": "swell_ratio", "value": {}, "tolerance": 0.01, "source": "a table"}}],)";
  place.write("jet.json", jet_study("", fmt::format(fmt::runtime(checks), 0.954)));
  ASSERT_EQ(place.run({"jet.json"}).exit_code, kDone);
  EXPECT_EQ(place.run({"check", "jet.json"}).exit_code, kDone);
  place.write("jet.json", jet_study("", fmt::format(fmt::runtime(checks), 0.98)));
  const Finished failed = place.run({"check", "jet.json"});
  EXPECT_EQ(failed.exit_code, kCheckFailed);
  EXPECT_THAT(failed.out, HasSubstr("FAILED"));
}

TEST_F(FlowJob, AStepTooLongForTheFilmIsADivergedRunThatIsKept) {
  place.write(
      "jet.json",
      jet_study(
          R"(, "geometry": "planar", "capillary": 0.02, "method": {"transient": {"step": 0.5, "duration": 40}})"));
  const Finished finished = place.run({"jet.json"});
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_THAT(finished.error, HasSubstr("diverged"));
  EXPECT_THAT(result().result.reason, HasSubstr("at t = "));
}

TEST_F(FlowJob, WhatAJetHasNotIsRefusedBeforeAnythingIsWritten) {
  place.write("jet.json", R"({"study": "jet", "base": {"jet": {"renolds": 24}, "pile": {"depth": 1}}})");
  const Finished refused = place.run({"jet.json"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.error, HasSubstr("did you mean \"reynolds\"?"));
  EXPECT_FALSE(fs::exists(place.results()));
}

}  // namespace
}  // namespace seapile::execute
