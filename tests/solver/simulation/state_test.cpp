#include "solver/simulation/state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>

#include "solver/simulation/build.h"
#include "solver/simulation/observe.h"
#include "solver/simulation/step.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

using support::settled;
using support::small_drive;
using testing::HasSubstr;

/// A pile on its way into a bed.
Simulation driven(int steps, grains::Precision precision = grains::Precision::single_) {
  scene::SceneSpec scene = small_drive(150, 0.6, pile::ConicalTip{});
  scene.contact.precision = precision;
  Simulation sim = build(scene, settled(scene.bed), {});
  for (int k = 0; k < steps; ++k) gather(sim, step(sim));
  return sim;
}

void advance(Simulation& sim, int steps) {
  for (int k = 0; k < steps; ++k) gather(sim, step(sim));
}

TEST(State, ARestoredSimulationContinuesBitForBit) {
  for (const auto precision : {grains::Precision::single_, grains::Precision::double_}) {
    // Into a simulation of another time, and into a fresh one.
    for (const int elsewhere : {0, 400}) {
      Simulation sim = driven(250, precision), other = driven(elsewhere, precision);
      restore(other, snapshot(sim));
      EXPECT_EQ(compare(snapshot(sim), snapshot(other)), "");
      EXPECT_EQ(state_hash(sim), state_hash(other));
      for (int k = 0; k < 5; ++k) {
        advance(sim, 50);
        advance(other, 50);
        ASSERT_EQ(compare(snapshot(sim), snapshot(other)), "") << "after " << 50 * (k + 1) << " steps";
      }
    }
  }
}

TEST(State, TakingASnapshotChangesNoBit) {
  Simulation sim = driven(200), other = driven(200);
  for (int k = 0; k < 100; ++k) {
    advance(sim, 1);
    advance(other, 1);
    snapshot(sim);
    state_hash(sim);
  }
  EXPECT_EQ(compare(snapshot(sim), snapshot(other)), "");
}

TEST(State, AWholeTripThroughASnapshotIsIdentity) {
  Simulation sim = driven(200);
  const std::vector<Array> before = snapshot(sim);
  restore(sim, before);
  EXPECT_EQ(compare(before, snapshot(sim)), "");
}

TEST(State, TheDescriptionNamesEachArrayOnceWithUnitMeaningAndWholeRows) {
  const Simulation sim = driven(50);
  std::set<std::string> names;
  describe(sim, [&](const ArrayInfo& info, ArrayView values) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_FALSE(info.unit.empty()) << info.name;
    EXPECT_FALSE(info.meaning.empty()) << info.name;
    const std::size_t size = std::visit([](const auto& v) { return v.size(); }, values);
    EXPECT_EQ(size % static_cast<std::size_t>(info.columns), 0u) << info.name;
    if (info.entity == Entity::grain) {
      EXPECT_EQ(size, 150u * static_cast<std::size_t>(info.columns)) << info.name;
    }
  });
  // What the next step needs besides places and velocities: the impulses and the order of the contacts.
  for (const char* name : {"clock/step", "grains/id", "grains/position", "grains/velocity", "grains/surface_speed",
                           "list/pair", "blocks/impulse", "blocks/colour", "pile/motion", "pile/impulse"})
    EXPECT_TRUE(names.contains(name)) << name;
}

/// Every number of every array, one at a time: a bit of it changed.
void for_every_array(const std::vector<Array>& state,
                     const std::function<void(const std::vector<Array>&, const std::string&)>& check) {
  for (std::size_t k = 0; k < state.size(); ++k) {
    std::vector<Array> changed = state;
    const bool has = std::visit(
        [](auto& v) {
          if (v.empty()) return false;
          v[v.size() / 2] += 1;
          return true;
        },
        changed[k].values);
    if (has) check(changed, state[k].info.name);
  }
}

TEST(State, CompareNamesTheFirstDifference) {
  const std::vector<Array> state = snapshot(driven(200));
  EXPECT_EQ(compare(state, state), "");
  int arrays = 0;
  for_every_array(state, [&](const std::vector<Array>& changed, const std::string& name) {
    EXPECT_THAT(compare(state, changed), HasSubstr(name + "["));
    EXPECT_THAT(compare(state, changed), HasSubstr(" against "));
    ++arrays;
  });
  EXPECT_GT(arrays, 15);
  std::vector<Array> shorter = state;
  shorter.pop_back();
  EXPECT_THAT(compare(state, shorter), HasSubstr(state.back().info.name));
}

TEST(State, CompareTellsMinusZeroFromZeroAndTakesANaNForItself) {
  const std::vector<Array> zero = {{{"a", "-", "", 1, Entity::run}, std::vector<double>{0.0}}};
  const std::vector<Array> minus = {{{"a", "-", "", 1, Entity::run}, std::vector<double>{-0.0}}};
  const std::vector<Array> nan = {
      {{"a", "-", "", 1, Entity::run}, std::vector<double>{std::numeric_limits<double>::quiet_NaN()}}};
  EXPECT_NE(compare(zero, minus), "");
  EXPECT_EQ(compare(nan, nan), "");
  EXPECT_NE(compare(nan, zero), "");
}

TEST(State, TheHashSeesEveryArray) {
  Simulation sim = driven(200);
  const std::uint64_t hash = state_hash(sim);
  const std::vector<Array> state = snapshot(sim);
  for (const char* name : {"clock/step", "grains/position", "grains/velocity", "grains/surface_speed", "blocks/impulse",
                           "pile/motion", "pile/impulse", "totals", "gathering"}) {
    std::vector<Array> changed = state;
    for (Array& array : changed)
      if (array.info.name == name) std::visit([](auto& v) { v[v.size() / 2] += 1; }, array.values);
    Simulation other = driven(200);
    restore(other, changed);
    EXPECT_NE(state_hash(other), hash) << name;
  }
}

/// As driven(), with a push on its grains in the last steps.
Simulation pushed(int steps, int last, grains::Precision precision = grains::Precision::single_) {
  Simulation sim = driven(steps, precision);
  for (std::size_t i = 0; i < sim.grains.count(); ++i)
    sim.grains.push.push_back({std::sin(static_cast<double>(i)), 3 + std::cos(static_cast<double>(i))});
  advance(sim, last);
  return sim;
}

TEST(State, APushOnTheGrainsAndItsWorkAreStateWhereThereIsOne) {
  for (const auto precision : {grains::Precision::single_, grains::Precision::double_}) {
    // Into one without a push, and into one with another.
    for (const bool with_another : {false, true}) {
      Simulation twin = pushed(150, 50, precision);
      EXPECT_NE(twin.totals.push_work, 0);
      Simulation other = with_another ? pushed(0, 20, precision) : driven(0, precision);
      restore(other, snapshot(twin));
      EXPECT_EQ(state_hash(twin), state_hash(other));
      advance(twin, 50);
      advance(other, 50);
      EXPECT_EQ(compare(snapshot(twin), snapshot(other)), "");
      EXPECT_EQ(twin.totals.push_work, other.totals.push_work);
    }
  }
}

TEST(State, AStateOfDryGrainsNamesNoPushAndTakesItAway) {
  const std::vector<Array> dry = snapshot(driven(50));
  for (const Array& array : dry) EXPECT_EQ(array.info.name.find("push"), std::string::npos);
  Simulation sim = pushed(20, 20);
  restore(sim, dry);
  EXPECT_EQ(compare(dry, snapshot(sim)), "");
  EXPECT_EQ(sim.totals.push_work, 0);
}

/// The sentence with which a simulation refuses a state; it must then be what it was.
std::string refusal(Simulation& sim, const std::vector<Array>& state) {
  const std::vector<Array> before = snapshot(sim);
  std::string why;
  try {
    restore(sim, state);
  } catch (const std::invalid_argument& error) {
    why = error.what();
  }
  EXPECT_EQ(compare(before, snapshot(sim)), "") << "the simulation changed";
  return why;
}

TEST(State, AMissingUnknownOrMisplacedArrayIsRefusedByName) {
  Simulation sim = driven(100);
  const std::vector<Array> state = snapshot(driven(200));
  for (std::size_t k = 0; k < state.size(); ++k) {
    std::vector<Array> missing = state, unknown = state;
    missing.erase(missing.begin() + static_cast<std::ptrdiff_t>(k));
    unknown[k].info.name = "grains/colour";
    EXPECT_NE(refusal(sim, missing), "") << state[k].info.name;
    EXPECT_THAT(refusal(sim, unknown), HasSubstr("grains/colour"));
  }
  std::vector<Array> more = state;
  std::vector<Array> half = snapshot(pushed(20, 20));
  half.pop_back();
  EXPECT_THAT(refusal(sim, half), HasSubstr("push/work"));
  more.push_back({{"fluid/velocity", "m/s", "", 2, Entity::run}, std::vector<double>(4)});
  EXPECT_THAT(refusal(sim, more), HasSubstr("fluid/velocity"));
  EXPECT_NE(refusal(sim, {}), "");
}

TEST(State, AnArrayOfAnotherTypeOrShapeIsRefusedByName) {
  Simulation sim = driven(100);
  const std::vector<Array> state = snapshot(driven(200));
  for (std::size_t k = 0; k < state.size(); ++k) {
    const std::string& name = state[k].info.name;
    std::vector<Array> type = state, columns = state;
    type[k].values = std::vector<std::uint64_t>(std::visit([](const auto& v) { return v.size(); }, state[k].values));
    columns[k].info.columns += 1;
    EXPECT_THAT(refusal(sim, type), HasSubstr(name));
    EXPECT_THAT(refusal(sim, columns), HasSubstr(name));
  }
}

// A checkpoint that lost rows of one array would be read out of bounds if it were taken.
TEST(State, AnArrayThatLostRowsIsRefusedByName) {
  Simulation sim = driven(100);
  const std::vector<Array> state = snapshot(driven(200));
  for (std::size_t k = 0; k < state.size(); ++k) {
    std::vector<Array> cut = state;
    const auto columns = static_cast<std::size_t>(state[k].info.columns);
    const std::size_t size = std::visit([](const auto& v) { return v.size(); }, state[k].values);
    if (size < 2 * columns) continue;
    std::visit([&](auto& v) { v.resize(size - columns); }, cut[k].values);
    // The arrays of one list must agree with each other; whichever of them is named.
    EXPECT_NE(refusal(sim, cut), "") << state[k].info.name;
  }
}

TEST(State, GrainsOfAnotherBedAreRefused) {
  Simulation sim = driven(100);
  for (const char* name : {"grains/id", "grains/radius"}) {
    std::vector<Array> state = snapshot(driven(200));
    for (Array& array : state)
      if (array.info.name == name) std::visit([](auto& v) { v[3] += 1; }, array.values);
    EXPECT_THAT(refusal(sim, state), HasSubstr(name));
  }
}

}  // namespace
}  // namespace seapile::simulation
