// Contacts in blocks of sixteen.
//
// The contacts of one colour share no moving body, so the sixteen contacts of a block are solved at once. Colours are given
// within each region of the bed (regions.h): a tile of neighbours that fits the nearest cache, or the contacts across the cut
// between two halves. A region belongs to one thread. Which thread does what never changes a bit.
//
// Blocks live from one rebuild of the neighbour list to the next; only normal, gap and impulses change in between. A
// block has sixteen lanes on every machine: narrower registers take it in pieces, with the same operations per lane.
//
// Every body has an index: [0, grains) the grains, then, from the next multiple of four on (a vector register holds
// whole rows of four bodies, and only grains fall), one unmoved point per wall contact (the foot of the grain on the
// wall, so that a wall contact is a contact of two discs like any other, the second of radius 0), then one unmoved filler
// for each empty lane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/base/aligned.h"

namespace seapile::grains {

inline constexpr int kLanes = 16;

/// Index of the first body that is no grain.
inline std::int32_t first_point(std::size_t grain_count) { return static_cast<std::int32_t>((grain_count + 3) / 4 * 4); }

/// Sixteen contacts. Normal n from i to j, tangent t = (-ny, nx).
template <class Real>
struct alignas(64) ContactBlock {
  std::int32_t i[kLanes];  ///< place_of() the first body
  std::int32_t j[kLanes];  ///< place_of() the second body
  Real nx[kLanes];         ///< normal [-]
  Real ny[kLanes];
  Real gap[kLanes];        ///< at the start of the step [m]; negative: overlap
  Real mass[kLanes];       ///< 1/(1/m_i + 1/m_j) [kg/m]; 0 in an empty lane
  Real pn[kLanes];         ///< normal impulse of the last sub-step [N s/m], >= 0
  Real pt[kLanes];         ///< tangential impulse [N s/m], |pt| <= mu pn
};

/// What the non-smooth method keeps of a block within a step.
template <class Real>
struct alignas(64) Iterate {
  Real bias[kLanes] = {};    ///< v_n + bias >= 0 is asked of each contact [m/s]
  Real old_pn[kLanes] = {};  ///< impulses one sweep ago [N s/m]
  Real old_pt[kLanes] = {};
};

/// Impulses of a block's contacts, summed over the sub-steps of a step.
struct alignas(64) StepImpulse {
  double normal[kLanes] = {};      ///< [N s/m]
  double tangential[kLanes] = {};  ///< [N s/m]
};

/// Which wall a grain touches.
enum class Wall : std::int32_t { left = 0, right = 1, base = 2 };

/// One colour: blocks [first, last), of which [first_wall, last) hold wall contacts.
struct Colour {
  std::int32_t first = 0, first_wall = 0, last = 0;
};

/// All contacts but those of the pile.
template <class Real>
struct ContactBlocks {
  base::AlignedVector<ContactBlock<Real>> block;
  std::vector<Colour> colour;              ///< of the regions one after the other
  std::vector<std::int32_t> region_colour; ///< first colour of each region, and the end: (regions + 1)
  std::vector<std::uint8_t> active;        ///< (blocks): some contact may touch during this step
  std::vector<double> wake;                ///< (blocks): the closing at which a resting block is looked at again [m]
  std::int32_t bodies = 0;           ///< grains, gap, wall points, fillers

  // Wall contacts, in the order of their points: body index of point k is first_point() + k.
  std::vector<std::int32_t> wall_grain;     ///< (wall contacts)
  std::vector<Wall> wall;                   ///< (wall contacts)
  std::vector<std::int32_t> wall_slot;      ///< (wall contacts): block * kLanes + lane

  /// Impulses of the last step; kept for wall blocks always, for the others when integrate() was asked to. (blocks)
  std::vector<StepImpulse> step_impulse;
};

}  // namespace seapile::grains
