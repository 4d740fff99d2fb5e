// What every contact method does around its solve: lists that hold all contacts of the step, a thread's share of the
// blocks, places at the end, and what the walls have felt.
#pragma once

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <span>
#include <vector>

#include "solver/base/profile.h"
#include "solver/grains/contact_kernels.h"
#include "solver/grains/contact_lists.h"
#include "solver/grains/contact_solver.h"

namespace seapile::grains {

/// How far gaps may close within the coming step.
struct Closing {
  double body_speed = 0;  ///< of the rigid body [m/s]
  double margin = 0;      ///< what does not come from the bodies' own velocities [m]
  double reach = 0;       ///< any gap, at three times the largest speed of both bodies, along both axes [m]
  double likely = 0;      ///< any gap, at the largest speed of both bodies [m]
};
template <class Real>
Closing expected_closing(const ContactSystem<Real>& system, const Grains& grains, const ContactLaw& law,
                         const RigidBody* body, std::span<const double> body_path);

/// Makes the lists anew where they might miss a contact of the coming step, and places the points of the walls. True
/// when the neighbour list was made anew.
template <class Real>
bool keep_lists(ContactSystem<Real>& system, Grains& grains, const Box& box, RigidBody* body, const Closing& closing,
                double step, int threads);

/// Adds the path of a step, drift + h v, to the places of a tile's grains; sets the tile's longest squared path.
template <class Real>
void move_places(ContactSystem<Real>& system, Grains& grains, std::int32_t tile, double h);

/// Moves a body by its path in the step.
void move_body(RigidBody& body);

/// Adds the step's impulses to the walls' totals and says how far grains went.
template <class Real>
void close_step(ContactSystem<Real>& system, ContactTotals& totals, ContactReport& report);

/// Acceleration of a free body but for its contacts.
base::Vec2 body_push(const RigidBody& body, const ContactLaw& law);

/// The impulse that a body's contacts keep from the solve before.
base::Vec2 kept_impulse(const RigidBody& body);

/// Adds the impulses of blocks [first, last) to those of the step, or begins these afresh.
template <class Real>
void keep_step_impulses(ContactBlocks<Real>& blocks, std::int32_t first, std::int32_t last, bool afresh);

/// Contacts of blocks [first, last) with an impulse.
template <class Real>
std::int64_t touching_in(const ContactBlocks<Real>& blocks, std::int32_t first, std::int32_t last) {
  std::int64_t touching = 0;
  for (std::int32_t b = first; b < last; ++b)
    if (blocks.active[b])
      for (int lane = 0; lane < kLanes; ++lane) touching += blocks.block[b].pn[lane] > 0;
  return touching;
}

/// Chunks of the contacts between tiles of one colour.
template <class Real>
std::int32_t chunk_count(const ContactBlocks<Real>& blocks, std::int32_t colour) {
  const Colour& c = blocks.colour[colour];
  return (c.first_wall - c.first + kBlocksPerChunk - 1) / kBlocksPerChunk;
}

/// Where the threads of a team wait for each other, some tens of thousands of times per second: each wait is a few
/// microseconds of work away from the next, so a thread looks for a while before it asks the system to be woken.
class Meeting {
 public:
  explicit Meeting(int looks = 20'000) : looks_(looks) {}

  /// Waits until all of so many threads have come.
  void wait(int threads) {
    const unsigned round = round_.load(std::memory_order_relaxed);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == threads) {
      arrived_.store(0, std::memory_order_relaxed);
      round_.store(round + 1, std::memory_order_release);
      // Who is asleep is asked after the new round is seen by all: a thread that lies down between would sleep on.
      std::atomic_thread_fence(std::memory_order_seq_cst);
      round_.notify_all();
      return;
    }
    for (int look = 0; look < looks_; ++look)
      if (round_.load(std::memory_order_acquire) != round) return;
    round_.wait(round, std::memory_order_acquire);
  }

 private:
  int looks_;
  alignas(64) std::atomic<int> arrived_ = 0;
  alignas(64) std::atomic<unsigned> round_ = 0;
};

/// What one thread of a team works on: whole tiles, so that they stay in its cache, and the contacts between tiles that
/// begin in them.
template <class Real>
class Share {
 public:
  Share(const ContactBlocks<Real>& blocks, std::size_t grain_count, Meeting& meeting)
      : blocks_(blocks), meeting_(meeting), me_(omp_get_thread_num()), all_(omp_get_num_threads()), groups_(first_point(grain_count) / 4) {
    // Tiles are weighed by their blocks, which stay from one list to the next: a tile that changed hands at every step
    // would be fetched anew at every step.
    const std::int32_t tiles = tile_count(grain_count);
    std::vector<std::int64_t> end(tiles);
    for (std::int32_t tile = 0; tile < tiles; ++tile)
      end[tile] = (tile > 0 ? end[tile - 1] : 0) + 8 + first_block(tile + 1) - first_block(tile);
    const auto first_of = [&](int thread) {
      const std::int64_t share = end.back() * thread / all_;
      std::int32_t tile = 0;
      while (tile < tiles && (tile > 0 ? end[tile - 1] : 0) + end[tile] < 2 * share) ++tile;
      return thread == all_ ? tiles : tile;
    };
    first_tile = first_of(me_);
    last_tile = first_of(me_ + 1);
  }

  std::int32_t first_tile = 0, last_tile = 0;

  bool leads() const { return me_ == 0; }

  /// Waits for the others.
  void meet() const {
    if (all_ > 1) meeting_.wait(all_);
  }

  /// First group of four bodies of a tile; the end of the last one's.
  std::int32_t first_group(std::int32_t tile) const { return std::min(tile * (kTileGrains / 4), groups_); }

  /// First block of a tile's own contacts; of the contacts between tiles when `tile` is the number of tiles.
  std::int32_t first_block(std::int32_t tile) const {
    const std::int32_t colour = blocks_.tile_colour[tile];
    return colour < static_cast<std::int32_t>(blocks_.colour.size()) ? blocks_.colour[colour].first
                                                                     : static_cast<std::int32_t>(blocks_.block.size());
  }

  /// Calls work(chunk, first block, last block) for this thread's part of a colour between tiles.
  void between(std::int32_t colour, auto&& work) const {
    const Colour& c = blocks_.colour[colour];
    for (std::int32_t k = 0; k < chunk_count(blocks_, colour); ++k) {
      const std::int32_t first = c.first + k * kBlocksPerChunk;
      const std::int32_t tile = body_at(blocks_.block[first].i[0]) / kTileGrains;
      if (first_tile <= tile && tile < last_tile) work(k, first, std::min(first + kBlocksPerChunk, c.first_wall));
    }
  }

 private:
  const ContactBlocks<Real>& blocks_;
  Meeting& meeting_;
  int me_, all_;
  std::int32_t groups_;
};

/// Detection, by one thread of a team: clears the velocity changes of its grains and calls refresh(first, last) for its
/// blocks, colour by colour where they share grains with others'.
template <class Real>
void detect(const Share<Real>& share, ContactSystem<Real>& system, std::size_t grain_count, auto&& refresh) {
  const ContactBlocks<Real>& blocks = system.blocks;
  for (std::int32_t tile = share.first_tile; tile < share.last_tile; ++tile) {
    for (std::int32_t i = 4 * share.first_group(tile); i < 4 * share.first_group(tile + 1); ++i)
      system.before[i] = {0, 0, 0, system.before[i].half_mass};
    refresh(share.first_block(tile), share.first_block(tile + 1));
  }
  share.meet();
  const auto colours = static_cast<std::int32_t>(blocks.colour.size());
  for (std::int32_t colour = blocks.tile_colour[tile_count(grain_count)]; colour < colours; ++colour) {
    share.between(colour, [&](std::int32_t, std::int32_t first, std::int32_t last) { refresh(first, last); });
    share.meet();
  }
}

/// Adds the seconds since the last lap to a part; only the first thread of a team measures.
class Laps {
 public:
  Laps(base::Profile& profile, bool measures) : profile_(profile), measures_(measures) {
    if (measures_) last_ = Clock::now();
  }
  void lap(std::size_t part) {
    if (!measures_) return;
    const auto now = Clock::now();
    profile_.add(part, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  base::Profile& profile_;
  bool measures_;
  Clock::time_point last_;
};

}  // namespace seapile::grains
