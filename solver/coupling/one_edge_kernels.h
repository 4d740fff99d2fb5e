// A disc's share at each vertex where it crosses one edge or none: five of six discs.
//
// As in by_kinks.h, of a disc that reaches the lines of none of the other edges of its centre's triangle and of the
// neighbour beyond the nearest edge. Whether it reaches the nearest is as good as random, and which that is: all discs
// go the same way, without a branch, several side by side.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "solver/coupling/edges.h"
#include "solver/grains/grains.h"

namespace seapile::coupling {

/// Rows of some discs. They are of four entries, also where the last is 0, but for discs whose nearest edge is the
/// boundary's: loops over rows are faster when these are of one length.
struct OneEdge {
  static constexpr int kDiscs = 16;
  std::array<int, kDiscs> entries;  ///< that count; 0 when the disc is none of these
  std::array<std::array<std::int32_t, 4>, kDiscs> vertex;
  std::array<std::array<double, 4>, kDiscs> volume;  ///< [m2]
};

/// Of 1 to kDiscs discs. `last`: a triangle that may hold each, or -1; where it does not, off its edges, there are no
/// entries. The same bits with all instruction sets, and whichever discs are beside each other.
using OneEdgeKernel = void (*)(const Edge* edges, std::span<const grains::Disc> discs, const std::int32_t* last,
                               OneEdge& result);

extern const OneEdgeKernel kOneEdgeKernel_generic, kOneEdgeKernel_avx2, kOneEdgeKernel_avx512;

}  // namespace seapile::coupling
