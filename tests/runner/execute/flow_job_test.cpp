// A flow through the real program: sealed, killed and continued, checked, and refused.
#include <fmt/format.h>

#include "tests/runner/execute/water_job.h"

namespace seapile::execute {
namespace {

namespace fs = std::filesystem;
using commands::Finished;
using testing::HasSubstr;

/// A coarse jet; `more` goes into it.
std::string jet_study(const std::string& more, const std::string& top = "") {
  return fmt::format(R"({{"study": "jet", {} "base": {{"jet": {{"lip_size": 0.05, "growth": 0.2, "largest_size": 0.4,
    "downstream": 6{}}}}}}})",
                     top, more);
}

const std::string kInTime = R"(, "method": {"transient": {"step": 0.02, "duration": 30}})";

using FlowJob = WaterJob;

TEST_F(FlowJob, AJetIsSealedWithItsPartsAndItsFrame) {
  place.write("water.json", jet_study(""));
  const Finished finished = place.run({"water.json"});
  ASSERT_EQ(finished.exit_code, kDone) << finished.error;
  EXPECT_THAT(finished.out, HasSubstr("swell ratio"));
  const store::Manifest manifest = result();
  EXPECT_EQ(manifest.header.kind, "flow");
  for (const simulation::Part& part : manifest.header.parts)
    EXPECT_EQ(part.built, part.name == "mesh" || part.name == "mesh_motion" || part.name == "fluid" ||
                              part.name == "convection" || part.name == "free_surface")
        << part.name;
  const fs::path run = store::case_folder(place.results(), manifest.header.case_id) / manifest.run;
  EXPECT_EQ(store::flow_frame_count(run), 1u);
  EXPECT_TRUE(store::verify(run).empty());
  // What is fresh is not run again.
  EXPECT_THAT(place.run({"water.json"}).error, HasSubstr("nothing to run"));
}

TEST_F(FlowJob, KilledAndContinuedItEndsInTheSameBits) { expect_the_same_bits_when_killed(jet_study(kInTime)); }

TEST_F(FlowJob, ItsSwellRatioIsChecked) {
  const std::string checks =
      R"("checks": [{{"metric": "swell_ratio", "value": {}, "tolerance": 0.01, "source": "a table"}}],)";
  place.write("water.json", jet_study("", fmt::format(fmt::runtime(checks), 0.954)));
  ASSERT_EQ(place.run({"water.json"}).exit_code, kDone);
  EXPECT_EQ(place.run({"check", "water.json"}).exit_code, kDone);
  place.write("water.json", jet_study("", fmt::format(fmt::runtime(checks), 0.98)));
  const Finished failed = place.run({"check", "water.json"});
  EXPECT_EQ(failed.exit_code, kCheckFailed);
  EXPECT_THAT(failed.out, HasSubstr("FAILED"));
}

TEST_F(FlowJob, AStepTooLongForTheFilmIsADivergedRunThatIsKept) {
  place.write(
      "water.json",
      jet_study(R"(, "geometry": "planar", "capillary": 0.01, "method": {"transient": {"step": 2, "duration": 40}})"));
  const Finished finished = place.run({"water.json"});
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_THAT(finished.error, HasSubstr("diverged"));
  const store::Manifest manifest = result();
  EXPECT_THAT(manifest.result.reason, HasSubstr("at t = "));
  EXPECT_TRUE(
      fs::exists(store::case_folder(place.results(), manifest.header.case_id) / manifest.run / "post_mortem.h5"));
}

TEST_F(FlowJob, WhatAJetHasNotIsRefusedBeforeAnythingIsWritten) {
  place.write("water.json", R"({"study": "jet", "base": {"jet": {"renolds": 24}, "pile": {"depth": 1}}})");
  const Finished refused = place.run({"water.json"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.error, HasSubstr("did you mean \"reynolds\"?"));
  EXPECT_FALSE(fs::exists(place.results()));
}

}  // namespace
}  // namespace seapile::execute
