// Laws of a jet from a die, from its spec to its result. Meshes are coarse: what fine ones give is in
// docs/die_swell.md.
#include "solver/simulation/jet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "solver/base/instruction_set.h"

namespace seapile::simulation {
namespace {

using fluid::Geometry;
using fluid::JetSpec;
using fluid::TransientMethod;

JetSpec coarse(Geometry geometry, double reynolds) {
  JetSpec jet;
  jet.geometry = geometry;
  jet.reynolds = reynolds;
  jet.lip_size = 0.01;
  jet.growth = 0.2;
  jet.largest_size = 0.3;
  return jet;
}

double metric(const RunResult& result, const std::string& name) {
  const auto found = std::ranges::find(result.metrics, name, &Metric::name);
  EXPECT_NE(found, result.metrics.end()) << name;
  return found == result.metrics.end() ? 0 : found->value;
}

RunResult run(const JetSpec& jet, const JetHooks& hooks = {}, const std::vector<Array>& from = {},
              Simd simd = Simd::best) {
  return run_jet(jet, {1, simd}, from, hooks);
}

/// The swell ratios that fine meshes and other methods converge to, and what a mesh of 600 vertices is off.
struct Converged {
  Geometry geometry;
  double reynolds, swell_ratio, tolerance;
};
class SwellRatio : public testing::TestWithParam<Converged> {};

TEST_P(SwellRatio, IsThatOfConvergedMeshes) {
  const auto& [geometry, reynolds, swell_ratio, tolerance] = GetParam();
  const RunResult result = run(coarse(geometry, reynolds));
  EXPECT_EQ(result.outcome, Outcome::completed) << result.reason;
  EXPECT_NEAR(metric(result, "swell_ratio"), swell_ratio, tolerance);
  EXPECT_LT(std::abs(metric(result, "mass_defect")), 1e-5);
}

// At a lip of 0.01 H the singular stress there costs 0.005 in creeping flow and less than 0.001 from Re = 24 on.
INSTANTIATE_TEST_SUITE_P(Jets, SwellRatio,
                         testing::Values(Converged{Geometry::axisymmetric, 24, 0.9537, 1e-3},
                                         Converged{Geometry::axisymmetric, 29, 0.9400, 1e-3},
                                         Converged{Geometry::axisymmetric, 36, 0.9267, 1e-3},
                                         Converged{Geometry::planar, 0, 1.1864, 6e-3}));

TEST(Jet, SurfaceTensionHoldsItTogether) {
  JetSpec jet = coarse(Geometry::planar, 0);
  const double free = metric(run(jet), "swell_ratio");
  jet.capillary = 0.5;
  const double held = metric(run(jet), "swell_ratio");
  EXPECT_GT(held, 1.05);
  EXPECT_LT(held, free - 0.05);
}

TEST(Jet, OneThatDevelopsInTimeEndsInTheSteadyState) {
  JetSpec jet = coarse(Geometry::axisymmetric, 24);
  jet.downstream = 8;
  const double steady = metric(run(jet), "swell_ratio");
  for (const std::int64_t order : {1, 2}) {
    jet.method = TransientMethod{0.05, 40, order};
    // What is left after 40 H/U: the slow first of five times the jet's length; the equations are solved to 1e-8.
    EXPECT_NEAR(metric(run(jet), "swell_ratio"), steady, 2e-5) << "order " << order;
  }
}

TEST(Jet, TensionInTimeIsThatOfTheSteadyFilm) {
  // The curvature's projection in time against the exact derivative of the film's length.
  JetSpec jet = coarse(Geometry::planar, 12);
  jet.lip_size = 0.05;
  jet.downstream = 6;
  jet.capillary = 5;
  const double steady = metric(run(jet), "swell_ratio");
  jet.method = TransientMethod{0.02, 40};
  EXPECT_NEAR(metric(run(jet), "swell_ratio"), steady, 1e-3);
}

TEST(Jet, ContinuedFromACheckpointItHasTheSameBits) {
  JetSpec jet = coarse(Geometry::axisymmetric, 24);
  jet.method = TransientMethod{0.05, 5};
  const RunResult whole = run(jet);

  std::vector<Array> kept;
  JetHooks hooks;
  int looks = 0;
  hooks.checkpoint = [&](const std::vector<Array>& state) { kept = state; };
  hooks.stop = [&] { return ++looks == 2; };
  const RunResult first = run(jet, hooks);
  ASSERT_EQ(first.outcome, Outcome::stopped);
  ASSERT_FALSE(kept.empty());
  const RunResult second = run(jet, {}, kept);
  EXPECT_EQ(second.state_hash, whole.state_hash);
  EXPECT_EQ(metric(second, "iterations_per_step"), metric(whole, "iterations_per_step"));
}

TEST(Jet, ARerunAndEveryInstructionSetGiveTheSameBits) {
  JetSpec jet = coarse(Geometry::axisymmetric, 24);
  jet.method = TransientMethod{0.05, 2};
  const std::uint64_t expected = run(jet, {}, {}, Simd::generic).state_hash;
  EXPECT_EQ(run(jet, {}, {}, Simd::generic).state_hash, expected);
  for (const auto& [simd, set] :
       {std::pair{Simd::avx2, base::InstructionSet::avx2}, {Simd::avx512, base::InstructionSet::avx512}}) {
    if (!available(set)) continue;
    EXPECT_EQ(run(jet, {}, {}, simd).state_hash, expected);
  }
}

TEST(Jet, AStepTooLongForTheFilmEndsWithAReasonAndALastGoodState) {
  // Explicit tension: even a 256th of the step is far beyond the capillary limit sqrt(rho dx^3/(2 pi gamma)).
  JetSpec jet = coarse(Geometry::planar, 24);
  jet.capillary = 0.02;
  jet.method = TransientMethod{1, 40};
  std::vector<Array> kept;
  JetHooks hooks;
  hooks.checkpoint = [&](const std::vector<Array>& state) { kept = state; };
  std::vector<Array> rejected;
  hooks.post_mortem = [&](const std::vector<Array>& state, const std::string&) {
    EXPECT_FALSE(kept.empty()) << "the last accepted state is sealed first";
    rejected = state;
  };
  const RunResult result = run(jet, hooks);
  EXPECT_EQ(result.outcome, Outcome::diverged);
  EXPECT_THAT(result.reason, testing::HasSubstr("at t = "));
  EXPECT_EQ(metric(result, "step_smallest"), 1.0 / 256);
  EXPECT_GE(metric(result, "steps_rejected"), 9);
  EXPECT_FALSE(rejected.empty());
}

TEST(Jet, HasNoGrainsAndSaysWhy) {
  scene::SceneSpec scene;
  scene.jet.emplace();
  for (const Part& part : parts(scene)) {
    const bool of_the_fluid = part.name == "mesh" || part.name == "mesh_motion" || part.name == "fluid" ||
                              part.name == "convection" || part.name == "free_surface";
    EXPECT_EQ(part.built, of_the_fluid) << part.name;
    EXPECT_FALSE(part.reason.empty());
  }
  std::vector<std::string> modules;
  for (const NumericsVersion& version : numerics_versions(scene)) modules.push_back(version.module);
  EXPECT_THAT(modules, testing::UnorderedElementsAre("mesh", "fluid", "free_surface"));
}

}  // namespace
}  // namespace seapile::simulation
