#include "bench/traffic.h"

#include <unistd.h>

#include <algorithm>
#include <set>
#include <variant>

#include "bench/memory_speed.h"
#include "solver/simulation/build.h"
#include "solver/simulation/observe.h"
#include "solver/simulation/state.h"
#include "solver/simulation/step.h"

namespace seapile::bench {
namespace {

using grains::kLanes;
using Block = grains::ContactBlock<float>;
using System = grains::ContactSystem<float>;

constexpr double kLine = 64;
constexpr double kBlock = sizeof(Block);
constexpr double kRow = sizeof(Block::nx);  // one number of sixteen contacts
constexpr double kMotion = sizeof(grains::Motion<float>);
constexpr double kBody = sizeof(grains::BodyGroup<float>) / 4;  // motion and drift
constexpr double kBefore = sizeof(grains::Before<float>);
constexpr double kDisc = sizeof(grains::Disc);
constexpr double kStepImpulse = sizeof(grains::StepImpulse);
constexpr double kWake = sizeof(double) + sizeof(std::uint8_t);

/// Groups of four bodies that a block touches: the lines that it fetches where no tile has them at hand.
double groups_of(const Block& block) {
  std::set<std::int32_t> groups;
  for (int lane = 0; lane < kLanes; ++lane)
    groups.insert({grains::body_at(block.i[lane]) / 4, grains::body_at(block.j[lane]) / 4});
  return static_cast<double>(groups.size());
}

/// Adds what the step has done; `wake`: of the blocks before the step.
void add_step(const System& system, std::size_t grain_count, const std::vector<double>& wake, bool rebuilt,
              TrafficCounts& counts) {
  const std::int32_t points = grains::first_point(grain_count);
  const auto& blocks = system.blocks;
  for (std::size_t b = 0; b < blocks.block.size(); ++b) {
    const Block& block = blocks.block[b];
    // Contacts of a block are all of one kind, and the first lane is never empty.
    const std::int32_t i = grains::body_at(block.i[0]), j = grains::body_at(block.j[0]);
    const bool crossing = j < points && system.regions.tile_of(i) != system.regions.tile_of(j);
    const bool detected = rebuilt || blocks.wake[b] != wake[b];
    counts.detected += detected;
    counts.detected_crossing += detected && crossing;
    if (!blocks.active[b]) continue;
    ++counts.active;
    if (crossing) ++counts.crossing, counts.crossing_groups += groups_of(block);
    for (int lane = 0; lane < kLanes; ++lane)
      counts.unmoved += (grains::body_at(block.i[lane]) >= points) + (grains::body_at(block.j[lane]) >= points);
  }
  std::set<std::int32_t> wall_blocks;
  for (const std::int32_t slot : blocks.wall_slot) wall_blocks.insert(slot / kLanes);
  counts.wall_blocks += static_cast<double>(wall_blocks.size());
  counts.blocks += static_cast<double>(blocks.block.size());
}

}  // namespace

TrafficCounts count_traffic(const ScalingState& start, const ScalingOptions& options, int steps) {
  simulation::Simulation sim = simulation::build(start.scene, start.bed, {1, options.simd});
  simulation::restore(sim, start.state);
  const auto& system = std::get<System>(sim.contacts);
  TrafficCounts counts;
  for (int k = 0; k < steps; ++k) {
    const std::vector<double> wake = system.blocks.wake;
    const simulation::StepReport report = step(sim);
    add_step(system, sim.grains.count(), wake, report.contact.rebuilt, counts);
    counts.rebuilds += report.contact.rebuilt;
  }
  for (double* sum : {&counts.blocks, &counts.active, &counts.crossing, &counts.crossing_groups, &counts.detected,
                      &counts.detected_crossing, &counts.unmoved, &counts.wall_blocks})
    *sum /= steps;
  counts.grains = static_cast<double>(sim.grains.count());
  counts.steps = steps;
  return counts;
}

std::vector<Traffic> traffic_of(const TrafficCounts& c, double substeps) {
  const double per_substep = 1 / substeps;
  // All that a sub-step, or a whole step, goes through once.
  const double sweep_set =
      kBlock * c.active + (kBody + kBefore) * c.grains + kBody * c.unmoved + kStepImpulse * c.wall_blocks + c.blocks;
  const double step_set =
      sweep_set + kDisc * c.grains + kBlock * std::max(0.0, c.detected - c.active) + kWake * c.blocks;
  std::vector<Traffic> parts;

  // Of a block, the impulses are written; of a body, motion, drift and the velocities before: advance() moves them all. A
  // tile's bodies are fetched once for all its blocks; for a contact between tiles its two groups of bodies are
  // fetched again, each a line of motions, written, and a line of drifts, read.
  parts.push_back({"sweeps",
                   (kBlock - 2 * kRow) * c.active + (kBody - kMotion) * c.unmoved + c.blocks + kLine * c.crossing_groups,
                   2 * kRow * c.active + (kBody + kBefore) * c.grains + kMotion * c.unmoved + kStepImpulse * c.wall_blocks +
                       kLine * c.crossing_groups,
                   0, sweep_set});

  // Once per step. Indices, mass and impulses are read, normals and gaps written; blocks between tiles fetch discs (two
  // lines), motions and velocity changes of their bodies again.
  const double crossing_groups = c.crossing > 0 ? c.crossing_groups * c.detected_crossing / c.crossing : 0;
  Traffic detection{"contact detection",
                    3 * kRow * c.detected + 2 * kRow * c.active + kWake * c.blocks + (kDisc + kMotion) * c.grains +
                        3 * kLine * crossing_groups,
                    kBefore * c.grains + kLine * crossing_groups, 3 * kRow * c.detected, step_set};
  // Places move on; the lift is summed; contacts with an impulse are counted.
  Traffic places{"places", (kBody + kBefore + sizeof(double)) * c.grains + kRow * c.active + c.blocks, kDisc * c.grains,
                 0, step_set};
  // The fastest grain is looked for by one thread.
  Traffic list{"neighbour list", kMotion * c.grains, 0, 0, step_set};
  for (Traffic* t : {&detection, &places, &list}) {
    t->read *= per_substep, t->update *= per_substep, t->write *= per_substep;
    parts.push_back(*t);
  }

  Traffic all{"step", 0, 0, 0, sweep_set};
  for (const Traffic& t : parts) all.read += t.read, all.update += t.update, all.write += t.write;
  parts.push_back(all);
  return parts;
}

Bound bound_of(const Traffic& traffic, int threads) {
  const auto bytes = static_cast<std::size_t>(traffic.working_set / threads);
  Bound bound;
  bound.read_speed = memory_speed(Access::read, bytes, threads);
  bound.update_speed = memory_speed(Access::update, bytes, threads);
  bound.write_speed = memory_speed(Access::write, bytes, threads);
  bound.time =
      traffic.read / bound.read_speed + traffic.update / bound.update_speed + traffic.write / bound.write_speed;
  return bound;
}

double second_level() {
#ifdef _SC_LEVEL2_CACHE_SIZE
  return static_cast<double>(std::max(0L, sysconf(_SC_LEVEL2_CACHE_SIZE)));
#else
  return 0;
#endif
}

}  // namespace seapile::bench
