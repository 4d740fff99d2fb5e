// A step that is taken back leaves no trace, and a run that is stopped goes on as if it had not been: drives, dry and
// saturated, with every method, and beds on their way to rest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "solver/simulation/run.h"
#include "tests/support/told.h"

namespace seapile::simulation {
namespace {

using support::bytes_of;
using support::expect_same;
using support::kNever;
using support::metric;
using support::Scene;
using support::settled;
using support::small_bed;
using support::small_drive;
using support::Telling;
using support::Told;

Scene of_drive(std::string name, const scene::SceneSpec& spec) {
  const auto tell = [spec](const Telling& how, Told&& told) {
    scene::RecordSpec record = support::small_record();
    record.travel = 2e-3;
    record.interval = 0.05;
    record.times = {0.1, 0.3};
    told.result = simulation::run(spec, record, settled(spec.bed), {how.threads, Simd::best, how.trying},
                                  how.before.sealed, how.before.so_far, support::keeping<RunHooks>(told, how.until));
    return std::move(told);
  };
  return {std::move(name), spec.contact.step, tell, spec.fluid ? 2 : 1, spec.fluid.has_value()};
}

/// A bed cannot be stopped.
Scene of_bed(std::string name, const scene::BedSpec& spec) {
  const auto tell = [spec](const Telling& how, Told&& told) {
    const Bed bed = prepare_bed(spec, {}, {how.threads, Simd::best, how.trying}, {});
    for (const Record& record : bed.records) told.bytes.push_back(support::row_of("record", record));
    told.bytes.push_back(bytes_of({&bed.grains}));
    told.bytes.push_back(bytes_of(std::span<const double>(bed.porosity_profile)));
    told.result.metrics = bed.metrics;
    told.result.time = bed.records.back().time;
    return std::move(told);
  };
  return {std::move(name), spec.preparation.contact.step, tell};
}

scene::SceneSpec dry(const pile::Tip& tip) {
  scene::SceneSpec scene = small_drive(150, 0.6, tip);
  scene.pile->depth = 0.08;
  return scene;
}

scene::SceneSpec wet(coupling::Scheme scheme) {
  scene::SceneSpec scene = support::small_saturated_drive();
  scene.fluid->coupling.scheme = scheme;
  return scene;
}

const std::vector<Scene>& drives() {
  static const std::vector<Scene> all = [] {
    std::vector<Scene> list;
    list.push_back(of_drive("dry, flat", dry(pile::FlatTip{})));
    list.push_back(of_drive("dry, conical", dry(pile::ConicalTip{})));
    scene::SceneSpec spec = dry(pile::FlatTip{});
    spec.contact.precision = grains::Precision::double_;
    list.push_back(of_drive("double precision", spec));
    spec = dry(pile::ConicalTip{});
    spec.contact.method = grains::NonSmoothMethod{10, 1e-6, 1e-3};
    spec.contact.step = 2e-4;
    list.push_back(of_drive("non-smooth", spec));
    spec = dry(pile::FlatTip{});
    spec.contact.solver = grains::Solver::brute_force;
    list.push_back(of_drive("brute force", spec));
    spec = dry(pile::FlatTip{});
    spec.contact.substeps = 15;
    list.push_back(of_drive("stiffer than its bed", spec));
    spec = dry(pile::FlatTip{});
    spec.bed.grains.restitution = 0.3;
    list.push_back(of_drive("rebound", spec));
    spec = dry(pile::ConicalTip{});
    spec.pile->driving = pile::VibratoryDriving{0.3, 2e-3, 30};
    list.push_back(of_drive("vibratory", spec));
    list.push_back(of_drive("saturated, once", wet(coupling::Scheme::once)));
    spec = wet(coupling::Scheme::predictor_corrector);
    spec.contact.precision = grains::Precision::double_;
    list.push_back(of_drive("saturated, predictor-corrector", spec));
    return list;
  }();
  return all;
}

TEST(RestepSoil, AMiddleStepThatIsTakenBackLeavesTheBits) {
  for (const Scene& scene : drives()) support::expect_no_trace_of_a_step_taken_back(scene);
}

TEST(RestepSoil, ARunThatIsStoppedHalfWayAndResumedHasTheBits) {
  for (const Scene& scene : drives()) support::expect_resumed_is_whole(scene);
}

TEST(RestepSoil, ABedOfWhichAMiddleStepIsTakenBackHasTheBits) {
  scene::BedSpec spec = small_bed(80, 0.5);
  std::vector<Scene> beds{of_bed("bed", spec)};
  spec.preparation.solid_fraction = 0.8;
  spec.preparation.tolerance = 0.02;
  beds.push_back(of_bed("bed of a solid fraction", spec));
  for (const Scene& bed : beds) {
    support::expect_no_trace_of_a_step_taken_back(bed);
    // All in one stretch: records are taken back with the steps.
    expect_same(bed.run({{1 << 20, 150}}), bed.run(), bed.name + ", from the start");
  }
}

/// A pile so fast, at times, that grains before it go farther than the smallest radius in a step, and slow in between.
Scene too_fast(bool saturated) {
  scene::SceneSpec spec = saturated ? wet(coupling::Scheme::once) : small_drive(300, 0.8, pile::FlatTip{});
  spec.pile->driving = pile::SinusoidalDriving{saturated ? 26.0 : 30.0, 60};
  spec.pile->depth.reset();
  spec.pile->duration = saturated ? 0.03 : 0.15;
  return of_drive("too fast", spec);
}

TEST(RestepSoil, APileThatIsTooFastForItsStepIsFollowedWithSmallerOnes) {
  for (const bool saturated : {false, true}) {
    const Scene scene = too_fast(saturated);
    const Trying trying{20, -1};
    const Told whole = scene.run({trying});
    ASSERT_EQ(whole.result.outcome, Outcome::completed) << whole.result.reason;
    EXPECT_GE(metric(whole.result.metrics, "steps_rejected_path"), 1);
    EXPECT_LE(metric(whole.result.metrics, "step_smallest"), 2.5e-4);
    EXPECT_NEAR(whole.result.time, saturated ? 0.03 : 0.15, 1e-9);
    std::printf("saturated %d: %g rejected, smallest step %g s\n", saturated,
                metric(whole.result.metrics, "steps_rejected"), metric(whole.result.metrics, "step_smallest"));
    // Goes back to where the uninterrupted run does, and counts the same.
    for (const double share : {0.3, 0.6, 0.9}) {
      const Told half = scene.run({trying, share * whole.result.time});
      ASSERT_EQ(half.result.outcome, Outcome::stopped);
      expect_same(scene.run({trying, kNever, half, 2}), whole, "resumed at " + std::to_string(share));
    }
    expect_same(scene.run({trying, kNever, {}, 3}), whole, "three threads");
  }
}

// Grains of 3 mm go farther in a step as soon as they have fallen for 5 mm.
TEST(RestepSoil, ABedWhoseStepIsTooLongSettlesWithSmallerOnes) {
  scene::BedSpec spec = small_bed(150, 0.5);
  spec.domain.height = 1;
  spec.grains.radius.min = 3e-3;
  spec.preparation.contact.step = 0.01;
  const Scene scene = of_bed("bed", spec);
  const Told whole = scene.run();
  EXPECT_GE(metric(whole.result.metrics, "steps_rejected_path"), 1);
  EXPECT_LT(metric(whole.result.metrics, "step_smallest"), 0.01);
  EXPECT_LT(metric(whole.result.metrics, "rms_speed"), 1e-4);
  std::printf("bed: %g rejected, smallest step %g s\n", metric(whole.result.metrics, "steps_rejected"),
              metric(whole.result.metrics, "step_smallest"));
  expect_same(scene.run({{}, kNever, {}, 2}), whole, "two threads");
}

// Its rule asks for no new mesh by itself, as no quality is too bad for it: only where nothing else helps.
TEST(RestepSoil, ANewMeshIsMadeWhereSmallerStepsDoNotHelp) {
  scene::SceneSpec spec = wet(coupling::Scheme::once);
  spec.pile->depth = 0.25;
  spec.fluid->mesh.motion = basin::EllipticMotion{};
  spec.fluid->mesh.remesh = basin::RemeshSpec{.angle = 0, .share = 1, .shape = 0};
  const Scene scene = of_drive("deep", spec);
  const Told whole = scene.run();
  ASSERT_EQ(whole.result.outcome, Outcome::completed) << whole.result.reason;
  EXPECT_GE(metric(whole.result.metrics, "steps_rejected_mesh"), 9) << "the step, and its halvings";
  EXPECT_GT(metric(whole.result.metrics, "meshes"), 1);
  std::printf("deep: %g rejected, %g meshes\n", metric(whole.result.metrics, "steps_rejected"),
              metric(whole.result.metrics, "meshes"));
  spec.fluid->mesh.remesh.reset();
  EXPECT_EQ(of_drive("one mesh", spec).run().result.outcome, Outcome::diverged);
}

}  // namespace
}  // namespace seapile::simulation
