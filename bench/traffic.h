// How many bytes a sub-step must move, counted from the blocks and bodies of a run, and how long that takes at the
// machine's measured bandwidth.
//
// A part of a step is described by the cache lines that it reads, updates (reads and writes back) and writes. Tiles
// keep their bodies in the nearest cache while they are swept, so a body counts once per sweep of its tile, and once
// more for every block between tiles that has it. Everything counted comes from beyond the nearest cache, because a
// whole step passes before it is needed again; where the working set is larger than the second level, it comes from
// beyond that too.
#pragma once

#include <string>
#include <vector>

#include "bench/scaling_case.h"

namespace seapile::bench {

/// Means over some steps of what the contact solver goes through.
struct TrafficCounts {
  double grains = 0, blocks = 0;
  double active = 0;           ///< blocks that are solved
  double crossing = 0;         ///< of them, those between tiles
  double crossing_groups = 0;  ///< groups of four bodies that these touch, summed over blocks
  double detected = 0;         ///< blocks whose normals and gaps are made anew
  double detected_crossing = 0;
  double unmoved = 0;      ///< bodies of active blocks that are no grains: wall points and fillers
  double wall_blocks = 0;  ///< blocks with wall contacts: their impulses are summed at every sub-step
  double rebuilds = 0;     ///< lists made in these steps
  double steps = 0;
};
TrafficCounts count_traffic(const ScalingState& start, const ScalingOptions& options, int steps = 40);

/// Bytes that a part moves, per sub-step.
struct Traffic {
  std::string part;                        ///< as in the profile; "step": all of them
  double read = 0, update = 0, write = 0;  ///< [B]
  double working_set = 0;                  ///< what goes by before the same byte is needed again [B]
  double total() const { return read + update + write; }
};
std::vector<Traffic> traffic_of(const TrafficCounts& counts, double substeps);

/// Time at the measured bandwidth for the working set, shared by so many threads [ns].
struct Bound {
  double read_speed = 0, update_speed = 0, write_speed = 0;  ///< of all threads together [B/ns]
  double time = 0;                                           ///< [ns]
};
Bound bound_of(const Traffic& traffic, int threads);

/// Bytes of the second level of the cache of one core; 0 when the system does not tell.
double second_level();

}  // namespace seapile::bench
