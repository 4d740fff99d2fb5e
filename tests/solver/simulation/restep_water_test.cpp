// A step that is taken back leaves no trace, and a run that is stopped goes on as if it had not been: basins, and jets
// in time.
#include <gtest/gtest.h>

#include <algorithm>

#include "solver/simulation/basin.h"
#include "solver/simulation/flow_state.h"
#include "solver/simulation/jet.h"
#include "tests/support/told.h"

namespace seapile::simulation {
namespace {

using support::expect_same;
using support::metric;
using support::Scene;
using support::Telling;
using support::Told;

Scene of_basin(std::string name, const basin::BasinSpec& spec) {
  const auto tell = [spec](const Telling& how, Told&& told) {
    scene::RecordSpec record;
    record.interval = 0.05;
    record.times = {0.1, 0.3};
    told.result = run_basin(spec, record, {how.threads, Simd::best, how.trying}, how.before.sealed,
                            how.before.so_far.flow_records, support::keeping<BasinHooks>(told, how.until));
    return std::move(told);
  };
  return {std::move(name), spec.time.step, tell, 1, spec.pile.has_value()};
}

Scene of_jet(std::string name, const fluid::JetSpec& spec) {
  const auto tell = [spec](const Telling& how, Told&& told) {
    told.result = run_jet(spec, {how.threads, Simd::best, how.trying}, how.before.sealed,
                          support::keeping<JetHooks>(told, how.until));
    return std::move(told);
  };
  return {std::move(name), std::get<fluid::TransientMethod>(spec.method).step, tell};
}

basin::BasinSpec wave(basin::SurfaceScheme scheme) {
  basin::BasinSpec basin;
  basin.surface->initial = basin::CosineSurface{0.01, 1};
  basin.surface->scheme = scheme;
  basin.mesh.pattern = basin::StructuredMesh{16, 4};
  basin.time.step = 5e-3;
  basin.time.duration = 0.5;
  return basin;
}

basin::BasinSpec pile_in_water() {
  basin::BasinSpec basin;
  basin.width = 5;
  basin.depth = 2.4;
  basin.pile = basin::BasinPileSpec{};
  basin.mesh.pattern = basin::UnstructuredMesh{0.2, 0.15, 0.15};
  basin.mesh.motion = basin::ZonesMotion{0.5};
  basin.mesh.remesh = basin::RemeshSpec{};
  basin.mesh.remesh->share = 0.02;
  basin.time.step = 0.025;
  basin.time.duration = 5;
  return basin;
}

/// In 40 steps.
fluid::JetSpec jet(std::int64_t order) {
  fluid::JetSpec jet;
  jet.lip_size = 0.05;
  jet.growth = 0.3;
  jet.largest_size = 0.3;
  jet.downstream = 6;
  jet.capillary = 5;
  jet.method = fluid::TransientMethod{0.02, 0.8, order};
  return jet;
}

const std::vector<Scene>& scenes() {
  static const std::vector<Scene> all = [] {
    std::vector<Scene> list;
    list.push_back(of_basin("wave, conservative", wave(basin::SurfaceScheme::conservative)));
    list.push_back(of_basin("wave, explicit", wave(basin::SurfaceScheme::galerkin)));
    basin::BasinSpec spec = wave(basin::SurfaceScheme::conservative);
    spec.time.iterated = false;
    list.push_back(of_basin("wave, not iterated", spec));
    list.push_back(of_basin("pile in water", pile_in_water()));
    list.push_back(of_jet("jet of first order", jet(1)));
    list.push_back(of_jet("jet of second order", jet(2)));
    return list;
  }();
  return all;
}

TEST(RestepWater, AMiddleStepThatIsTakenBackLeavesTheBits) {
  for (const Scene& scene : scenes()) support::expect_no_trace_of_a_step_taken_back(scene);
}

TEST(RestepWater, ARunThatIsStoppedHalfWayAndResumedHasTheBits) {
  for (const Scene& scene : scenes()) support::expect_resumed_is_whole(scene);
}

// A jet hands nothing out on its way of which a trace would be seen: what it has done is counted.
TEST(RestepWater, AStretchOfAJetThatIsTakenBackIsDoneAgain) {
  const auto surfaces = [](const Told& told) {
    const auto part = std::ranges::find(told.result.profile, "free surface", &ProfileEntry::part);
    return part == told.result.profile.end() ? 0 : static_cast<int>(part->calls);
  };
  const Scene scene = of_jet("jet", jet(2));
  EXPECT_EQ(surfaces(scene.run()), 40);
  EXPECT_EQ(surfaces(scene.run({{16, 25}})), 40 + 25 - 16);
}

TEST(RestepWater, AStepThatIsFarTooLongForAWaveIsHalved) {
  basin::BasinSpec spec = wave(basin::SurfaceScheme::conservative);
  spec.time.iterated = false;
  spec.time.step = 0.2;
  spec.time.duration = 5;
  const Told whole = of_basin("wave", spec).run();
  ASSERT_EQ(whole.result.outcome, Outcome::completed) << whole.result.reason;
  EXPECT_GE(metric(whole.result.metrics, "steps_rejected"), 1);
  EXPECT_LT(metric(whole.result.metrics, "step_smallest"), 0.2);
  std::printf("wave: %g rejected, smallest step %g s\n", metric(whole.result.metrics, "steps_rejected"),
              metric(whole.result.metrics, "step_smallest"));
}

// Tension acts explicitly, and holds down to a step of 0.1 H/U or so on this mesh.
TEST(RestepWater, AStepThatIsTooLongForAFilmIsHalved) {
  fluid::JetSpec spec = jet(2);
  spec.geometry = fluid::Geometry::planar;
  spec.reynolds = 12;
  spec.capillary = 0.5;
  const auto in_steps_of = [&](double step) {
    spec.method = fluid::TransientMethod{step, 10, 2};
    return of_jet("film", spec);
  };
  const Scene scene = in_steps_of(0.4);
  const Told whole = scene.run(), fine = in_steps_of(0.1).run();
  ASSERT_EQ(whole.result.outcome, Outcome::completed) << whole.result.reason;
  EXPECT_GE(metric(whole.result.metrics, "steps_rejected"), 1);
  EXPECT_EQ(metric(fine.result.metrics, "steps_rejected"), 0);
  EXPECT_LT(metric(whole.result.metrics, "step_smallest"), 0.4);
  EXPECT_NEAR(metric(whole.result.metrics, "swell_ratio"), metric(fine.result.metrics, "swell_ratio"), 2e-3);
  std::printf("film: %g rejected, smallest step %g H/U\n", metric(whole.result.metrics, "steps_rejected"),
              metric(whole.result.metrics, "step_smallest"));
  // Goes back to where the uninterrupted run does, and counts the same.
  const Trying short_stretches{5, -1};
  const Told reference = scene.run({short_stretches});
  for (const double share : {0.3, 0.6}) {
    const Told half = scene.run({short_stretches, share * reference.result.time});
    ASSERT_EQ(half.result.outcome, Outcome::stopped);
    expect_same(scene.run({short_stretches, support::kNever, half}), reference, "resumed at " + std::to_string(share));
  }
}

// Tampered with where it was stopped: no step of it can be accepted, however small.
TEST(RestepWater, AStateThatIsNoneEndsWithItsCause) {
  const auto ended_with = [](Scene scene, const char* array, std::size_t at, double factor, const char* cause) {
    Told half = scene.run({{1, -1}, 10 * scene.step});
    ASSERT_EQ(half.result.outcome, Outcome::stopped);
    for (Array& one : half.sealed)
      if (one.info.name == array) std::get<std::vector<double>>(one.values)[at] *= factor;
    const Told after = scene.run({.before = half});
    EXPECT_EQ(after.result.outcome, Outcome::diverged) << cause;
    EXPECT_EQ(metric(after.result.metrics, std::string("steps_rejected_") + cause), 9) << "the step, and its halvings";
    EXPECT_EQ(metric(after.result.metrics, "steps_rejected"), 9) << cause;
  };
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Scene basin = of_basin("wave", wave(basin::SurfaceScheme::conservative));
  ended_with(basin, "basin/volume_at_start", 0, 1 + 1e-5, "volume");
  ended_with(basin, "past/0/unknown", 32, none, "not_finite");
  for (const std::int64_t order : {1, 2})
    ended_with(of_jet("jet", jet(order)), "past/0/unknown", 32, none, "not_finite");
}

/// What is kept of a run that ends before its end.
struct Ended {
  std::vector<Array> accepted, rejected;
  std::string reason;
};
template <class Hooks>
Hooks keeping(Ended& ended) {
  Hooks hooks;
  hooks.checkpoint = [&](const std::vector<Array>& state) { ended.accepted = state; };
  hooks.post_mortem = [&](const std::vector<Array>& state, const std::string& why) {
    EXPECT_FALSE(ended.accepted.empty()) << "the last accepted state is sealed first";
    ended.rejected = state;
    ended.reason = why;
  };
  return hooks;
}

// A mesh that is never made anew turns over, however small the step: the last accepted and the rejected state are kept.
TEST(RestepWater, WhatSmallerStepsDoNotCureEndsWithAPostMortem) {
  basin::BasinSpec spec = pile_in_water();
  spec.mesh.motion = basin::EllipticMotion{};
  spec.mesh.remesh.reset();
  Ended ended;
  const RunResult result = run_basin(spec, {}, {}, {}, {}, keeping<BasinHooks>(ended));
  EXPECT_EQ(result.outcome, Outcome::diverged);
  EXPECT_EQ(ended.reason, result.reason);
  EXPECT_EQ(metric(result.metrics, "step_smallest"), spec.time.step / 256);
  EXPECT_GE(metric(result.metrics, "steps_rejected_mesh"), 9);
  ASSERT_FALSE(ended.rejected.empty());
  EXPECT_GE(array_of<std::int64_t>(ended.rejected, "basin/steps")[0],
            array_of<std::int64_t>(ended.accepted, "basin/steps")[0]);
  // With the rule that the scene has otherwise, the same mesh is made anew in time.
  spec.mesh.remesh = basin::RemeshSpec{};
  EXPECT_EQ(run_basin(spec, {}, {}, {}, {}, {}).outcome, Outcome::completed);
}

// Its rule asks for no new mesh by itself, as no quality is too bad for it: only where nothing else helps.
TEST(RestepWater, ANewMeshIsMadeWhereSmallerStepsDoNotHelp) {
  basin::BasinSpec spec = pile_in_water();
  spec.mesh.motion = basin::EllipticMotion{};
  spec.mesh.remesh = basin::RemeshSpec{.angle = 0, .share = 1, .shape = 0};
  const RunResult result = run_basin(spec, {}, {}, {}, {}, {});
  EXPECT_EQ(result.outcome, Outcome::completed) << result.reason;
  EXPECT_GE(metric(result.metrics, "steps_rejected_mesh"), 9);
  EXPECT_GT(metric(result.metrics, "meshes"), 1);
}

}  // namespace
}  // namespace seapile::simulation
