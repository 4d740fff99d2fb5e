// A step that is taken back leaves no trace, and a run that is stopped goes on as if it had not been: every kind of
// time loop, with every method.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "solver/simulation/basin.h"
#include "solver/simulation/flow_state.h"
#include "solver/simulation/run.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

using support::metric;
using support::settled;
using support::small_drive;

/// Everything that a run hands out, in its order, as bytes.
struct Told {
  std::vector<std::string> bytes;
  RunResult result;
  std::vector<Array> sealed;  ///< where it was stopped
  RecordsSoFar so_far;
  double time = 0;  ///< that progress was told of last [s]
};

template <class T>
std::string bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}
std::string bytes_of(std::initializer_list<const std::vector<Array>*> lists) {
  std::string bytes;
  for (const auto* list : lists)
    for (const Array& array : *list)
      bytes += array.info.name + std::visit([](const auto& v) { return bytes_of(std::span(v)); }, array.values);
  return bytes;
}
template <class R>
std::string row_of(const char* kind, const R& record) {
  std::vector<double> row;
  columns([&](const char*, const char*, const char*, double v) { row.push_back(v); }, record);
  return kind + bytes_of(std::span<const double>(row));
}
std::string bytes_of(const FlowFrame& frame) {
  return "flow frame " + std::to_string(frame.time) + bytes_of({&frame.vertices, &frame.triangles, &frame.surface});
}

/// Hooks that keep it. `until`: when the run is to be stopped [s].
template <class Hooks>
Hooks keeping(Told& told, double until) {
  Hooks hooks;
  if constexpr (requires { hooks.flow_record; }) {
    hooks.record = [&](const Record& r) {
      told.so_far.records.push_back(r);
      told.bytes.push_back(row_of("record", r));
    };
    hooks.frame = [&](const Frame& f) {
      told.bytes.push_back("frame " + std::to_string(f.time) + bytes_of({&f.grains, &f.contacts, &f.cells}));
    };
    hooks.flow_frame = [&](const FlowFrame& f) { told.bytes.push_back(bytes_of(f)); };
  } else {
    hooks.frame = [&](const FlowFrame& f) { told.bytes.push_back(bytes_of(f)); };
  }
  const auto flow_record = [&](const FlowRecord& r) {
    told.so_far.flow_records.push_back(r);
    told.bytes.push_back(row_of("flow record", r));
  };
  if constexpr (requires { hooks.flow_record; })
    hooks.flow_record = flow_record;
  else
    hooks.record = flow_record;
  hooks.progress = [&](const Progress& p) { told.time = p.time; };
  hooks.stop = [&told, until] { return told.time >= until; };
  hooks.checkpoint = [&](const std::vector<Array>& state) { told.sealed = state; };
  return hooks;
}

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Scene {
  std::string name;
  scene::SceneSpec spec;
  std::int64_t together = 1;  ///< steps of the grains in one of the fluid

  Told run(const Trying& trying, double until = kNever, const Told& before = {}, int threads = 1) const {
    Told told;
    told.bytes = before.bytes;
    told.so_far = before.so_far;
    const Execution execution{threads, Simd::best, trying};
    scene::RecordSpec record = support::small_record();
    record.travel = 2e-3;
    record.interval = 0.05;
    record.times = {0.1, 0.3};
    if (spec.basin)
      told.result = run_basin(*spec.basin, record, execution, before.sealed, before.so_far.flow_records,
                              keeping<BasinHooks>(told, until));
    else
      told.result = simulation::run(spec, record, settled(spec.bed), execution, before.sealed, before.so_far,
                                    keeping<RunHooks>(told, until));
    return told;
  }
};

/// All but what depends on when it is asked.
void expect_same(const Told& found, const Told& expected, const std::string& what) {
  EXPECT_EQ(found.result.outcome, expected.result.outcome) << what << ": " << found.result.reason;
  EXPECT_EQ(found.result.state_hash, expected.result.state_hash) << what;
  ASSERT_EQ(found.bytes.size(), expected.bytes.size()) << what;
  for (std::size_t k = 0; k < found.bytes.size(); ++k)
    ASSERT_TRUE(found.bytes[k] == expected.bytes[k]) << what << ", handed out as number " << k;
  ASSERT_EQ(found.result.metrics.size(), expected.result.metrics.size()) << what;
  for (std::size_t m = 0; m < found.result.metrics.size(); ++m) {
    EXPECT_EQ(found.result.metrics[m].name, expected.result.metrics[m].name) << what;
    EXPECT_EQ(found.result.metrics[m].value, expected.result.metrics[m].value)
        << what << ", " << found.result.metrics[m].name;
  }
}

scene::SceneSpec dry(const pile::Tip& tip) {
  scene::SceneSpec scene = small_drive(150, 0.6, tip);
  scene.pile->depth = 0.08;
  return scene;
}

scene::SceneSpec wet(coupling::Scheme scheme) {
  scene::SceneSpec scene = small_drive(300, 0.8, pile::ConicalTip{});
  scene.bed.domain.height = 1.2;
  scene::FluidSpec& fluid = scene.fluid.emplace();
  fluid.depth = 0.9;
  fluid.mesh.size = 0.09;
  fluid.mesh.pile_size = 0.06;
  fluid.mesh.motion = basin::ZonesMotion{0.2};
  fluid.mesh.remesh->share = 0.02;
  fluid.time.step = 1e-3;
  fluid.coupling.scheme = scheme;
  return scene;
}

scene::SceneSpec wave(basin::SurfaceScheme scheme) {
  scene::SceneSpec scene;
  basin::BasinSpec& basin = scene.basin.emplace();
  basin.surface->initial = basin::CosineSurface{0.01, 1};
  basin.surface->scheme = scheme;
  basin.mesh.pattern = basin::StructuredMesh{16, 4};
  basin.time.step = 5e-3;
  basin.time.duration = 0.5;
  return scene;
}

scene::SceneSpec pile_in_water() {
  scene::SceneSpec scene;
  basin::BasinSpec& basin = scene.basin.emplace();
  basin.width = 5;
  basin.depth = 2.4;
  basin.pile = basin::BasinPileSpec{};
  basin.mesh.pattern = basin::UnstructuredMesh{0.2, 0.15, 0.15};
  basin.mesh.motion = basin::ZonesMotion{0.5};
  basin.mesh.remesh = basin::RemeshSpec{};
  basin.mesh.remesh->share = 0.02;
  basin.time.step = 0.025;
  basin.time.duration = 5;
  return scene;
}

const std::vector<Scene>& scenes() {
  static const std::vector<Scene> all = [] {
    std::vector<Scene> list;
    list.push_back({"dry, flat", dry(pile::FlatTip{})});
    list.push_back({"dry, conical", dry(pile::ConicalTip{})});
    list.push_back({"double precision", dry(pile::FlatTip{})});
    list.back().spec.contact.precision = grains::Precision::double_;
    list.push_back({"non-smooth", dry(pile::ConicalTip{})});
    list.back().spec.contact.method = grains::NonSmoothMethod{10, 1e-6, 1e-3};
    list.back().spec.contact.step = 2e-4;
    list.push_back({"brute force", dry(pile::FlatTip{})});
    list.back().spec.contact.solver = grains::Solver::brute_force;
    list.push_back({"rebound", dry(pile::FlatTip{})});
    list.back().spec.bed.grains.restitution = 0.3;
    list.push_back({"vibratory", dry(pile::ConicalTip{})});
    list.back().spec.pile->driving = pile::VibratoryDriving{0.3, 2e-3, 30};
    list.push_back({"saturated, once", wet(coupling::Scheme::once), 2});
    list.push_back({"saturated, predictor-corrector", wet(coupling::Scheme::predictor_corrector), 2});
    list.back().spec.contact.precision = grains::Precision::double_;
    list.push_back({"wave, conservative", wave(basin::SurfaceScheme::conservative)});
    list.push_back({"wave, explicit", wave(basin::SurfaceScheme::galerkin)});
    list.push_back({"wave, not iterated", wave(basin::SurfaceScheme::conservative)});
    list.back().spec.basin->time.iterated = false;
    list.push_back({"pile in water", pile_in_water()});
    return list;
  }();
  return all;
}

TEST(Restep, AMiddleStepThatIsTakenBackLeavesTheBits) {
  for (const Scene& scene : scenes()) {
    const Told whole = scene.run({});
    ASSERT_EQ(whole.result.outcome, Outcome::completed) << scene.name << ": " << whole.result.reason;
    EXPECT_EQ(metric(whole.result.metrics, "steps_rejected"), 0) << scene.name;
    if (scene.spec.fluid || (scene.spec.basin && scene.spec.basin->pile)) {
      EXPECT_GT(metric(whole.result.metrics, "meshes"), 1) << scene.name;
    }
    const auto middle = static_cast<std::int64_t>(metric(whole.result.metrics, "steps") / 2);
    expect_same(scene.run({0, middle}), whole, scene.name);
    expect_same(scene.run({16, middle + 5}), whole, scene.name + ", in shorter stretches");
  }
}

TEST(Restep, ARunThatIsStoppedHalfWayAndResumedHasTheBits) {
  for (const Scene& scene : scenes()) {
    const Told whole = scene.run({});
    const Told half = scene.run({scene.together, -1}, 0.5 * whole.result.time);
    ASSERT_EQ(half.result.outcome, Outcome::stopped) << scene.name;
    ASSERT_FALSE(half.sealed.empty()) << scene.name;
    EXPECT_LT(half.bytes.size(), whole.bytes.size()) << scene.name;
    expect_same(scene.run({}, kNever, half), whole, scene.name);
  }
}

/// A pile so fast, at times, that grains before it go farther than the smallest radius in a step, and slow in between.
Scene too_fast(bool saturated) {
  Scene scene{"too fast", saturated ? wet(coupling::Scheme::once) : small_drive(300, 0.8, pile::FlatTip{}), 1};
  scene.together = saturated ? 2 : 1;
  scene.spec.pile->driving = pile::SinusoidalDriving{saturated ? 26.0 : 30.0, 60};
  scene.spec.pile->depth.reset();
  scene.spec.pile->duration = saturated ? 0.03 : 0.15;
  return scene;
}

TEST(Restep, APileThatIsTooFastForItsStepIsFollowedWithSmallerOnes) {
  for (const bool saturated : {false, true}) {
    const Scene scene = too_fast(saturated);
    const Told whole = scene.run({20, -1});
    ASSERT_EQ(whole.result.outcome, Outcome::completed) << whole.result.reason;
    EXPECT_GE(metric(whole.result.metrics, "steps_rejected_path"), 1);
    EXPECT_LE(metric(whole.result.metrics, "step_smallest"), 2.5e-4);
    EXPECT_NEAR(whole.result.time, *scene.spec.pile->duration, 1e-9);
    std::printf("saturated %d: %g rejected, smallest step %g s\n", saturated,
                metric(whole.result.metrics, "steps_rejected"), metric(whole.result.metrics, "step_smallest"));
    // Goes back to where the uninterrupted run does, and counts the same.
    for (const double share : {0.3, 0.6, 0.9}) {
      const Told half = scene.run({20, -1}, share * whole.result.time);
      ASSERT_EQ(half.result.outcome, Outcome::stopped);
      expect_same(scene.run({20, -1}, kNever, half, 2), whole, "resumed at " + std::to_string(share));
    }
    expect_same(scene.run({20, -1}, kNever, {}, 3), whole, "three threads");
  }
}

TEST(Restep, AStepThatIsFarTooLongForAWaveIsHalved) {
  Scene scene{"wave", wave(basin::SurfaceScheme::conservative), 1};
  scene.spec.basin->time.iterated = false;
  scene.spec.basin->time.step = 0.2;
  scene.spec.basin->time.duration = 5;
  const Told whole = scene.run({});
  ASSERT_EQ(whole.result.outcome, Outcome::completed) << whole.result.reason;
  EXPECT_GE(metric(whole.result.metrics, "steps_rejected"), 1);
  EXPECT_LT(metric(whole.result.metrics, "step_smallest"), 0.2);
  std::printf("wave: %g rejected, smallest step %g s\n", metric(whole.result.metrics, "steps_rejected"),
              metric(whole.result.metrics, "step_smallest"));
}

// A mesh that is never made anew turns over, however small the step: the last accepted and the rejected state are kept.
TEST(Restep, WhatSmallerStepsDoNotCureEndsWithAPostMortem) {
  basin::BasinSpec spec = *pile_in_water().basin;
  spec.mesh.motion = basin::EllipticMotion{};
  spec.mesh.remesh.reset();
  std::vector<Array> accepted, rejected;
  std::string reason;
  BasinHooks hooks;
  hooks.checkpoint = [&](const std::vector<Array>& state) { accepted = state; };
  hooks.post_mortem = [&](const std::vector<Array>& state, const std::string& why) {
    rejected = state;
    reason = why;
  };
  const RunResult result = run_basin(spec, {}, {}, {}, {}, hooks);
  EXPECT_EQ(result.outcome, Outcome::diverged);
  EXPECT_EQ(reason, result.reason);
  EXPECT_EQ(metric(result.metrics, "step_smallest"), spec.time.step / 256);
  EXPECT_GE(metric(result.metrics, "steps_rejected_mesh"), 9);
  ASSERT_FALSE(accepted.empty());
  ASSERT_FALSE(rejected.empty());
  EXPECT_GE(array_of<std::int64_t>(rejected, "basin/steps")[0], array_of<std::int64_t>(accepted, "basin/steps")[0]);
  // With the rule that the scene has otherwise, the same mesh is made anew in time.
  spec.mesh.remesh = basin::RemeshSpec{};
  EXPECT_EQ(run_basin(spec, {}, {}, {}, {}, {}).outcome, Outcome::completed);
}

// Its rule asks for no new mesh by itself, as no quality is too bad for it: only where nothing else helps.
TEST(Restep, ANewMeshIsMadeWhereSmallerStepsDoNotHelp) {
  basin::BasinSpec spec = *pile_in_water().basin;
  spec.mesh.motion = basin::EllipticMotion{};
  spec.mesh.remesh = basin::RemeshSpec{.angle = 0, .share = 1, .shape = 0};
  const RunResult result = run_basin(spec, {}, {}, {}, {}, {});
  EXPECT_EQ(result.outcome, Outcome::completed) << result.reason;
  EXPECT_GE(metric(result.metrics, "steps_rejected_mesh"), 9);
  EXPECT_GT(metric(result.metrics, "meshes"), 1);
}

}  // namespace
}  // namespace seapile::simulation
