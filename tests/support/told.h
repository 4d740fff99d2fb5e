// Everything that a run hands out, kept to be compared byte by byte: a step that is taken back leaves no trace in it,
// and a run that is stopped and resumed tells the same.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "solver/simulation/run.h"
#include "tests/support/scenes.h"

namespace seapile::support {

/// Everything that a run hands out, in its order, as bytes.
struct Told {
  std::vector<std::string> bytes;
  simulation::RunResult result;
  std::vector<simulation::Array> sealed;  ///< where it was stopped
  simulation::RecordsSoFar so_far;
  double time = 0;  ///< that progress was told of last [s]
};

template <class T>
std::string bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}
inline std::string bytes_of(std::initializer_list<const std::vector<simulation::Array>*> lists) {
  std::string bytes;
  for (const auto* list : lists)
    for (const simulation::Array& array : *list)
      bytes += array.info.name + std::visit([](const auto& v) { return bytes_of(std::span(v)); }, array.values);
  return bytes;
}
template <class R>
std::string row_of(const char* kind, const R& record) {
  std::vector<double> row;
  columns([&](const char*, const char*, const char*, double v) { row.push_back(v); }, record);
  return kind + bytes_of(std::span<const double>(row));
}
inline std::string bytes_of(const simulation::FlowFrame& frame) {
  return "flow frame " + std::to_string(frame.time) + bytes_of({&frame.vertices, &frame.triangles, &frame.surface});
}

/// Hooks that keep it. `until`: when the run is to be stopped [s].
template <class Hooks>
Hooks keeping(Told& told, double until) {
  using namespace simulation;
  Hooks hooks;
  const auto flow_frame = [&](const FlowFrame& f) { told.bytes.push_back(bytes_of(f)); };
  const auto flow_record = [&](const FlowRecord& r) {
    told.so_far.flow_records.push_back(r);
    told.bytes.push_back(row_of("flow record", r));
  };
  if constexpr (requires { hooks.flow_record; }) {
    hooks.record = [&](const Record& r) {
      told.so_far.records.push_back(r);
      told.bytes.push_back(row_of("record", r));
    };
    hooks.frame = [&](const Frame& f) {
      told.bytes.push_back("frame " + std::to_string(f.time) + bytes_of({&f.grains, &f.contacts, &f.cells}));
    };
    hooks.flow_record = flow_record;
    hooks.flow_frame = flow_frame;
  } else {
    hooks.frame = flow_frame;
    if constexpr (requires { hooks.record; }) hooks.record = flow_record;
  }
  hooks.progress = [&](const Progress& p) { told.time = p.time; };
  hooks.stop = [&told, until] { return told.time >= until; };
  hooks.checkpoint = [&](const std::vector<Array>& state) { told.sealed = state; };
  return hooks;
}

inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// How a scene is run: `until` when it is stopped, after what it has told `before`.
struct Telling {
  simulation::Trying trying = {};
  double until = kNever;
  Told before = {};
  int threads = 1;
};

struct Scene {
  std::string name;
  double step = 0;                                   ///< a whole one [s]
  std::function<Told(const Telling&, Told&&)> tell;  ///< adds to what was told before
  std::int64_t together = 1;                         ///< steps of the grains in one of the fluid
  bool remeshes = false;

  Told run(const Telling& how = {}) const {
    Told told;
    told.bytes = how.before.bytes;
    told.so_far = how.before.so_far;
    return tell(how, std::move(told));
  }
};

/// All but what depends on when it is asked.
inline void expect_same(const Told& found, const Told& expected, const std::string& what) {
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

/// The middle step, taken back once, in stretches of either length.
inline void expect_no_trace_of_a_step_taken_back(const Scene& scene) {
  const Told whole = scene.run();
  ASSERT_EQ(whole.result.outcome, simulation::Outcome::completed) << scene.name << ": " << whole.result.reason;
  EXPECT_EQ(metric(whole.result.metrics, "steps_rejected"), 0) << scene.name;
  if (scene.remeshes) {
    EXPECT_GT(metric(whole.result.metrics, "meshes"), 1) << scene.name;
  }
  const std::int64_t middle = std::llround(whole.result.time / scene.step) / 2;
  expect_same(scene.run({{0, middle}}), whole, scene.name);
  expect_same(scene.run({{16, middle + 5}}), whole, scene.name + ", in shorter stretches");
}

inline void expect_resumed_is_whole(const Scene& scene) {
  const Told whole = scene.run();
  const Told half = scene.run({{scene.together, -1}, 0.5 * whole.result.time});
  ASSERT_EQ(half.result.outcome, simulation::Outcome::stopped) << scene.name;
  ASSERT_FALSE(half.sealed.empty()) << scene.name;
  EXPECT_LT(half.bytes.size(), whole.bytes.size()) << scene.name;
  expect_same(scene.run({.before = half}), whole, scene.name);
}

}  // namespace seapile::support
