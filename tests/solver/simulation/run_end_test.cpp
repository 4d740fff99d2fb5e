// The ways in which a run ends: at its depth or its time, stopped, or diverged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "solver/simulation/build.h"
#include "solver/simulation/drive.h"
#include "solver/simulation/run.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

using support::drive;
using support::Drive;
using support::metric;
using support::settled;
using support::small_drive;
using support::small_record;
using support::values;
using testing::HasSubstr;

constexpr double kStep = 5e-4;

scene::SceneSpec drive_of_300(const pile::Tip& tip) { return small_drive(300, 0.8, tip); }

TEST(RunEnd, ASineGoesDownAndUpAndEndsByTime) {
  scene::SceneSpec scene = drive_of_300(pile::ConicalTip{});
  scene.pile->driving = pile::SinusoidalDriving{0.4, 2};
  scene.pile->depth.reset();
  scene.pile->duration = 0.5;
  scene::RecordSpec record = small_record();
  record.frames = {0, 0.03};
  const Drive run = drive(scene, record, settled(scene.bed));
  EXPECT_EQ(run.result.outcome, Outcome::completed);
  EXPECT_NEAR(run.result.time, 0.5, 0.1 * kStep);
  const double stroke = 0.4 / (std::numbers::pi * 2);
  EXPECT_NEAR(run.records.back().travel, 2 * stroke, 1e-4);
  EXPECT_NEAR(run.records.back().depth, run.records.front().depth, 2e-3);
  double deepest = 0;
  for (const Record& r : run.records) deepest = std::max(deepest, r.depth);
  EXPECT_NEAR(deepest - run.records.front().depth, stroke, 1e-3);
  // A depth that is passed twice is shown once, on the way down.
  ASSERT_EQ(run.frames.size(), 2u);
  EXPECT_LT(run.frames[1].time, 0.25);
}

TEST(RunEnd, AVibrationEndsAtItsDepthFirstReached) {
  scene::SceneSpec scene = drive_of_300(pile::FlatTip{});
  scene.pile->driving = pile::VibratoryDriving{0.3, 2e-3, 30};
  const Drive run = drive(scene, small_record(), settled(scene.bed));
  EXPECT_EQ(run.result.outcome, Outcome::completed);
  // Within a step at the largest speed, 0.3 + 2 pi 30 2e-3 m/s.
  const double fastest = 0.3 + 2 * std::numbers::pi * 30 * 2e-3;
  EXPECT_GE(run.result.depth, 0.12 - 1e-9);
  EXPECT_LT(run.result.depth, 0.12 + fastest * kStep);
  for (std::size_t k = 0; k + 1 < run.records.size(); ++k) EXPECT_LT(run.records[k].depth, 0.12);
  EXPECT_GT(run.records.back().travel, run.records.back().depth + 0.01) << "it goes up, too";
  ASSERT_EQ(run.frames.size(), 3u);
  for (const Frame& frame : run.frames) EXPECT_NEAR(frame.depth, frame.asked, fastest * kStep);
}

TEST(RunEnd, TheEarlierOfDepthAndDurationEndsIt) {
  scene::SceneSpec scene = drive_of_300(pile::FlatTip{});
  scene.pile->duration = 0.1;
  const Drive by_time = drive(scene, small_record(), settled(scene.bed));
  EXPECT_NEAR(by_time.result.time, 0.1, 1e-9);
  EXPECT_LT(by_time.result.depth, 0.12);
  scene.pile->duration = 10;
  EXPECT_EQ(drive(scene, small_record(), settled(scene.bed)).result.state_hash,
            drive(drive_of_300(pile::FlatTip{}), small_record(), settled(scene.bed)).result.state_hash);
}

// Pulled up from the start: nothing resists, and the run ends by its time.
TEST(RunEnd, APileThatIsPulledUpLeavesTheBedAlone) {
  scene::SceneSpec scene = drive_of_300(pile::ConicalTip{});
  scene.pile->driving = pile::ConstantDriving{-0.2};
  scene.pile->depth.reset();
  scene.pile->duration = 0.1;
  scene::RecordSpec record = small_record();
  record.frames = {};
  const Drive run = drive(scene, record, settled(scene.bed));
  EXPECT_EQ(run.result.outcome, Outcome::completed);
  for (const Record& r : run.records) EXPECT_EQ(r.tip_force_y, 0);
  EXPECT_NEAR(run.records.back().travel, 0.02, 1e-6);
}

// The tip may start deeper than where it is asked to go, under a surface that is higher on both sides.
TEST(RunEnd, AnEndAboveTheStartIsReachedAtOnce) {
  Bed bed;
  bed.grains = {{{"grains/id", "-", "", 1, Entity::grain}, std::vector<std::int64_t>{0, 1, 2}},
                {{"grains/position", "m", "", 2, Entity::grain}, std::vector<double>{-0.2, 0.2, 0, 0.015, 0.2, 0.2}},
                {{"grains/radius", "m", "", 1, Entity::grain}, std::vector<double>(3, 0.015)}};
  scene::SceneSpec scene = small_drive(3, 0.8, pile::FlatTip{});
  const pile::Driving drives[] = {pile::ConstantDriving{0.1}, pile::SinusoidalDriving{0.4, 2},
                                  pile::VibratoryDriving{0.1, 1e-3, 20}};
  for (const pile::Driving& driving : drives) {
    scene.pile->driving = driving;
    scene.pile->depth = 1e-3;
    Drive run;
    RunHooks hooks = keeping(run);
    hooks.stop = [&] { return run.records.size() > 100; };
    run.result = simulation::run(scene, {}, bed, {}, {}, {}, hooks);
    EXPECT_EQ(run.result.outcome, Outcome::completed) << "drive " << driving.index();
    EXPECT_LE(run.result.time, kStep) << "drive " << driving.index();
  }
}

/// A flat pile that is on its way, and the hooks that keep its states.
struct Halted {
  scene::SceneSpec scene;
  Drive run;
  std::vector<Array> state;
};
Halted halted_after(int records, grains::Precision precision = grains::Precision::single_) {
  Halted halted{drive_of_300(pile::FlatTip{}), {}, {}};
  halted.scene.contact.precision = precision;
  RunHooks hooks = keeping(halted.run);
  hooks.stop = [&] { return static_cast<int>(halted.run.records.size()) >= records; };
  hooks.checkpoint = [&](const std::vector<Array>& state) { halted.state = state; };
  const Execution asked_often{1, Simd::best, {1}};
  halted.run.result = run(halted.scene, small_record(), settled(halted.scene.bed), asked_often, {}, {}, hooks);
  return halted;
}

TEST(RunEnd, StopsOnRequestWithACheckpoint) {
  const Halted halted = halted_after(100);
  EXPECT_EQ(halted.run.result.outcome, Outcome::stopped);
  EXPECT_THAT(halted.run.result.reason, HasSubstr("stopped on request"));
  EXPECT_EQ(halted.run.records.size(), 100u);
  EXPECT_FALSE(halted.state.empty());
  EXPECT_EQ(values<std::int64_t>(halted.state, "clock/step")[0], std::lround(halted.run.result.time / kStep));
}

TEST(RunEnd, StopsOnRequestWhileItsBedSettlesBeforeTheStart) {
  scene::SceneSpec scene = drive_of_300(pile::FlatTip{});
  scene.contact.substeps = 20;
  RunHooks hooks;
  int asked = 0;
  hooks.stop = [&] { return ++asked == 3; };
  hooks.checkpoint = [](const std::vector<Array>&) { ADD_FAILURE() << "there is nothing to go on from"; };
  const RunResult result = run(scene, small_record(), settled(scene.bed), {}, {}, {}, hooks);
  EXPECT_EQ(result.outcome, Outcome::stopped);
  EXPECT_THAT(result.reason, HasSubstr("before its start"));
  EXPECT_EQ(asked, 3);
}

/// What comes of a state that was tampered with.
struct Resumed {
  Drive run;
  std::vector<Array> sealed, rejected;
  std::string reason;  ///< of the post-mortem
};
Resumed resumed(const Halted& halted, const std::vector<Array>& from) {
  Resumed resumed;
  RunHooks hooks = keeping(resumed.run);
  hooks.checkpoint = [&](const std::vector<Array>& state) {
    EXPECT_TRUE(resumed.rejected.empty()) << "the last accepted state is sealed first";
    resumed.sealed = state;
  };
  hooks.post_mortem = [&](const std::vector<Array>& state, const std::string& reason) {
    resumed.rejected = state;
    resumed.reason = reason;
  };
  resumed.run.result = run(halted.scene, small_record(), settled(halted.scene.bed), {}, from, {}, hooks);
  return resumed;
}
Resumed resumed_with(const Halted& halted, const char* name, std::size_t index, double value) {
  std::vector<Array> state = halted.state;
  for (Array& array : state) {
    if (array.info.name != name) continue;
    std::visit([&](auto& v) { v[index] = static_cast<std::decay_t<decltype(v[index])>>(value); }, array.values);
  }
  return resumed(halted, state);
}
/// A grain 30 m above the bed that falls at `speed` [m/s].
Resumed resumed_falling(Halted halted, double speed) {
  for (Array& array : halted.state)
    if (array.info.name == "grains/position") std::get<std::vector<double>>(array.values)[301] = 30;
  return resumed_with(halted, "grains/velocity", 301, -speed);
}

TEST(RunEnd, APlaceThatIsNoNumberEndsAsDiverged) {
  const Halted halted = halted_after(100);
  const Resumed after = resumed_with(halted, "grains/position", 301, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(after.run.result.outcome, Outcome::diverged);
  EXPECT_THAT(after.run.result.reason, HasSubstr("not a number"));
  EXPECT_TRUE(after.run.records.empty()) << "nothing is recorded of a state that is none";
  EXPECT_EQ(metric(after.run.result.metrics, "steps_rejected_not_finite"), 9) << "the step, and eight halvings of it";
}

// It becomes too fast for the step, 0.0112 m per 0.5 ms, after 0.1 s: from there on it is followed with half the step.
TEST(RunEnd, AGrainThatIsTooFastForTheStepIsFollowedWithSmallerOnes) {
  const Halted halted = halted_after(100);
  const Resumed after = resumed_falling(halted, 21.5);
  EXPECT_EQ(after.run.result.outcome, Outcome::completed) << after.run.result.reason;
  EXPECT_TRUE(after.rejected.empty());
  EXPECT_GE(metric(after.run.result.metrics, "steps_rejected_path"), 1);
  EXPECT_EQ(metric(after.run.result.metrics, "steps_rejected"),
            metric(after.run.result.metrics, "steps_rejected_path"));
  EXPECT_EQ(metric(after.run.result.metrics, "step_smallest"), kStep / 2);
  for (std::size_t k = 1; k < after.run.records.size(); ++k)
    EXPECT_GT(after.run.records[k].time, after.run.records[k - 1].time) << "none is handed out twice";
}

// In the smallest step, dt/256, it goes almost as far as the smallest radius, and farther soon after: the run ends, and
// hands out the last state from which it could go on, and the one that could not be accepted.
TEST(RunEnd, ADivergedRunHandsOutItsLastGoodStateAndTheRejectedOne) {
  const Halted halted = halted_after(100, grains::Precision::double_);
  const double smallest = std::ranges::min(values<double>(halted.state, "grains/radius"));
  const Resumed after = resumed_falling(halted, (1 - 1e-6) * smallest / (kStep / 256));
  const std::vector<Array>& sealed = after.sealed;
  EXPECT_EQ(after.run.result.outcome, Outcome::diverged);
  EXPECT_THAT(after.run.result.reason, HasSubstr("reduce the step"));
  EXPECT_EQ(after.reason, after.run.result.reason);
  EXPECT_EQ(metric(after.run.result.metrics, "step_smallest"), kStep / 256);
  ASSERT_FALSE(sealed.empty());
  const auto ticks_of = [](const std::vector<Array>& state) {
    return 256 * values<std::int64_t>(state, "clock/step")[0] + values<std::int64_t>(state, "clock/part")[0];
  };
  EXPECT_GT(ticks_of(sealed), 256 * values<std::int64_t>(halted.state, "clock/step")[0]) << "not what it was given";
  EXPECT_NEAR(after.run.result.time, static_cast<double>(ticks_of(sealed)) / 256 * kStep, 1e-12)
      << "it stands where it went back to";
  for (const double v : values<double>(sealed, "grains/velocity")) EXPECT_TRUE(std::isfinite(v));
  ASSERT_FALSE(after.rejected.empty());
  EXPECT_GT(ticks_of(after.rejected), ticks_of(sealed));
  EXPECT_LE(ticks_of(after.rejected), ticks_of(sealed) + 100);

  const Resumed again = resumed(halted, sealed);
  EXPECT_EQ(again.run.result.outcome, Outcome::diverged);
  EXPECT_EQ(again.run.result.reason, after.run.result.reason) << "from there it goes the same way again";
}

// At each record a grain is kicked, in steps of any size.
TEST(RunEnd, EnergyThatNothingGaveEndsAsDiverged) {
  const scene::SceneSpec scene = drive_of_300(pile::FlatTip{});
  Simulation sim = build(scene, settled(scene.bed), {});
  std::vector<Array> sealed, rejected;
  RunHooks hooks;
  hooks.progress = [&](const Progress&) { std::visit([](auto& system) { system.motion(75).vy = 5; }, sim.contacts); };
  hooks.checkpoint = [&](const std::vector<Array>& state) { sealed = state; };
  hooks.post_mortem = [&](const std::vector<Array>& state, const std::string&) { rejected = state; };
  const scene::RecordSpec record = small_record();
  const RunResult result = simulation::drive(sim, scene, record, {}, {}, {}, hooks);
  EXPECT_EQ(result.outcome, Outcome::diverged);
  EXPECT_THAT(result.reason, HasSubstr("J/m that nothing gave them"));
  EXPECT_GE(metric(result.metrics, "steps_rejected_energy"), 9) << "a stretch's last step, and its halvings";
  EXPECT_FALSE(sealed.empty());
  EXPECT_FALSE(rejected.empty());
}

TEST(RunEnd, AStateOfAnotherBedIsRefused) {
  const Halted halted = halted_after(10);
  const scene::SceneSpec other = small_drive(299, 0.8, pile::FlatTip{});
  EXPECT_THROW(run(other, small_record(), settled(other.bed), {}, halted.state, {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace seapile::simulation
