// A saturated bed through the real program: both phases in one run, killed and continued across a new mesh.
#include <algorithm>

#include "runner/study/study.h"
#include "tests/runner/execute/water_job.h"

namespace seapile::execute {
namespace {

namespace fs = std::filesystem;
using commands::Finished;
using testing::HasSubstr;

/// 150 grains under water, and a thin pile that drives the mesh to a new one.
constexpr const char* kStudy = R"({"study": "wet", "record": {"travel": "2 mm", "frames": [0, 0.04, 0.1]},
  "base": {"bed": {"domain": {"width": "0.8 m", "height": "1 m"}, "grains": {"count": 150}},
    "pile": {"radius": "0.05 m", "driving": {"constant": {"speed": "0.4 m/s"}}, "depth": "0.1 m"},
    "fluid": {"depth": "0.8 m", "time": {"step": "1 ms"},
      "mesh": {"size": "0.1 m", "pile_size": "0.06 m", "motion": {"zones": {"reach": "0.2 m"}},
               "remesh": {"share": 0.02}}}}})";

using SaturatedJob = WaterJob;

TEST_F(SaturatedJob, KilledAndContinuedItEndsInTheSameBitsAcrossANewMesh) {
  expect_the_same_bits_when_killed(kStudy);
  const fs::path run = run_in(place.results());
  EXPECT_TRUE(store::verify(run).empty());
  EXPECT_EQ(result().header.kind, "drive");
  const std::vector<simulation::FlowRecord> water = store::read_flow_series(run);
  EXPECT_EQ(water.size(), store::read_series(run).size());
  EXPECT_GT(water.back().meshes, 1) << "a new mesh was made on the way";
  for (const simulation::FlowRecord& r : water) EXPECT_LT(std::abs(r.volume_error), 1e-8);
  EXPECT_EQ(store::frame_count(run), 3u);
  EXPECT_EQ(store::flow_frame_count(run), 3u);
  for (const simulation::Part& part : result().header.parts) {
    EXPECT_EQ(part.built, part.name != "restitution" && part.name != "surface_tension") << part.name;
  }
}

TEST_F(SaturatedJob, SharesItsBedWithTheDryCase) {
  place.write("water.json", kStudy);
  ASSERT_EQ(place.run({"water.json"}).exit_code, kDone);
  const Finished dry = place.run({"water.json", "--set", "fluid=null"});
  EXPECT_EQ(dry.exit_code, kDone) << dry.error;
  EXPECT_THAT(dry.error, testing::Not(HasSubstr("started    bed"))) << dry.error;
}

TEST_F(SaturatedJob, WhatIsWrongIsToldAtOnceAndNothingIsWritten) {
  place.write("water.json", R"({"study": "wet", "base": {"pile": {"depth": "1.2 m"},
    "fluid": {"depth": "1 m", "time": {"step": "0.7 ms"}, "mesh": {"size": "0.1 m", "pile_size": "0.2 m"}}}})");
  const Finished refused = place.run({"water.json"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.error, HasSubstr("/base/fluid/depth"));
  EXPECT_THAT(refused.error, HasSubstr("/base/fluid/time/step"));
  EXPECT_THAT(refused.error, HasSubstr("/base/fluid/mesh/pile_size"));
  EXPECT_FALSE(fs::exists(place.results()));
}

}  // namespace
}  // namespace seapile::execute
