#include "solver/simulation/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "solver/simulation/build.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

using support::drive;
using support::Drive;
using support::metric;
using support::settled;
using support::small_drive;
using support::small_record;

constexpr double kStep = 5e-4;

scene::SceneSpec drive_of_300(const pile::Tip& tip) { return small_drive(300, 0.8, tip); }

/// Both tips, driven once for all that is asked of them.
const Drive& usual(bool flat) {
  static const auto make = [](const pile::Tip& tip) {
    const scene::SceneSpec scene = drive_of_300(tip);
    return drive(scene, small_record(), settled(scene.bed));
  };
  static const Drive runs[] = {make(pile::ConicalTip{}), make(pile::FlatTip{})};
  return runs[flat];
}

TEST(Run, EndsAtItsDepth) {
  for (const bool flat : {false, true}) {
    const Drive& run = usual(flat);
    EXPECT_EQ(run.result.outcome, Outcome::completed);
    EXPECT_EQ(run.result.reason, "");
    EXPECT_GE(run.result.depth, 0.12 - 1e-9);
    EXPECT_LT(run.result.depth, 0.12 + 0.4 * kStep);
    EXPECT_EQ(run.result.depth, run.records.back().depth);
    EXPECT_EQ(run.result.time, run.records.back().time);
    EXPECT_EQ(metric(run.result.metrics, "steps"), std::round(run.result.time / kStep));
  }
}

TEST(Run, RecordsEveryHalfMillimetreOfTravel) {
  for (const bool flat : {false, true}) {
    const std::vector<Record>& records = usual(flat).records;
    const double along_a_step = 0.4 * kStep;
    for (std::size_t k = 0; k + 1 < records.size(); ++k) {
      // Each ends with the first step beyond a multiple of the travel asked for.
      EXPECT_GE(records[k].travel, 5e-4 * static_cast<double>(k + 1) - 1e-12);
      EXPECT_LT(records[k].travel, 5e-4 * static_cast<double>(k + 1) + along_a_step);
      EXPECT_NEAR(records[k].span, records[k].time - (k > 0 ? records[k - 1].time : 0), 1e-12);
    }
    EXPECT_NEAR(static_cast<double>(records.size()), records.back().travel / 5e-4, 1.5);
  }
}

TEST(Run, DepthCountsFromTheSurfaceOfTheBed) {
  const scene::SceneSpec scene = drive_of_300(pile::FlatTip{});
  const Bed& bed = settled(scene.bed);
  const double start = build(scene, bed, {}).pile->start;
  for (const Record& r : usual(true).records)
    EXPECT_NEAR(r.depth, metric(bed.metrics, "surface") - start + r.travel, 1e-9);
}

// A record per step shows it: nothing is felt until the pile has travelled its clearance, and then something soon is.
TEST(Run, NoForceActsBeforeThePileTouches) {
  for (const pile::Tip& tip : {pile::Tip{pile::FlatTip{}}, pile::Tip{pile::ConicalTip{}}}) {
    scene::SceneSpec scene = drive_of_300(tip);
    scene.pile->driving = pile::ConstantDriving{0.02};
    const Bed& bed = settled(scene.bed);
    const Simulation sim = build(scene, bed, {});
    double clearance = 1;
    for (std::size_t i = 0; i < sim.grains.count(); ++i) {
      const grains::Disc& d = sim.grains.disc[i];
      if (std::abs(d.x) < 0.05 + d.radius) clearance = std::min(clearance, sim.pile->start - d.y - d.radius);
    }
    scene.pile->depth.reset();
    scene.pile->duration = 1;
    const Drive run = drive(scene, {1e-5, {}, 0.01, 0.05}, bed);
    double untouched = 0;
    for (const Record& r : run.records) {
      if (r.tip_force_y != 0) break;
      EXPECT_EQ(r.sleeve_force_y, 0);
      EXPECT_EQ(r.pile_work, 0);
      untouched = r.travel;
    }
    EXPECT_GE(untouched, clearance - 1.01e-5);
    EXPECT_GT(untouched, 0);
    EXPECT_LT(untouched, 0.019);
  }
}

TEST(Run, TheSoilResistsAndThePileDoesTheWork) {
  for (const bool flat : {false, true}) {
    const Drive& run = usual(flat);
    double impulse = 0;
    for (const Record& r : run.records) {
      EXPECT_EQ(r.tip_resistance, r.tip_force_y / 0.1);
      EXPECT_EQ(r.tip_resistance_thesis, r.tip_force_y / 0.05);
      EXPECT_NEAR(r.speed, 0.4, 1e-9);
      impulse += r.span * (r.tip_force_y + r.sleeve_force_y);
    }
    EXPECT_GT(impulse, 0);
    EXPECT_NEAR(run.records.back().pile_work, 0.4 * impulse, 1e-9 * run.records.back().pile_work);
    // Single precision: a ten-thousandth of the work over 800 steps is what the balance may lack.
    EXPECT_LT(std::abs(metric(run.result.metrics, "energy_error")), 1e-3);
    EXPECT_LT(metric(run.result.metrics, "overlap_max"), 0.015);
  }
}

TEST(Run, FramesAreTakenAtTheirDepthsWithinTheTravelOfAStep) {
  for (const bool flat : {false, true}) {
    const Drive& run = usual(flat);
    ASSERT_EQ(run.frames.size(), 3u);
    const double asked[] = {0, 0.05, 0.12};
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(run.frames[k].asked, asked[k]);
      EXPECT_NEAR(run.frames[k].depth, asked[k], 0.4 * kStep);
    }
    EXPECT_EQ(run.frames[2].time, run.result.time);
  }
}

TEST(Run, AFrameAboveTheStartIsTakenAtTheStartAndOneBelowTheEndNever) {
  const scene::SceneSpec scene = drive_of_300(pile::FlatTip{});
  scene::RecordSpec record;
  record.frames = {0.3, -1, 0.02, 0.1203};
  const Drive run = drive(scene, record, settled(scene.bed));
  ASSERT_EQ(run.frames.size(), 2u);
  EXPECT_EQ(run.frames[0].asked, -1);
  EXPECT_LE(run.frames[0].time, kStep);
  EXPECT_EQ(run.frames[1].asked, 0.02);
}

TEST(Run, FramesAndRecordsChangeNoBitOfTheRest) {
  const scene::SceneSpec scene = drive_of_300(pile::FlatTip{});
  scene::RecordSpec record = small_record();
  record.frames = {};
  EXPECT_EQ(drive(scene, record, settled(scene.bed)).result.state_hash, usual(true).result.state_hash);
  record.frames = {0.01, 0.011, 0.012, 0.05};
  record.window = 0.1;
  record.travel = 0.0037;
  record.spacing = 0.2;
  EXPECT_EQ(drive(scene, record, settled(scene.bed)).result.state_hash, usual(true).result.state_hash);
}

TEST(Run, ProgressRisesToTheEnd) {
  const std::vector<Progress>& progress = usual(true).progress;
  EXPECT_EQ(progress.size(), usual(true).records.size());
  for (std::size_t k = 1; k < progress.size(); ++k) {
    EXPECT_GT(progress[k].fraction, progress[k - 1].fraction);
    EXPECT_GT(progress[k].depth, progress[k - 1].depth);
  }
  EXPECT_LT(progress.front().fraction, 0.05);
  EXPECT_EQ(progress.back().fraction, 1);
}

TEST(Run, WithoutAPileIsRefused) {
  scene::SceneSpec scene = drive_of_300(pile::FlatTip{});
  scene.pile.reset();
  EXPECT_THROW(run(scene, {}, settled(scene.bed), {}, {}, {}, {}), std::invalid_argument);
}

TEST(NumericsVersions, NameEveryModuleOnce) {
  std::vector<std::string> names;
  for (const NumericsVersion& v : numerics_versions(scene::SceneSpec{})) {
    names.push_back(v.module);
    EXPECT_GE(v.version, 1);
  }
  EXPECT_THAT(names, testing::UnorderedElementsAre("grains", "pile", "bed", "record"));
}

// Results of dry scenes stay fresh, whatever becomes of the fluid.
TEST(NumericsVersions, ASaturatedSceneHasThoseOfADryOneAndOfTheFluid) {
  scene::SceneSpec scene;
  const std::size_t dry = numerics_versions(scene).size();
  scene.fluid.emplace();
  const std::vector<NumericsVersion> all = numerics_versions(scene);
  std::vector<std::string> of_fluid;
  for (std::size_t i = dry; i < all.size(); ++i) of_fluid.push_back(all[i].module);
  EXPECT_THAT(of_fluid, testing::ElementsAre("mesh", "fluid", "free_surface", "basin", "coupling"));
}

TEST(NumericsVersions, OnOtherContactsThanTheBedsADriveHasThoseOfItsRest) {
  scene::SceneSpec scene = drive_of_300(pile::FlatTip{});
  const auto has_rest = [&] {
    return std::ranges::any_of(numerics_versions(scene), [](const auto& v) { return v.module == "rest"; });
  };
  EXPECT_FALSE(has_rest());
  scene.contact.substeps = 20;
  EXPECT_TRUE(has_rest());
  scene.pile.reset();
  EXPECT_FALSE(has_rest()) << "a bed alone";
}

TEST(NumericsVersions, ABasinHasThoseOfTheWaterAndItsOwn) {
  scene::SceneSpec scene;
  scene.basin.emplace();
  std::vector<std::string> names;
  for (const NumericsVersion& v : numerics_versions(scene)) names.push_back(v.module);
  EXPECT_THAT(names, testing::ElementsAre("mesh", "fluid", "free_surface", "basin"));
}

TEST(Parts, ABasinSaysWhatItIsBuiltWithAndWhy) {
  const auto of = [](const scene::SceneSpec& scene, const std::string& name) {
    for (const Part& part : parts(scene)) {
      if (part.name == name) return part;
    }
    throw std::out_of_range(name);
  };
  scene::SceneSpec scene;
  scene.basin.emplace();
  for (const char* dry : {"grains", "walls", "restitution"}) {
    EXPECT_FALSE(of(scene, dry).built);
    EXPECT_EQ(of(scene, dry).reason, "the scene is a basin of water");
  }
  for (const char* wet : {"mesh", "fluid", "free_surface"}) EXPECT_TRUE(of(scene, wet).built) << wet;
  EXPECT_FALSE(of(scene, "pile").built);
  EXPECT_EQ(of(scene, "pile").reason, "the basin has none: \"pile\" is null");
  scene.basin->pile.emplace();
  scene.basin->surface.reset();
  EXPECT_TRUE(of(scene, "pile").built);
  EXPECT_FALSE(of(scene, "free_surface").built);
  EXPECT_EQ(of(scene, "free_surface").reason, "the top is fixed: \"surface\" is null");
}

}  // namespace
}  // namespace seapile::simulation
