// Small scenes by name, for tests and benchmarks: the thesis' case (table 6.1) with fewer grains, a narrower box and a
// thinner pile.
#pragma once

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "solver/scene/spec.h"
#include "solver/simulation/run.h"

namespace seapile::support {

/// A bed about as high as 0.93 mm per grain and metre of width: 600 grains in 1.2 m stand 0.46 m high.
inline scene::BedSpec small_bed(std::int64_t count, double width) {
  scene::BedSpec bed;
  bed.domain.width = width;
  bed.domain.height = 0.0016 * static_cast<double>(count) / width + 0.2;
  bed.grains.count = count;
  return bed;
}

/// A pile of half-width 0.05 m, driven at 0.4 m/s to 0.12 m.
inline scene::SceneSpec small_drive(std::int64_t count, double width, const pile::Tip& tip) {
  scene::SceneSpec scene;
  scene.bed = small_bed(count, width);
  auto& pile = scene.pile.emplace();
  pile.radius = 0.05;
  pile.tip = tip;
  pile.driving = pile::ConstantDriving{0.4};
  pile.depth = 0.12;
  return scene;
}

/// 300 grains under 0.6 m of water, and a cone that goes down through a remesh.
inline scene::SceneSpec small_saturated_drive() {
  scene::SceneSpec scene = small_drive(300, 0.8, pile::ConicalTip{});
  scene.bed.domain.height = 1.2;
  scene::FluidSpec& fluid = scene.fluid.emplace();
  fluid.depth = 0.9;
  fluid.mesh.size = 0.09;
  fluid.mesh.pile_size = 0.06;
  fluid.mesh.motion = basin::ZonesMotion{0.2};
  fluid.mesh.remesh->share = 0.02;
  fluid.time.step = 1e-3;
  return scene;
}

/// Two frames on the way; everything else as usual.
inline scene::RecordSpec small_record() {
  scene::RecordSpec record;
  record.frames = {0, 0.05, 0.12};
  return record;
}

/// The bed, settled once per program and seed.
inline const simulation::Bed& settled(const scene::BedSpec& spec) {
  static std::vector<std::pair<scene::BedSpec, simulation::Bed>> beds;
  for (const auto& [known, bed] : beds)
    if (known == spec) return bed;
  beds.reserve(32);  // References handed out must stay.
  if (beds.size() == beds.capacity()) throw std::logic_error("more beds than are kept");
  beds.emplace_back(spec, simulation::prepare_bed(spec, {}, {}, {}));
  return beds.back().second;
}

/// Everything that a run hands out.
struct Drive {
  simulation::RunResult result;
  std::vector<simulation::Record> records;
  std::vector<simulation::Frame> frames;
  std::vector<simulation::Progress> progress;
};

/// Hooks that keep what they are handed.
inline simulation::RunHooks keeping(Drive& run) {
  simulation::RunHooks hooks;
  hooks.record = [&](const simulation::Record& r) { run.records.push_back(r); };
  hooks.frame = [&](const simulation::Frame& f) { run.frames.push_back(f); };
  hooks.progress = [&](const simulation::Progress& p) { run.progress.push_back(p); };
  return hooks;
}

/// A run from start to end.
inline Drive drive(const scene::SceneSpec& scene, const scene::RecordSpec& record, const simulation::Bed& bed,
                   const simulation::Execution& execution = {}) {
  Drive run;
  run.result = simulation::run(scene, record, bed, execution, {}, {}, keeping(run));
  return run;
}

/// A metric by its name; NaN when there is none.
inline double metric(const std::vector<simulation::Metric>& metrics, const std::string& name) {
  for (const simulation::Metric& m : metrics)
    if (m.name == name) return m.value;
  return std::numeric_limits<double>::quiet_NaN();
}

/// The values of an array by its name.
template <class T>
const std::vector<T>& values(const std::vector<simulation::Array>& arrays, const std::string& name) {
  for (const simulation::Array& array : arrays)
    if (array.info.name == name) return std::get<std::vector<T>>(array.values);
  throw std::out_of_range("no array " + name);
}

}  // namespace seapile::support
