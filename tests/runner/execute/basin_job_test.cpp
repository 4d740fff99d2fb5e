// A basin through the real program: its series, its frames at several times, killed and continued, and refused.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/runner/execute/water_job.h"

namespace seapile::execute {
namespace {

namespace fs = std::filesystem;
using commands::Finished;
using testing::HasSubstr;

/// A standing wave on a coarse mesh; `more` goes into the basin, `top` into the study.
std::string basin_study(const std::string& more = "", const std::string& top = "") {
  return fmt::format(R"({{"study": "basin", {} "base": {{"basin": {{"surface": {{"initial": {{"cosine": {{}}}}}},
    "mesh": {{"pattern": {{"structured": {{"columns": 16, "rows": 4}}}}}}, "time": {{"step": 0.01, "duration": 0.3}}{}}}}}}})",
                     top, more);
}

using BasinJob = WaterJob;

TEST_F(BasinJob, IsSealedWithItsPartsItsSeriesAndItsFrames) {
  place.write("water.json", basin_study("", R"("record": {"interval": 0.05, "times": [0.1, 0.2]},)"));
  const Finished finished = place.run({"water.json"});
  ASSERT_EQ(finished.exit_code, kDone) << finished.error;
  const store::Manifest manifest = result();
  EXPECT_EQ(manifest.header.kind, "flow");
  EXPECT_EQ(manifest.header.record_json, R"({"interval":0.05,"times":[0.1,0.2]})");
  for (const simulation::Part& part : manifest.header.parts)
    EXPECT_EQ(part.built, part.name == "mesh" || part.name == "mesh_motion" || part.name == "fluid" ||
                              part.name == "convection" || part.name == "free_surface")
        << part.name;
  const fs::path run = run_in(place.results());
  EXPECT_TRUE(store::verify(run).empty());
  const std::vector<simulation::FlowRecord> records = store::read_flow_series(run);
  ASSERT_EQ(records.size(), 7u);
  for (std::size_t i = 0; i < records.size(); ++i) EXPECT_NEAR(records[i].time, 0.05 * static_cast<double>(i), 1e-12);
  EXPECT_TRUE(std::isnan(records[3].pile_depth));
  ASSERT_EQ(store::flow_frame_count(run), 4u);
  EXPECT_NEAR(store::read_flow_frame(run, 2).time, 0.2, 1e-12);
  // What is fresh is not run again, with fewer frames too; another time is.
  EXPECT_THAT(place.run({"water.json", "--set", "record.times=[0.1]"}).error, HasSubstr("nothing to run"));
  EXPECT_THAT(place.run({"water.json", "--dry-run", "--set", "record.times=[0.15]"}).out +
                  place.run({"water.json", "--dry-run", "--set", "record.times=[0.15]"}).error,
              HasSubstr("frame at 0.15 s not recorded"));
}

TEST_F(BasinJob, KilledAndContinuedItEndsInTheSameBits) {
  expect_the_same_bits_when_killed(
      basin_study(R"(, "viscosity": 0.01)", R"("record": {"interval": 0.01, "times": [0.05, 0.15, 0.25]},)"));
}

// The meshes of its frames differ, and the checkpoint may lie before or behind the new one.
TEST_F(BasinJob, WithAPileAndANewMeshItEndsInTheSameBitsToo) {
  expect_the_same_bits_when_killed(R"({"study": "pile", "record": {"interval": 0.1, "times": [1, 2, 3, 4]},
    "base": {"basin": {"width": 5, "depth": 2.5, "viscosity": 1, "pile": {"start": 0.8},
      "mesh": {"pattern": {"unstructured": {"size": 0.25, "pile_size": 0.12}}, "motion": "zones",
               "remesh": {"share": 0.02, "shape": 0.7}},
      "time": {"step": 0.05, "duration": 5}}}})");
  const fs::path run = run_in(place.results());
  ASSERT_EQ(store::flow_frame_count(run), 6u);
  const auto triangles = [&](std::size_t k) {
    return std::get<std::vector<std::int64_t>>(store::read_flow_frame(run, k).triangles.at(0).values);
  };
  EXPECT_NE(triangles(0), triangles(5)) << "a new mesh was made on the way";
  const simulation::FlowRecord last = store::read_flow_series(run).back();
  EXPECT_GT(last.meshes, 1);
  EXPECT_NEAR(last.pile_depth, 0.8 + 0.2 / (0.2 * std::numbers::pi) * 2, 1e-9) << "after half a period";
}

TEST_F(BasinJob, ThatDivergesIsKeptWithItsReasonItsLastFrameAndItsSeries) {
  place.write("water.json", R"({"study": "steep", "record": {"interval": 0.05},
    "base": {"basin": {"surface": {"scheme": "galerkin", "initial": {"cosine": {"amplitude": 0.1}}},
      "mesh": {"pattern": {"structured": {"columns": 16, "rows": 4}}}, "time": {"step": 0.05, "duration": 20}}}})");
  const Finished finished = place.run({"water.json"});
  EXPECT_EQ(finished.exit_code, 1) << finished.error;
  EXPECT_THAT(finished.error, HasSubstr("diverged"));
  const store::Manifest manifest = result();
  EXPECT_EQ(manifest.result.outcome, simulation::Outcome::diverged);
  EXPECT_THAT(manifest.result.reason, HasSubstr("t = "));
  const fs::path run = run_in(place.results());
  EXPECT_TRUE(store::verify(run).empty());
  const auto records = store::read_flow_series(run);
  ASSERT_GT(records.size(), 1u);
  ASSERT_EQ(store::flow_frame_count(run), 2u) << "the start, and the last good state";
  EXPECT_EQ(store::read_flow_frame(run, 1).time, manifest.result.time);
  EXPECT_GE(manifest.result.time, records.back().time);
  EXPECT_TRUE(fs::exists(run / "checkpoint" / "a.h5"));
  EXPECT_TRUE(std::ranges::any_of(manifest.files, [](const auto& file) { return file.path == "post_mortem.h5"; }));
  EXPECT_EQ(place.run({"figure", "mesh", manifest.header.case_id.substr(0, 10)}).exit_code, 0);
}

TEST_F(BasinJob, WhatIsWrongIsToldAtOnceAndNothingIsWritten) {
  place.write("water.json", R"({"study": "basin", "base": {"basin": {"depth": 2, "pile": {}}}})");
  const Finished refused = place.run({"water.json"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.error, HasSubstr("/base/basin/mesh/pattern: is structured"));
  EXPECT_THAT(refused.error, HasSubstr("/base/basin/mesh/motion: is vertical"));
  EXPECT_FALSE(fs::exists(place.results()));
}

}  // namespace
}  // namespace seapile::execute
