#include "solver/simulation/tip_measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>

#include "solver/simulation/state.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

using support::metric;
using support::settled;
using support::small_drive;
using support::values;

constexpr TipPlace kTip{{0.3, 1}, 0.125};

/// Equal discs on a square lattice around the tip, which have moved by what `motion` says of their places now.
struct Moved {
  std::vector<grains::Disc> discs;
  PlacesBefore before;
  Moved(double way, const std::function<base::Vec2(base::Vec2)>& motion) {
    before.tip = kTip.lowest.y + way;
    for (int i = -40; i <= 40; ++i)
      for (int j = -40; j <= 40; ++j) {
        const base::Vec2 now{kTip.lowest.x + 0.0101 * i, kTip.lowest.y + 0.0101 * (j + 0.5)};
        discs.push_back({now.x, now.y, 0.005, 0});
        before.grain.push_back(now - motion(now));
      }
  }
  TipMeasures measured() const {
    TipMeasures m;
    measure_motion(m, discs, before, kTip);
    return m;
  }
};

/// Corners of the triangle: A and B at the tip's height, C below, by hand for R = 0.125 m.
bool in_triangle(base::Vec2 p) {
  const double y = 1 - p.y, x = std::abs(p.x - 0.3);
  return y > 0 && y < 0.21650635 && x < 0.125 - y * 0.57735027;  // 2R sin 60, and tan 30 of slope
}

constexpr base::Vec2 kStill{0, 0};

TEST(NoseCone, IsWholeWhenItsGrainsMoveWithThePileAndThoseAreTheOnesInMotion) {
  const Moved cone(5e-3, [](base::Vec2 p) { return in_triangle(p) ? base::Vec2{0, -5e-3} : kStill; });
  const auto inside = std::ranges::count_if(cone.discs, [](const auto& d) { return in_triangle({d.x, d.y}); });
  const TipMeasures m = cone.measured();
  EXPECT_EQ(m.nose_cone, 1);
  EXPECT_EQ(m.set_in_motion, static_cast<double>(inside));
  EXPECT_GT(inside, 200);
  EXPECT_EQ(m.lateral_motion, 0);
}

TEST(NoseCone, IsNoneWhenTheGrainsAroundItMoveAndItsOwnDoNot) {
  const Moved around(5e-3, [](base::Vec2 p) { return in_triangle(p) ? kStill : base::Vec2{0, -5e-3}; });
  EXPECT_EQ(around.measured().nose_cone, 0);
}

TEST(NoseCone, LeavesOutWhatSlidesLagsOrRunsAhead) {
  const auto share = [](double across, double down) {
    return Moved(6e-3, [&](base::Vec2) { return base::Vec2{6e-3 * across, -6e-3 * down}; }).measured().nose_cone;
  };
  EXPECT_EQ(share(0.09, 0.91), 1);
  EXPECT_EQ(share(-0.09, 1.09), 1);
  EXPECT_EQ(share(0.11, 1), 0);
  EXPECT_EQ(share(-0.11, 1), 0);
  EXPECT_EQ(share(0, 0.89), 0);
  EXPECT_EQ(share(0, 1.11), 0);
  EXPECT_EQ(share(0, -1), 0);
  // The right half slides.
  const Moved half(5e-3, [](base::Vec2 p) { return base::Vec2{p.x > 0.295 ? 1e-3 : 0.0, -5e-3}; });
  EXPECT_NEAR(half.measured().nose_cone, 0.46, 0.05);
}

TEST(Motion, OfFewerThanATenthOfThePilesIsNone) {
  EXPECT_EQ(Moved(5e-3, [](base::Vec2) { return base::Vec2{3.5e-4, 3.5e-4}; }).measured().set_in_motion, 0);
  const TipMeasures m = Moved(5e-3, [](base::Vec2) { return base::Vec2{-3.6e-4, 4.8e-4}; }).measured();
  EXPECT_EQ(m.set_in_motion, 81 * 81);
  EXPECT_NEAR(m.lateral_motion, 0.75, 1e-12);
}

TEST(Motion, IsNotJudgedBeforeThePileHasGoneItsWay) {
  const TipMeasures m = Moved(4.9e-3, [](base::Vec2) { return base::Vec2{0, -4.9e-3}; }).measured();
  EXPECT_TRUE(std::isnan(m.nose_cone) && std::isnan(m.set_in_motion) && std::isnan(m.lateral_motion));
}

TEST(NoseCone, IsAbsentWhereNoGrainIs) {
  Moved high(5e-3, [](base::Vec2) { return kStill; });
  for (grains::Disc& d : high.discs) d.y += 1;
  for (base::Vec2& p : high.before.grain) p.y += 1;
  const TipMeasures m = high.measured();
  EXPECT_TRUE(std::isnan(m.nose_cone));
  EXPECT_EQ(m.set_in_motion, 0);
  EXPECT_TRUE(std::isnan(m.lateral_motion));
}

/// A square lattice of touching discs with known contact forces, by the place and the normal's direction.
struct Pressed {
  static constexpr double kRadius = 0.005;
  grains::Box box{-1, 1.6, 0};
  std::vector<grains::Disc> discs;
  std::vector<grains::ContactForce> contacts;
  template <class F>
  explicit Pressed(F&& force) {
    constexpr int kAcross = 260, kUp = 160;
    for (int row = 0; row < kUp; ++row)
      for (int column = 0; column < kAcross; ++column) {
        const auto me = static_cast<std::int32_t>(discs.size());
        const double x = box.left + kRadius * (2 * column + 1), y = kRadius * (2 * row + 1);
        discs.push_back({x, y, kRadius, 0});
        if (row > 0) contacts.push_back({me, me - kAcross, x, y - kRadius, 0, -1, force({x, y - kRadius}, true), 0});
        if (column > 0) contacts.push_back({me, me - 1, x - kRadius, y, -1, 0, force({x - kRadius, y}, false), 0});
      }
  }
  TipMeasures measured() const {
    TipMeasures m;
    measure_forces(m, contacts, discs, box, kTip);
    return m;
  }
};

double from_tip(base::Vec2 p) { return norm(p - kTip.lowest); }

// A force per contact and row of width 2r is a pressure. 5 %: the rim of the disc of 0.08 m cuts the lattice.
TEST(StressUnderTip, IsThatOfTheContactForces) {
  const TipMeasures m = Pressed([](base::Vec2, bool upright) { return upright ? 100.0 : 40.0; }).measured();
  EXPECT_NEAR(m.stress_under_tip, 100 / 0.01, 0.05 * 100 / 0.01);
  EXPECT_NEAR(m.vertical_stress_share, 100 / 140.0, 0.01);
  const TipMeasures across = Pressed([](base::Vec2, bool upright) { return upright ? 40.0 : 100.0; }).measured();
  EXPECT_NEAR(across.stress_under_tip, 100 / 0.01, 0.05 * 100 / 0.01);
  EXPECT_NEAR(across.vertical_stress_share, 40 / 140.0, 0.01);
}

TEST(StressUnderTip, KnowsNothingOfWhatIsBesideOrAboveTheTip) {
  const auto near = [](base::Vec2 p) { return from_tip(p) < 0.25 + 0.08 && p.y < 1 + 0.08; };
  const TipMeasures m = Pressed([&](base::Vec2 p, bool) { return near(p) ? 100.0 : 1e5; }).measured();
  EXPECT_NEAR(m.stress_under_tip, 100 / 0.01, 0.05 * 100 / 0.01);
}

// One part in ten is what the highest twentieth may be: the percentile is the higher stress, not the mean.
TEST(StressUnderTip, IsTheHighStressOfASmallPlace) {
  const auto core = [](base::Vec2 p) { return norm(p - base::Vec2{0.3, 0.85}) < 0.15; };
  const TipMeasures m = Pressed([&](base::Vec2 p, bool) { return core(p) ? 300.0 : 100.0; }).measured();
  EXPECT_NEAR(m.stress_under_tip, 300 / 0.01, 0.05 * 300 / 0.01);
}

TEST(StrongForces, OfAColumnUnderVerticalLoadAreVertical) {
  EXPECT_EQ(Pressed([](base::Vec2, bool up) { return up ? 2.0 : 1.0; }).measured().strong_force_verticality, 1);
  EXPECT_EQ(Pressed([](base::Vec2, bool up) { return up ? 1.0 : 2.0; }).measured().strong_force_verticality, 0);
}

TEST(StrongForces, AreThoseBelowTheTipWithinFourOfItsHalfWidths) {
  const auto below = [](base::Vec2 p) { return from_tip(p) <= 0.5 && p.y <= 1; };
  const TipMeasures m = Pressed([&](base::Vec2 p, bool up) { return below(p) == up ? 2.0 : 1.0; }).measured();
  EXPECT_EQ(m.strong_force_verticality, 1);
}

TEST(StrongForces, WeighByTheirForceAndTheirNormal) {
  const double s = std::numbers::sqrt2 / 2;
  std::vector<grains::Disc> discs(3, {0.3, 0.9, 0.01, 0});
  std::vector<grains::ContactForce> contacts = {{0, 1, 0.3, 0.9, s, s, 30, 0},    {0, 2, 0.31, 0.9, 0, 1, 10, 0},
                                                {1, 2, 0.3, 0.95, 1, 0, 10, 0},   {1, -4, 0.3, 1, 0, 1, 1e6, 0},
                                                {2, -3, 0.3, 0.9, 0, -1, 1e6, 0}, {0, -1, 0.3, 0.9, -1, 0, 1e6, 0}};
  TipMeasures m;
  measure_forces(m, contacts, discs, {-1, 1.6, 0}, kTip);
  EXPECT_NEAR(m.contact_force_mean, 50 / 3.0, 1e-12) << "walls and pile are no grains";
  EXPECT_NEAR(m.strong_force_verticality, 0.5, 1e-12) << "one at 45 degrees";
  contacts[1].normal = 20;
  measure_forces(m, contacts, discs, {-1, 1.6, 0}, kTip);
  EXPECT_NEAR(m.strong_force_verticality, (30 * 0.5) / 30, 1e-12) << "20 is the mean, and not above it";
  contacts[1].normal = 25;
  measure_forces(m, contacts, discs, {-1, 1.6, 0}, kTip);
  EXPECT_NEAR(m.strong_force_verticality, (30 * 0.5 + 25) / 55, 1e-12);
}

TEST(ContactForces, HaveTheirMeanAndPercentile) {
  std::vector<grains::ContactForce> contacts;
  for (int k = 0; k < 100; ++k) contacts.push_back({0, 1, 0, 0, 1, 0, 1.0 + (k * 37) % 100, 0});
  const std::vector<grains::Disc> discs(2);
  TipMeasures m;
  measure_forces(m, contacts, discs, {-1, 1.6, 0}, kTip);
  EXPECT_NEAR(m.contact_force_mean, 50.5, 1e-12);
  EXPECT_EQ(m.contact_force_p95, 95);
  TipMeasures none;
  measure_forces(none, {}, discs, {-1, 1.6, 0}, kTip);
  EXPECT_TRUE(std::isnan(none.contact_force_mean) && std::isnan(none.contact_force_p95));
  EXPECT_TRUE(std::isnan(none.strong_force_verticality) && std::isnan(none.vertical_stress_share));
  EXPECT_EQ(none.stress_under_tip, 0);
}

TEST(DepthText, HasTwoDigitsOrAsManyAsItNeeds) {
  EXPECT_EQ(depth_text(0), "0.00");
  EXPECT_EQ(depth_text(3 * 0.05), "0.15");
  EXPECT_EQ(depth_text(1.2), "1.20");
  EXPECT_EQ(depth_text(0.125), "0.125");
  EXPECT_EQ(depth_text(0.9999), "0.9999");
  EXPECT_EQ(depth_text(0.99999), "1.00");
  EXPECT_EQ(depth_text(-1), "-1.00");
  EXPECT_EQ(depth_text(-1e-9), "0.00");
}

TEST(Measuring, ComesBackFromACheckpointAndLeavesItsState) {
  Measuring measuring;
  measuring.taken = {{.asked = 0.1, .nose_cone = 0.5, .contact_force_p95 = 7}, {.asked = 0.2, .set_in_motion = 3}};
  measuring.open = {{1.5, {{1, 2}, {3, 4}}}, {1.25, {{5, 6}, {7, 8}}}};
  std::vector<Array> checkpoint = {{{"clock/step", "-", "", 1, Entity::run}, std::vector<std::int64_t>{3}}};
  const std::vector<Array> state = checkpoint;
  std::ranges::copy(arrays_of(measuring), std::back_inserter(checkpoint));
  const Measuring back = take_out(checkpoint);
  EXPECT_EQ(compare(checkpoint, state), "");
  EXPECT_EQ(compare(arrays_of(back), arrays_of(measuring)), "");
  ASSERT_EQ(back.open.size(), 2u);
  EXPECT_EQ(back.open[1].tip, 1.25);
  EXPECT_EQ(back.open[1].grain[0], (base::Vec2{5, 6}));
  ASSERT_EQ(back.taken.size(), 2u);
  EXPECT_EQ(back.taken[0].contact_force_p95, 7);
  EXPECT_TRUE(arrays_of({}).empty());

  std::vector<Array> short_of = arrays_of(measuring);
  for (Array& array : short_of) std::get<std::vector<double>>(array.values).pop_back();
  EXPECT_THROW(take_out(short_of), std::invalid_argument);
}

scene::RecordSpec close_frames() {
  scene::RecordSpec record;
  record.frames = {0, 0.045, 0.0475, 0.05, 0.12};
  record.window = 1e-3;
  return record;
}

constexpr const char* kNames[] = {"nose_cone",          "set_in_motion",         "lateral_motion",
                                  "stress_under_tip",   "vertical_stress_share", "strong_force_verticality",
                                  "contact_force_mean", "contact_force_p95"};

TEST(TipMeasuresOfADrive, AreThereForEachFrameAndAgreeWithTheFramesThemselves) {
  for (const pile::Tip& tip : {pile::Tip{pile::FlatTip{}}, pile::Tip{pile::ConicalTip{}}}) {
    scene::SceneSpec scene = small_drive(300, 0.8, tip);
    const support::Drive run = support::drive(scene, close_frames(), settled(scene.bed));
    for (const char* depth : {"_0.045", "_0.0475", "_0.05", "_0.12"})
      for (const std::string name : kNames) {
        const double value = metric(run.result.metrics, name + depth);
        EXPECT_TRUE(std::isfinite(value)) << name << depth;
        std::printf("%s %s%s = %.4g\n", tip.index() ? "flat" : "conical", name.c_str(), depth, value);
      }
    EXPECT_GE(metric(run.result.metrics, "strong_force_verticality_0.12"), 0);
    EXPECT_LE(metric(run.result.metrics, "nose_cone_0.12"), 1);

    // The frame 5 mm before knows where the grains were, within a step of the pile of 0.2 mm.
    const Frame &then = run.frames.at(1), &now = run.frames.at(3);
    const auto &a = values<double>(then.grains, "grains/position"), &b = values<double>(now.grains, "grains/position");
    double moved = 0, lateral = 0, vertical = 0;
    for (std::size_t i = 0; i < a.size(); i += 2) {
      const double dx = std::abs(b[i] - a[i]), dy = std::abs(b[i + 1] - a[i + 1]);
      if (std::hypot(dx, dy) <= 0.1 * (now.depth - then.depth)) continue;
      ++moved, lateral += dx, vertical += dy;
    }
    EXPECT_NEAR(metric(run.result.metrics, "set_in_motion_0.05"), moved, 0.05 * moved);
    EXPECT_NEAR(metric(run.result.metrics, "lateral_motion_0.05"), lateral / vertical, 0.05 * lateral / vertical);

    const auto& who = values<std::int64_t>(now.contacts, "contacts/grain");
    const auto& force = values<double>(now.contacts, "contacts/force");
    double sum = 0, count = 0;
    for (std::size_t k = 0; k < who.size(); k += 2)
      if (who[k + 1] >= 0) sum += force[k], ++count;
    EXPECT_NEAR(metric(run.result.metrics, "contact_force_mean_0.05"), sum / count, 1e-9 * sum / count);
  }
}

TEST(TipMeasuresOfADrive, KnowNoMotionAtTheStart) {
  scene::SceneSpec scene = small_drive(300, 0.8, pile::FlatTip{});
  scene::RecordSpec record;
  record.frames = {-1, 0.1};
  const auto metrics = support::drive(scene, record, settled(scene.bed)).result.metrics;
  EXPECT_TRUE(std::isnan(metric(metrics, "set_in_motion_-1.00")));
  EXPECT_GT(metric(metrics, "contact_force_mean_-1.00"), 0);
  EXPECT_GT(metric(metrics, "set_in_motion_0.10"), 0);
}

// Before, between and after frames that are closer to each other than the way that they look back on.
TEST(TipMeasuresOfADrive, HaveTheSameBitsAfterAResumeAnywhere) {
  scene::SceneSpec scene = small_drive(300, 0.8, pile::FlatTip{});
  std::vector<std::vector<Array>> checkpoints;
  std::vector<std::size_t> before;
  support::Drive whole;
  RunHooks hooks = support::keeping(whole);
  hooks.checkpoint_due = [&] { return whole.records.size() % 3 == 0; };
  hooks.checkpoint = [&](const std::vector<Array>& state) {
    checkpoints.push_back(state);
    before.push_back(whole.records.size());
  };
  whole.result = run(scene, close_frames(), settled(scene.bed), {1, Simd::best, {1}}, {}, {}, hooks);
  std::set<std::pair<std::size_t, std::size_t>> kinds;  // frames taken and places kept of those resumed from
  for (std::size_t k = 0; k < checkpoints.size(); ++k) {
    std::vector<Array> rest = checkpoints[k];
    const Measuring measuring = take_out(rest);
    if (!kinds.insert({measuring.taken.size(), measuring.open.size()}).second) continue;
    support::Drive continued;
    const std::vector<Record> so_far(whole.records.begin(),
                                     whole.records.begin() + static_cast<std::ptrdiff_t>(before[k]));
    continued.result =
        run(scene, close_frames(), settled(scene.bed), {}, checkpoints[k], {so_far, {}}, support::keeping(continued));
    ASSERT_EQ(continued.result.metrics.size(), whole.result.metrics.size()) << before[k];
    for (std::size_t m = 0; m < whole.result.metrics.size(); ++m) {
      EXPECT_EQ(continued.result.metrics[m].name, whole.result.metrics[m].name);
      EXPECT_EQ(continued.result.metrics[m].value, whole.result.metrics[m].value) << whole.result.metrics[m].name;
    }
  }
  EXPECT_TRUE(kinds.contains({1, 2}) || kinds.contains({1, 3})) << "one in which places of several frames are kept";
  EXPECT_TRUE(kinds.contains({4, 0})) << "one after these frames";
  EXPECT_GE(kinds.size(), 6u);
}

}  // namespace
}  // namespace seapile::simulation
