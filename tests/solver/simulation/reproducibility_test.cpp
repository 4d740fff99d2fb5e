// A result depends on its case alone: not on threads, register width, cadence, interruption or the order of the input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "solver/grains/contact_kernels.h"
#include "solver/simulation/run.h"
#include "solver/simulation/state.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

using support::drive;
using support::Drive;
using support::settled;
using support::small_drive;
using support::values;

// Two thousand grains: four tiles in two halves, so that threads have something to share out.
scene::SceneSpec scene_of_2000(const pile::Tip& tip) {
  scene::SceneSpec scene = small_drive(2000, 1.8, tip);
  scene.pile->depth = 0.08;
  return scene;
}

/// A run that is asked after each step whether to stop.
constexpr Execution kAskedOften{1, Simd::best, {1}};

scene::RecordSpec two_frames() {
  scene::RecordSpec record;
  record.frames = {0.02, 0.08};
  return record;
}

const Drive& undisturbed(bool flat) {
  static const auto make = [](const pile::Tip& tip) {
    const scene::SceneSpec scene = scene_of_2000(tip);
    return drive(scene, two_frames(), settled(scene.bed), {1, Simd::generic});
  };
  static const Drive runs[] = {make(pile::ConicalTip{}), make(pile::FlatTip{})};
  return runs[flat];
}

template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Records from a certain one on, bit for bit.
void expect_same_records(std::span<const Record> found, std::span<const Record> expected, const std::string& what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (std::size_t k = 0; k < found.size(); ++k)
    ASSERT_TRUE(same_bits(found[k], expected[k])) << what << ", record " << k;
}

void expect_same_frames(std::span<const Frame> found, std::span<const Frame> expected, const std::string& what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].time, expected[k].time) << what;
    EXPECT_EQ(compare(found[k].grains, expected[k].grains), "") << what;
    EXPECT_EQ(compare(found[k].contacts, expected[k].contacts), "") << what;
    EXPECT_EQ(compare(found[k].cells, expected[k].cells), "") << what;
  }
}

void expect_same_run(const Drive& found, const Drive& expected, const std::string& what) {
  EXPECT_EQ(found.result.state_hash, expected.result.state_hash) << what;
  expect_same_records(found.records, expected.records, what);
  expect_same_frames(found.frames, expected.frames, what);
}

TEST(Reproducibility, ARerunHasTheSameBits) {
  for (const bool flat : {false, true}) {
    const scene::SceneSpec scene = scene_of_2000(flat ? pile::Tip{pile::FlatTip{}} : pile::Tip{pile::ConicalTip{}});
    expect_same_run(drive(scene, two_frames(), settled(scene.bed), {1, Simd::generic}), undisturbed(flat), "rerun");
  }
  EXPECT_NE(undisturbed(false).result.state_hash, undisturbed(true).result.state_hash);
}

TEST(Reproducibility, AnyNumberOfThreadsHasTheSameBits) {
  scene::SceneSpec scene = scene_of_2000(pile::FlatTip{});
  for (const int threads : {2, 3, 4, 8}) {
    const Drive run = drive(scene, two_frames(), settled(scene.bed), {threads, Simd::best});
    expect_same_run(run, undisturbed(true), std::to_string(threads) + " threads");
  }
}

TEST(Reproducibility, EveryInstructionSetHasTheSameBits) {
  const scene::SceneSpec scene = scene_of_2000(pile::ConicalTip{});
  for (const auto& [simd, set, name] : {std::tuple{Simd::avx2, grains::InstructionSet::avx2, "avx2"},
                                        {Simd::avx512, grains::InstructionSet::avx512, "avx512"}}) {
    if (!available(set)) continue;
    expect_same_run(drive(scene, two_frames(), settled(scene.bed), {1, simd}), undisturbed(false), name);
  }
}

TEST(Reproducibility, DoublePrecisionHasTheSameBitsToo) {
  scene::SceneSpec scene = scene_of_2000(pile::ConicalTip{});
  scene.contact.precision = grains::Precision::double_;
  scene.pile->depth = 0.02;
  scene::RecordSpec record;
  record.frames = {0.02};
  const Drive expected = drive(scene, record, settled(scene.bed), {1, Simd::generic});
  expect_same_run(drive(scene, record, settled(scene.bed), {3, Simd::best}), expected, "3 threads, best");
}

TEST(Reproducibility, TheNonSmoothMethodHasTheSameBitsToo) {
  scene::SceneSpec scene = scene_of_2000(pile::ConicalTip{});
  scene.contact.step = 1e-4;
  scene.contact.method = grains::NonSmoothMethod{12, 0, 1e-3};
  scene.pile->depth = 0.02;
  scene::RecordSpec record;
  record.frames = {0.02};
  for (const auto precision : {grains::Precision::single_, grains::Precision::double_}) {
    scene.contact.precision = precision;
    const Drive expected = drive(scene, record, settled(scene.bed), {1, Simd::generic});
    for (const int threads : {1, 2, 5})
      expect_same_run(drive(scene, record, settled(scene.bed), {threads, Simd::best}), expected,
                      std::to_string(threads) + " threads, best");
    EXPECT_GT(expected.records.back().residual, 0);
  }
}

TEST(Reproducibility, TheCadenceOfRecordsAndFramesChangesNoBit) {
  const scene::SceneSpec scene = scene_of_2000(pile::FlatTip{});
  scene::RecordSpec record;
  record.travel = 0.0031;
  record.frames = {0.01, 0.07};
  record.window = 0.03;
  EXPECT_EQ(drive(scene, record, settled(scene.bed)).result.state_hash, undisturbed(true).result.state_hash);
}

/// Runs to the n-th record, stops, and resumes from what was sealed there.
Drive stopped_and_resumed(const scene::SceneSpec& scene, std::size_t stop_after, const Execution& after) {
  Drive before;
  std::vector<Array> state;
  RunHooks hooks = keeping(before);
  hooks.stop = [&] { return before.records.size() >= stop_after; };
  hooks.checkpoint = [&](const std::vector<Array>& s) { state = s; };
  before.result = run(scene, two_frames(), settled(scene.bed), kAskedOften, {}, {}, hooks);
  EXPECT_EQ(before.result.outcome, Outcome::stopped);

  Drive whole = before;
  whole.result = run(scene, two_frames(), settled(scene.bed), after, state, {before.records, {}}, keeping(whole));
  return whole;
}

TEST(Reproducibility, StopAndRestoreAtTenPlacesHasTheSameBits) {
  const scene::SceneSpec scene = scene_of_2000(pile::FlatTip{});
  const Drive& expected = undisturbed(true);
  const std::size_t count = expected.records.size();
  for (std::size_t place = 0; place < 10; ++place) {
    const std::size_t stop_after = 1 + place * (count - 20) / 9;
    // Another number of threads and other instructions after the stop.
    const Execution after{place % 2 ? 2 : 1, place % 3 ? Simd::best : Simd::generic};
    const Drive found = stopped_and_resumed(scene, stop_after, after);
    expect_same_run(found, expected, "stopped after record " + std::to_string(stop_after));
    ASSERT_EQ(found.result.metrics.size(), expected.result.metrics.size());
    for (std::size_t k = 0; k < found.result.metrics.size(); ++k)
      EXPECT_EQ(found.result.metrics[k].value, expected.result.metrics[k].value) << found.result.metrics[k].name;
  }
}

TEST(Reproducibility, EveryMethodIsStoppedAndRestoredWithTheSameBits) {
  scene::SceneSpec scene = small_drive(150, 0.6, pile::FlatTip{});
  scene.pile->depth = 0.05;
  for (const bool rigid : {false, true})
    for (const auto solver : {grains::Solver::blocks, grains::Solver::brute_force}) {
      scene.contact.step = rigid ? 2e-4 : 5e-4;
      if (rigid) scene.contact.method = grains::NonSmoothMethod{10, 1e-6, 1e-3};
      scene.contact.solver = solver;
      const scene::RecordSpec record{5e-4, {}, 0.01, 0.05};
      const Drive expected = drive(scene, record, settled(scene.bed));
      Drive found;
      std::vector<Array> state;
      RunHooks hooks = keeping(found);
      hooks.stop = [&] { return found.records.size() >= 40; };
      hooks.checkpoint = [&](const std::vector<Array>& s) { state = s; };
      run(scene, record, settled(scene.bed), kAskedOften, {}, {}, hooks);
      ASSERT_FALSE(state.empty());
      found.result = run(scene, record, settled(scene.bed), {2, Simd::best}, state, {found.records, {}}, keeping(found));
      expect_same_run(found, expected, rigid ? "non-smooth" : "soft");
      EXPECT_GT(expected.result.metrics.size(), 5u);
    }
}

TEST(Reproducibility, CheckpointsOnTheWayChangeNoBit) {
  const scene::SceneSpec scene = scene_of_2000(pile::ConicalTip{});
  Drive run;
  int sealed = 0;
  RunHooks hooks = keeping(run);
  hooks.checkpoint_due = [&] { return run.records.size() % 7 == 0; };
  hooks.checkpoint = [&](const std::vector<Array>&) { ++sealed; };
  run.result = simulation::run(scene, two_frames(), settled(scene.bed), kAskedOften, {}, {}, hooks);
  expect_same_run(run, undisturbed(false), "with checkpoints");
  EXPECT_GT(sealed, 15);
}

TEST(Reproducibility, TheOrderOfTheGrainsChangesNoBit) {
  const scene::SceneSpec scene = scene_of_2000(pile::FlatTip{});
  Bed shuffled = settled(scene.bed);
  const Bed& bed = settled(scene.bed);
  std::vector<std::size_t> order(2000);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = order.size() - 1; k > 0; --k) std::swap(order[k], order[(k * 7919 + 13) % (k + 1)]);
  auto& id = std::get<std::vector<std::int64_t>>(shuffled.grains[0].values);
  auto& position = std::get<std::vector<double>>(shuffled.grains[1].values);
  auto& radius = std::get<std::vector<double>>(shuffled.grains[2].values);
  for (std::size_t k = 0; k < order.size(); ++k) {
    id[k] = values<std::int64_t>(bed.grains, "grains/id")[order[k]];
    position[2 * k] = values<double>(bed.grains, "grains/position")[2 * order[k]];
    position[2 * k + 1] = values<double>(bed.grains, "grains/position")[2 * order[k] + 1];
    radius[k] = values<double>(bed.grains, "grains/radius")[order[k]];
  }
  EXPECT_NE(compare(shuffled.grains, bed.grains), "");
  expect_same_run(drive(scene, two_frames(), shuffled), undisturbed(true), "shuffled grains");
}

// The number itself: whoever changes it changes every result, and raises a numerics version. The scene uses no sine,
// cosine or power of the mathematical library, whose last bit is nobody's promise: a flat tip at constant speed.
TEST(Reproducibility, TheHashOfAFixedSceneNeverChangesByAccident) {
  scene::SceneSpec scene = small_drive(300, 0.8, pile::FlatTip{});
  scene.bed.preparation.longest = 12;
  const Drive run = drive(scene, {5e-4, {}, 0.01, 0.05}, settled(scene.bed));
  EXPECT_EQ(run.result.state_hash, 14783150735042366781u);
}

}  // namespace
}  // namespace seapile::simulation
