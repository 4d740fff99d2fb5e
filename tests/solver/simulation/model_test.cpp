// What leaving a part out changes, measured against the bound that the scene's analysis claims.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "solver/scene/analysis.h"
#include "solver/scene/predictions.h"
#include "solver/simulation/basin.h"
#include "solver/simulation/build.h"
#include "solver/simulation/jet.h"
#include "solver/simulation/step.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

using scene::Choice;
using scene::SceneSpec;
using std::numbers::pi;

double metric(const RunResult& result, const std::string& name) {
  const auto found = std::ranges::find(result.metrics, name, &Metric::name);
  if (found == result.metrics.end()) throw std::out_of_range(name);
  return found->value;
}

Part part_of(const SceneSpec& scene, const std::string& name) {
  const std::vector<Part> all = parts(scene);
  return *std::ranges::find(all, name, &Part::name);
}
double bound_of(const SceneSpec& scene, const std::string& name) { return part_of(scene, name).criterion->bound; }

/// A basin's run, as a worker does it.
struct Ran {
  std::vector<FlowRecord> records;
  RunResult result;
};
Ran run_of(const SceneSpec& scene, double interval = 0.05) {
  Ran ran;
  scene::RecordSpec record;
  record.interval = interval;
  BasinHooks hooks;
  hooks.record = [&](const FlowRecord& r) { ran.records.push_back(r); };
  ran.result = run_basin(*scene::as_built(scene).basin, record, {}, {}, {}, hooks);
  EXPECT_EQ(ran.result.outcome, Outcome::completed) << ran.result.reason;
  return ran;
}

double swell_of(const SceneSpec& scene) {
  const RunResult result = run_jet(*scene::as_built(scene).jet, {}, {}, {});
  EXPECT_EQ(result.outcome, Outcome::completed) << result.reason;
  return metric(result, "swell_ratio");
}

/// A standing wave under a tension that makes its Bond number.
SceneSpec wave_of(double bond) {
  SceneSpec scene;
  basin::BasinSpec& basin = scene.basin.emplace();
  basin.depth = 0.5;
  basin.viscosity = 1;
  basin.surface->initial = basin::CosineSurface{};
  basin.surface->tension = 9810 / (bond * pi * pi);
  basin.mesh.pattern = basin::StructuredMesh{32, 16};
  basin.time.step = 0.01;
  basin.time.duration = 10;
  return scene;
}

/// Relative change of the wave's frequency by leaving its tension out.
double change_without_tension(SceneSpec scene) {
  scene.model.surface_tension = Choice::yes;
  const double with = metric(run_of(scene).result, "frequency");
  scene.model.surface_tension = Choice::no;
  return std::abs(metric(run_of(scene).result, "frequency") / with - 1);
}

TEST(Model, TensionAtALargeBondNumberChangesTheFrequencyByLessThanItsBound) {
  const SceneSpec scene = wave_of(1.2 * scene::kLargeBond);
  EXPECT_FALSE(part_of(scene, "surface_tension").built);
  const double change = change_without_tension(scene), bound = bound_of(scene, "surface_tension");
  RecordProperty("change", std::to_string(change));
  EXPECT_LT(change, 1.01 * bound);  // sqrt(1 + 1/Bo) - 1 is all but 1/(2 Bo)
  EXPECT_GT(change, 0.9 * bound) << "the bound is no larger than it has to be";
  EXPECT_LT(bound, 1e-3);
}

TEST(Model, AWaveAtASmallBondNumberKeepsItsTension) {
  SceneSpec scene = wave_of(10);
  EXPECT_TRUE(part_of(scene, "surface_tension").built);
  const RunResult by_need = run_of(scene).result;
  EXPECT_GT(change_without_tension(scene), 0.04);
  scene.model.surface_tension = Choice::yes;
  EXPECT_EQ(run_of(scene).result.state_hash, by_need.state_hash);
}

/// A pile that is pushed into a box of liquid, through its start and on.
SceneSpec pushed(double viscosity, double speed, double travel) {
  SceneSpec scene;
  basin::BasinSpec& basin = scene.basin.emplace();
  basin.width = 2;
  basin.depth = 1;
  basin.viscosity = viscosity;
  basin.bottom = basin::WallKind::no_slip;
  basin.pile = basin::BasinPileSpec{0.1, pile::ConicalTip{}, pile::ConstantDriving{speed}, 0.3};
  basin.mesh = {basin::UnstructuredMesh{0.1, 0.05, 0.15}, basin::ZonesMotion{0.5}, {}};
  basin.time.duration = travel / speed;
  basin.time.step = basin.time.duration / 40;
  return scene;
}

/// Largest change of the force on the pile by leaving convection out, by the largest force.
double change_without_convection(SceneSpec scene) {
  const double interval = scene.basin->time.step;
  scene.model.convection = Choice::yes;
  const Ran with = run_of(scene, interval);
  scene.model.convection = Choice::no;
  const Ran without = run_of(scene, interval);
  double change = 0, most = 0;
  for (std::size_t i = 1; i < with.records.size(); ++i) {
    change = std::max(change, std::abs(with.records[i].pile_force_y - without.records[i].pile_force_y));
    most = std::max(most, std::abs(with.records[i].pile_force_y));
  }
  return change / most;
}

TEST(Model, ConvectionOfACreepingFlowChangesTheForceByLessThanItsBound) {
  const SceneSpec scene = pushed(2500, 2e-3, 0.1);
  EXPECT_NEAR(scene::predictions(scene)->reynolds, 8e-4, 1e-15);
  EXPECT_FALSE(part_of(scene, "convection").built);
  const double change = change_without_convection(scene);
  RecordProperty("change", std::to_string(change));
  EXPECT_LT(change, bound_of(scene, "convection"));
  EXPECT_GT(change, 0) << "the term is not there";
}

TEST(Model, ConvectionOfAFastFlowChangesItByMore) {
  const SceneSpec scene = pushed(1, 0.2, 0.1);
  EXPECT_TRUE(part_of(scene, "convection").built);
  const double change = change_without_convection(scene);
  RecordProperty("change", std::to_string(change));
  EXPECT_GT(change, 10 * scene::kSmallReynolds);
}

/// Largest change of the pressure on the pile by fixing the top, by rho g H [-].
double change_with_fixed_top(SceneSpec scene) {
  const basin::BasinSpec& basin = *scene.basin;
  const double interval = basin.time.step;
  scene.model.free_surface = Choice::yes;
  const Ran free = run_of(scene, interval);
  scene.model.free_surface = Choice::no;
  const Ran fixed = run_of(scene, interval);
  double change = 0;
  for (std::size_t i = 1; i < free.records.size(); ++i)
    change = std::max(change, std::abs(free.records[i].pile_force_y - fixed.records[i].pile_force_y));
  return change / (basin.density * basin.gravity * basin.depth * 2 * basin.pile->radius);
}

TEST(Model, AFixedTopChangesThePressureByLessThanItsBoundWhereThePileHardlyLiftsTheWater) {
  const SceneSpec scene = pushed(1, 1e-3, 4e-3);
  EXPECT_FALSE(part_of(scene, "free_surface").built);
  EXPECT_TRUE(std::isnan(run_of(scene).records.back().rise)) << "there is no surface to have risen";
  const double change = change_with_fixed_top(scene);
  RecordProperty("change", std::to_string(change));
  EXPECT_LT(change, bound_of(scene, "free_surface"));
  EXPECT_GT(change, 0.1 * bound_of(scene, "free_surface")) << "the bound says something";
}

TEST(Model, AFixedTopChangesItByMoreWhereThePileGoesFar) {
  const SceneSpec scene = pushed(1, 0.05, 0.1);
  EXPECT_TRUE(part_of(scene, "free_surface").built);
  const double change = change_with_fixed_top(scene);
  EXPECT_GT(change, scene::kSmallSurfaceChange);
  EXPECT_LT(change, bound_of(scene, "free_surface"));
}

TEST(Model, APileThatHardlyMovesAsksForNoNewMesh) {
  SceneSpec scene = pushed(1, 1e-3, 4e-4);
  scene.basin->mesh.remesh.emplace();
  EXPECT_FALSE(part_of(scene, "remeshing").built);
  std::vector<Ran> runs;
  for (const Choice choice : {Choice::yes, Choice::no}) {
    scene.model.remeshing = choice;
    runs.push_back(run_of(scene));
  }
  EXPECT_EQ(runs[0].result.state_hash, runs[1].result.state_hash);
  EXPECT_EQ(metric(runs[0].result, "meshes"), 1);
}

TEST(Model, AJetsSmallNumbersChangeItsSwellByLessThanTheirBounds) {
  SceneSpec scene;
  fluid::JetSpec& jet = scene.jet.emplace();
  jet.lip_size = 0.05;
  jet.largest_size = 0.3;
  jet.reynolds = 0.9 * scene::kSmallReynolds;
  jet.capillary = 1.1 * scene::kLargeCapillary;
  const double neither = swell_of(scene);
  scene.model.convection = Choice::yes;
  EXPECT_LT(std::abs(swell_of(scene) / neither - 1), bound_of(scene, "convection"));
  scene.model = {};
  scene.model.surface_tension = Choice::yes;
  const double change = std::abs(swell_of(scene) / neither - 1);
  EXPECT_LT(change, bound_of(scene, "surface_tension"));
  EXPECT_GT(change, 0);
}

// Without density there is no inertia at all: today's creeping jets keep their bits.
TEST(Model, WithoutDensityConvectionIsNothing) {
  SceneSpec scene;
  scene.jet.emplace().reynolds = 0;
  scene.jet->lip_size = 0.05;
  const RunResult without = run_jet(*scene::as_built(scene).jet, {}, {}, {});
  EXPECT_FALSE(part_of(scene, "convection").built);
  EXPECT_EQ(run_jet(*scene.jet, {}, {}, {}).state_hash, without.state_hash);
}

// The bed is the same, and from then on nothing turns: at walls, at the pile, between grains.
TEST(Model, GrainsMayBeKeptFromSpinning) {
  SceneSpec scene = support::small_drive(100, 0.5, pile::FlatTip{});
  const Bed& bed = support::settled(scene.bed);
  std::vector<double> largest;
  for (const scene::Rotation rotation : {scene::Rotation::yes, scene::Rotation::no}) {
    scene.model.rotation = rotation;
    EXPECT_EQ(part_of(scene, "rotation").built, rotation == scene::Rotation::yes);
    Simulation sim = build(scene, bed, {});
    for (int k = 0; k < 200; ++k) step(sim, false);
    double most = 0;
    std::visit(
        [&](const auto& system) {
          for (std::size_t i = 0; i < sim.grains.count(); ++i)
            most = std::max(most, std::abs(static_cast<double>(system.motion(static_cast<std::int32_t>(i)).u)));
        },
        sim.contacts);
    largest.push_back(most);
  }
  EXPECT_GT(largest[0], 0);
  EXPECT_EQ(largest[1], 0);
}

// Nothing of a fluid is computed, not even to be multiplied by zero: its parts have no entry among what the time went
// into.
TEST(Model, ADrySceneSolvesNoFluid) {
  const SceneSpec scene = support::small_drive(100, 0.5, pile::FlatTip{});
  const support::Drive dry = support::drive(scene, support::small_record(), support::settled(scene.bed));
  ASSERT_FALSE(dry.result.profile.empty());
  for (const ProfileEntry& entry : dry.result.profile) {
    EXPECT_EQ(entry.part.find("fluid"), std::string::npos) << entry.part;
    EXPECT_EQ(entry.part.find("remesh"), std::string::npos) << entry.part;
    EXPECT_EQ(entry.part.find("domain"), std::string::npos) << entry.part;
  }
}

}  // namespace
}  // namespace seapile::simulation
