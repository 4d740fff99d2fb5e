// Laws of a basin's run, from its spec to its result.
#include "solver/simulation/basin.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "solver/simulation/flow_state.h"

namespace seapile::simulation {
namespace {

double metric(const RunResult& result, const std::string& name) {
  const auto found = std::ranges::find(result.metrics, name, &Metric::name);
  EXPECT_NE(found, result.metrics.end()) << name;
  return found == result.metrics.end() ? 0 : found->value;
}

/// A pile that goes down through one remesh at least.
basin::BasinSpec driven() {
  basin::BasinSpec spec;
  spec.width = 5;
  spec.depth = 2.4;
  spec.pile = basin::BasinPileSpec{};
  spec.mesh.pattern = basin::UnstructuredMesh{0.2, 0.15, 0.15};
  spec.mesh.motion = basin::ZonesMotion{0.5};
  spec.mesh.remesh = basin::RemeshSpec{};
  spec.mesh.remesh->share = 0.02;
  spec.time.step = 0.025;
  spec.time.duration = 5;
  return spec;
}

/// Steps of a stretch: as many as between two records at least.
constexpr int kStretch = 10;

struct Told {
  std::vector<FlowRecord> records;
  std::vector<FlowFrame> frames;
  std::vector<std::vector<Array>> states;  ///< at every record but the first and last one
  RunResult result;
};

Told told(const basin::BasinSpec& spec, const scene::RecordSpec& record, const std::vector<Array>& from = {},
          const std::vector<FlowRecord>& so_far = {}, Simd simd = Simd::best, bool checkpoints = true) {
  Told all;
  BasinHooks hooks;
  hooks.record = [&](const FlowRecord& r) { all.records.push_back(r); };
  hooks.frame = [&](const FlowFrame& f) { all.frames.push_back(f); };
  if (checkpoints) {
    hooks.checkpoint_due = [] { return true; };
    hooks.checkpoint = [&](const std::vector<Array>& state) { all.states.push_back(state); };
  }
  all.result = run_basin(spec, record, {1, simd, {kStretch}}, from, so_far, hooks);
  EXPECT_EQ(all.result.outcome, Outcome::completed) << all.result.reason;
  return all;
}

scene::RecordSpec every(double interval, std::vector<double> times = {}) {
  scene::RecordSpec record;
  record.interval = interval;
  record.times = std::move(times);
  return record;
}

// NaN is what is absent: it equals itself here.
bool same(const FlowRecord& a, const FlowRecord& b) {
  std::vector<double> left, right;
  columns([&](const char*, const char*, const char*, double v) { left.push_back(v); }, a);
  columns([&](const char*, const char*, const char*, double v) { right.push_back(v); }, b);
  return std::ranges::equal(left, right, [](double x, double y) { return x == y || (x != x && y != y); });
}

TEST(BasinRun, ContinuesWithTheSameBitsBeforeAndAfterARemesh) {
  const scene::RecordSpec record = every(0.25, {1, 4});
  const basin::BasinSpec spec = driven();
  const Told whole = told(spec, record);
  ASSERT_GE(metric(whole.result, "meshes"), 2);
  for (std::size_t k = 0; k < whole.states.size(); ++k) {
    const std::vector<FlowRecord> so_far(whole.records.begin(),
                                         whole.records.begin() + static_cast<std::ptrdiff_t>(k) + 2);
    const Told rest = told(spec, record, whole.states[k], so_far);
    EXPECT_EQ(rest.result.state_hash, whole.result.state_hash) << k;
    ASSERT_EQ(rest.records.size() + so_far.size(), whole.records.size());
    for (std::size_t i = 0; i < rest.records.size(); ++i)
      EXPECT_TRUE(same(rest.records[i], whole.records[so_far.size() + i])) << k << " " << i;
    EXPECT_EQ(hash_of(rest.frames.back()), hash_of(whole.frames.back()));
    for (std::size_t m = 0; m < whole.result.metrics.size(); ++m)
      EXPECT_EQ(rest.result.metrics[m].value, whole.result.metrics[m].value) << whole.result.metrics[m].name;
  }
}

TEST(BasinRun, GivesTheSameBitsOnARerunWithEveryInstructionSetAndWithoutCheckpoints) {
  const scene::RecordSpec record = every(0.5);
  basin::BasinSpec spec = driven();
  spec.time.duration = 3;
  const std::uint64_t hash = told(spec, record).result.state_hash;
  EXPECT_EQ(told(spec, record, {}, {}, Simd::best, false).result.state_hash, hash);
  for (const Simd simd : {Simd::generic, Simd::avx2, Simd::avx512}) {
    if (simd == Simd::avx2 && base::fastest() == base::InstructionSet::generic) continue;
    if (simd == Simd::avx512 && base::fastest() != base::InstructionSet::avx512) continue;
    EXPECT_EQ(told(spec, record, {}, {}, simd).result.state_hash, hash);
  }
}

TEST(BasinRun, HandsOutTheFramesThatWereAskedForOnTheMeshesOfTheirTimes) {
  const Told all = told(driven(), every(1, {2.5, 3.3}));
  ASSERT_EQ(all.frames.size(), 4u);
  EXPECT_EQ(all.frames[0].time, 0);
  EXPECT_NEAR(all.frames[1].time, 2.5, 1e-12);
  EXPECT_NEAR(all.frames[2].time, 3.3, 0.0126);  // the step next to it
  EXPECT_EQ(all.frames[3].time, 5);
  EXPECT_NE(hash_of(all.frames[0]), hash_of(all.frames[3]));
  ASSERT_EQ(all.records.size(), 6u);
  EXPECT_EQ(all.records.back().time, 5);
}

TEST(BasinRun, AFixedTopBuildsNoSurface) {
  scene::SceneSpec scene;
  scene.basin = driven();
  scene.basin->surface.reset();
  scene.basin->time.duration = 1;
  const auto list = parts(scene);
  const auto surface = std::ranges::find(list, "free_surface", &Part::name);
  ASSERT_NE(surface, list.end());
  EXPECT_FALSE(surface->built);
  const Told all = told(*scene.basin, every(0.5));
  EXPECT_TRUE(all.frames.back().surface.empty());
  EXPECT_NE(all.records.back().rise, all.records.back().rise);
}

TEST(BasinRun, KeepsItsLastGoodStateWhenItCannotGoOn) {
  basin::BasinSpec spec = driven();
  spec.mesh.motion = basin::EllipticMotion{};
  spec.mesh.remesh.reset();
  std::vector<FlowFrame> frames;
  std::vector<Array> state;
  BasinHooks hooks;
  hooks.frame = [&](const FlowFrame& f) { frames.push_back(f); };
  hooks.checkpoint = [&](const std::vector<Array>& s) { state = s; };
  const RunResult result = run_basin(spec, every(0.5), {}, {}, {}, hooks);
  EXPECT_EQ(result.outcome, Outcome::diverged);
  EXPECT_NE(result.reason.find("would turn over at x = "), std::string::npos) << result.reason;
  EXPECT_GT(result.time, 0);
  EXPECT_FALSE(state.empty());
  EXPECT_EQ(frames.back().time, result.time);
  EXPECT_EQ(metric(result, "reached"), result.time);
}

TEST(BasinRun, ASmallWaveHasTheExactFrequencyAndDecay) {
  basin::BasinSpec spec;
  spec.depth = 0.5;
  spec.viscosity = 3;
  spec.surface->initial = basin::CosineSurface{};
  spec.mesh.pattern = basin::StructuredMesh{32, 16, 0.3};
  spec.time.step = 0.01;
  spec.time.duration = 13;
  for (const basin::WallKind bottom : {basin::WallKind::slip, basin::WallKind::no_slip}) {
    spec.bottom = bottom;
    const Told all = told(spec, every(0.05));
    EXPECT_LT(std::abs(metric(all.result, "frequency_error")), 0.01);
    EXPECT_LT(std::abs(metric(all.result, "decay_error")),
              0.05);  // a coarse mesh; studies/small_wave.json has a fine one
    EXPECT_LT(metric(all.result, "volume_drift"), 1e-12);
  }
}

}  // namespace
}  // namespace seapile::simulation
