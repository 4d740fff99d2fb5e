// What every contact method does around its solve: lists that hold all contacts of the step, detection, places at the
// end, and what the walls have felt.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "solver/grains/contact_kernels.h"
#include "solver/grains/contact_lists.h"
#include "solver/grains/contact_solver.h"
#include "solver/grains/share.h"

namespace seapile::grains {

/// How far gaps may close within the coming step.
struct Closing {
  double pull = 0;        ///< gravity and the largest push together [m/s2]
  double body_speed = 0;  ///< of the rigid body [m/s]
  double margin = 0;      ///< what does not come from the bodies' own velocities [m]
  double reach = 0;       ///< any gap, at three times the largest speed of both bodies, along both axes [m]
  double likely = 0;      ///< any gap, at the largest speed of both bodies [m]
};
template <class Real>
Closing expected_closing(ContactSystem<Real>& system, const Grains& grains, const ContactLaw& law,
                         const RigidBody* body, std::span<const double> body_path, base::Crew* crew);

/// Makes the lists anew where they might miss a contact of the coming step, and places the points of the walls. True
/// when the neighbour list was made anew.
template <class Real>
bool keep_lists(ContactSystem<Real>& system, Grains& grains, const Box& box, RigidBody* body, const Closing& closing,
                double step, base::Crew* crew);

/// Adds the path of a step, drift + h v, to the places of a tile's grains; sets the tile's longest squared path.
template <class Real>
void move_places(ContactSystem<Real>& system, Grains& grains, std::int32_t tile, double h);

/// Makes room for the push of this step's grains; where the kernels find it, null for grains without.
template <class Real>
const Push<Real>* hold_push(ContactSystem<Real>& system, const Grains& grains);

/// Start of a step: puts the push of a tile's grains where the kernels find it.
template <class Real>
void lay_out_push(ContactSystem<Real>& system, const Grains& grains, std::int32_t tile);

/// End of a step, while the motions are those of its last sub-step: sums what the push of a tile's grains has done.
template <class Real>
void sum_push(ContactSystem<Real>& system, const Grains& grains, const ContactLaw& law, std::int32_t tile);

/// Moves a body by its path in the step.
void move_body(RigidBody& body);

/// Adds the step's impulses to the walls' totals and says how far grains went.
template <class Real>
void close_step(ContactSystem<Real>& system, ContactTotals& totals, ContactReport& report);

/// Acceleration of a free body but for its contacts.
base::Vec2 body_push(const RigidBody& body, const ContactLaw& law);

/// The impulse that a body's contacts keep from the solve before.
base::Vec2 kept_impulse(const RigidBody& body);

/// Blocks [first, last) of a region.
struct BlockRange {
  std::int32_t first, last;
};
template <class Real>
BlockRange blocks_of(const ContactBlocks<Real>& blocks, std::int32_t region) {
  const auto first_of = [&](std::int32_t colour) {
    return colour < static_cast<std::int32_t>(blocks.colour.size()) ? blocks.colour[colour].first
                                                                    : static_cast<std::int32_t>(blocks.block.size());
  };
  return {first_of(blocks.region_colour[region]), first_of(blocks.region_colour[region + 1])};
}

/// Adds the impulses of blocks [first, last) to those of the step, or begins these afresh.
template <class Real>
void keep_step_impulses(ContactBlocks<Real>& blocks, std::int32_t first, std::int32_t last, bool afresh);

/// Contacts with an impulse in a region's blocks.
template <class Real>
std::int64_t touching_in(const ContactBlocks<Real>& blocks, std::int32_t region) {
  std::int64_t touching = 0;
  const BlockRange range = blocks_of(blocks, region);
  for (std::int32_t b = range.first; b < range.last; ++b) {
    int in_block = 0;
    for (int lane = 0; lane < kLanes; ++lane) in_block += blocks.block[b].pn[lane] > 0 ? 1 : 0;
    touching += blocks.active[b] ? in_block : 0;
  }
  return touching;
}

/// Detection, by one thread of a crew: clears the velocity changes of its grains and calls refresh(first, last) for the
/// blocks of its regions.
template <class Real>
void detect(Worker& worker, std::size_t part, ContactSystem<Real>& system, auto&& refresh) {
  worker.climb(part, [&](std::int32_t region) {
    const Region& r = system.regions[region];
    if (r.is_tile())
      for (std::int32_t i = 4 * system.regions.first_group(r.first_tile);
           i < 4 * system.regions.first_group(r.last_tile); ++i)
        system.before[i] = {0, 0, 0, system.before[i].half_mass};
    const BlockRange blocks = blocks_of(system.blocks, region);
    refresh(blocks.first, blocks.last);
  });
}

}  // namespace seapile::grains
