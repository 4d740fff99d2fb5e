// Laws of a saturated bed: grains, water and pile together, from the scene to the result.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "solver/simulation/build.h"
#include "solver/simulation/flow_state.h"
#include "solver/simulation/state.h"
#include "solver/simulation/step.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

using support::settled;

/// 300 grains under 0.6 m of water, and a pile that goes down through a remesh.
scene::SceneSpec wet() {
  scene::SceneSpec scene = support::small_drive(300, 0.8, pile::ConicalTip{});
  scene.bed.domain.height = 1.2;
  scene::FluidSpec& fluid = scene.fluid.emplace();
  fluid.depth = 0.9;
  fluid.mesh.size = 0.09;
  fluid.mesh.pile_size = 0.06;
  fluid.mesh.motion = basin::ZonesMotion{0.2};
  fluid.mesh.remesh->share = 0.05;
  fluid.time.step = 1e-3;
  return scene;
}

struct Told {
  std::vector<Record> records;
  std::vector<FlowRecord> flow_records;
  std::vector<Frame> frames;
  std::vector<FlowFrame> flow_frames;
  std::vector<std::vector<Array>> states;
  std::vector<std::size_t> records_before;  ///< of each state
  RunResult result;
};

Told told(const scene::SceneSpec& scene, const Execution& execution = {}, const std::vector<Array>& from = {},
          const RecordsSoFar& so_far = {}, int checkpoint_every = 0) {
  Told all;
  RunHooks hooks;
  hooks.record = [&](const Record& r) { all.records.push_back(r); };
  hooks.flow_record = [&](const FlowRecord& r) { all.flow_records.push_back(r); };
  hooks.frame = [&](const Frame& f) { all.frames.push_back(f); };
  hooks.flow_frame = [&](const FlowFrame& f) { all.flow_frames.push_back(f); };
  if (checkpoint_every > 0) {
    hooks.checkpoint_due = [&] { return all.records.size() % static_cast<std::size_t>(checkpoint_every) == 0; };
    hooks.checkpoint = [&](const std::vector<Array>& state) {
      all.states.push_back(state);
      all.records_before.push_back(all.records.size());
    };
  }
  all.result = run(scene, support::small_record(), settled(scene.bed), execution, from, so_far, hooks);
  EXPECT_EQ(all.result.outcome, Outcome::completed) << all.result.reason;
  return all;
}

double metric(const RunResult& result, const std::string& name) {
  const auto found = std::ranges::find(result.metrics, name, &Metric::name);
  EXPECT_NE(found, result.metrics.end()) << name;
  return found == result.metrics.end() ? std::nan("") : found->value;
}

template <class R>
std::vector<double> row_of(const R& record) {
  std::vector<double> row;
  columns([&](const char*, const char*, const char*, double v) { row.push_back(v); }, record);
  return row;
}

/// NaN is what is absent: it equals itself here.
template <class R>
bool same(const R& a, const R& b) {
  return std::ranges::equal(row_of(a), row_of(b), [](double x, double y) { return x == y || (x != x && y != y); });
}

TEST(SaturatedRun, KeepsTheVolumeOfTheMixtureThroughAPenetrationWithARemesh) {
  const Told all = told(wet());
  EXPECT_GE(metric(all.result, "meshes"), 2);
  // What is measured is 1e-15 to 1e-13; a fluid that lost what one grain fills would show 1e-3.
  EXPECT_LT(metric(all.result, "volume_error_max"), 1e-8);
  EXPECT_EQ(metric(all.result, "clipped_volume_max"), 0);
  for (const FlowRecord& r : all.flow_records) EXPECT_NEAR(r.immersed, 1, 1e-6);
}

TEST(SaturatedRun, HandsOutBothPhasesTogether) {
  const Told all = told(wet());
  ASSERT_EQ(all.records.size(), all.flow_records.size());
  ASSERT_EQ(all.frames.size(), all.flow_frames.size());
  EXPECT_EQ(all.frames.size(), 3u);
  const double dt = wet().fluid->time.step;
  for (std::size_t k = 0; k < all.records.size(); ++k)
    EXPECT_LE(std::abs(all.records[k].time - all.flow_records[k].time), dt);
}

TEST(SaturatedRun, BalancesTheEnergyOfItsGrainsWithTheWorkOfTheFluid) {
  // In single precision the dry balance closes to the same 1e-4.
  EXPECT_LT(std::abs(metric(told(wet()).result, "energy_error")), 1e-4);
}

TEST(SaturatedRun, ContinuesWithTheSameBitsBeforeAndAfterARemesh) {
  scene::SceneSpec scene = wet();
  const Told whole = told(scene, {}, {}, {}, 37);
  ASSERT_GE(metric(whole.result, "meshes"), 2);
  ASSERT_GE(whole.states.size(), 4u);
  bool first_mesh = false, later_mesh = false;
  for (std::size_t k = 0; k < whole.states.size(); ++k) {
    const auto before = static_cast<std::ptrdiff_t>(whole.records_before[k]);
    (whole.flow_records[before - 1].meshes > 1 ? later_mesh : first_mesh) = true;
    const RecordsSoFar so_far{{whole.records.begin(), whole.records.begin() + before},
                              {whole.flow_records.begin(), whole.flow_records.begin() + before}};
    const Told rest = told(scene, {}, whole.states[k], so_far);
    EXPECT_EQ(rest.result.state_hash, whole.result.state_hash) << k;
    ASSERT_EQ(rest.records.size() + so_far.records.size(), whole.records.size());
    for (std::size_t i = 0; i < rest.records.size(); ++i) {
      EXPECT_TRUE(same(rest.records[i], whole.records[so_far.records.size() + i])) << k << " " << i;
      EXPECT_TRUE(same(rest.flow_records[i], whole.flow_records[so_far.records.size() + i])) << k << " " << i;
    }
    EXPECT_EQ(hash_of(rest.flow_frames.back()), hash_of(whole.flow_frames.back()));
    ASSERT_EQ(rest.result.metrics.size(), whole.result.metrics.size());
    for (std::size_t m = 0; m < whole.result.metrics.size(); ++m)
      EXPECT_EQ(rest.result.metrics[m].value, whole.result.metrics[m].value) << whole.result.metrics[m].name;
  }
  EXPECT_TRUE(first_mesh && later_mesh);
}

TEST(SaturatedRun, GivesTheSameBitsForAnyThreadsAndInstructions) {
  scene::SceneSpec scene = wet();
  scene.pile->depth = 0.06;
  const std::uint64_t hash = told(scene, {1, Simd::generic}).result.state_hash;
  for (const Execution execution : {Execution{1, Simd::best}, Execution{2, Simd::best}, Execution{3, Simd::generic}})
    EXPECT_EQ(told(scene, execution).result.state_hash, hash) << execution.threads;
}

TEST(SaturatedRun, DoesTheSameStepsBetweenRecordsWhateverIsRecorded) {
  scene::SceneSpec scene = wet();
  scene.pile->depth = 0.06;
  scene::RecordSpec seldom;
  seldom.travel = 0.03;
  seldom.frames = {};
  const RunResult result = run(scene, seldom, settled(scene.bed), {}, {}, {}, {});
  const Told often = told(scene);
  EXPECT_EQ(result.time, often.result.time);
  EXPECT_EQ(metric(result, "steps"), metric(often.result, "steps"));
  EXPECT_EQ(metric(result, "corrections"), metric(often.result, "corrections"));
}

TEST(SaturatedRun, GoesBackToTheSameBitsWhenAStepIsRejected) {
  const scene::SceneSpec scene = wet();
  Simulation sim = build(scene, settled(scene.bed), {});
  for (int k = 0; k < 7; ++k) step(sim);  // in the middle of a step of the fluid
  const Trial trial(sim);
  const auto go_on = [&] {
    for (int k = 0; k < 60; ++k) {
      const StepReport report = step(sim);
      EXPECT_EQ(objection(sim, report), "");
    }
    return state_hash(sim);
  };
  const std::uint64_t hash = go_on();
  trial.reject(sim);
  EXPECT_EQ(compare(snapshot(sim), trial.start()), "");
  EXPECT_EQ(go_on(), hash);
}

/// Largest distance of a grain from its place in another run, by the smallest radius.
double largest_difference(const Frame& a, const Frame& b) {
  const auto places = [](const Frame& f) {
    const auto found = std::ranges::find(f.grains, "grains/position", [](const Array& x) { return x.info.name; });
    return std::get<std::vector<double>>(found->values);
  };
  const std::vector<double> p = places(a), q = places(b);
  double most = 0;
  for (std::size_t k = 0; k < p.size(); ++k) most = std::max(most, std::abs(p[k] - q[k]));
  return most / grains::RadiusSpec{}.min;
}

// Until the packing's chaos shows: the first 20 mm of the drive, at which grains have moved by several of these bounds.
TEST(SaturatedRun, TendsToTheDryRunAsTheFluidGetsThin) {
  scene::SceneSpec scene = wet();
  scene.contact.precision = grains::Precision::double_;
  scene.pile->depth = 0.02;
  scene::RecordSpec record;
  record.frames = {0.02};
  const auto last_frame = [&](const scene::SceneSpec& one) {
    std::vector<Frame> frames;
    RunHooks hooks;
    hooks.frame = [&](const Frame& f) { frames.push_back(f); };
    const RunResult result = run(one, record, settled(one.bed), {}, {}, {}, hooks);
    EXPECT_EQ(result.outcome, Outcome::completed) << result.reason;
    return frames.back();
  };
  scene::SceneSpec dry = scene;
  dry.fluid.reset();
  const Frame reference = last_frame(dry);
  double last = 1;
  for (const double density : {1.0, 1e-3}) {
    scene.fluid->density = density;
    const double difference = largest_difference(last_frame(scene), reference);
    std::printf("density %g: grains are %.2e smallest radii from where the dry ones are\n", density, difference);
    EXPECT_LT(difference, last);
    last = difference;
  }
  // The second settling moves grains that were not quite at rest by as much.
  EXPECT_LT(last, 0.02);
}

TEST(SaturatedRun, BuildsNoWaterForADryScene) {
  scene::SceneSpec scene = wet();
  scene.fluid.reset();
  const Simulation sim = build(scene, settled(scene.bed), {});
  EXPECT_FALSE(sim.water.has_value());
  EXPECT_TRUE(sim.grains.push.empty());
  for (const Part& part : parts(scene))
    if (part.name == "mesh" || part.name == "fluid" || part.name == "free_surface" || part.name == "coupling")
      EXPECT_FALSE(part.built) << part.name;
  for (const Array& array : snapshot(sim)) EXPECT_FALSE(array.info.name.starts_with("water/"));
}

}  // namespace
}  // namespace seapile::simulation
