// What one thread of a crew works on, and where it waits for the others.
#pragma once

#include <array>
#include <bit>
#include <chrono>

#include "solver/base/crew.h"
#include "solver/base/profile.h"
#include "solver/grains/regions.h"

namespace seapile::grains {

/// The regions of one thread of a crew. Threads are divided among the two halves of a region until each has one
/// of its own; a region that holds several threads' own is done by the first of them. Numbers of threads that are
/// powers of two have equal shares.
class Share {
 public:
  Share(const Regions& regions, int me, int threads) : me_(me), threads_(threads) {
    shared_.fill(-1);
    levels_ = std::bit_width(static_cast<unsigned>(threads_ - 1));
    if (regions.count() == 0) return;
    std::int32_t region = regions.count() - 1;
    int first = 0, last = threads_;
    for (int level = 0; last - first > 1 && regions[region].first_half >= 0; ++level) {
      if (me_ == first) shared_[level] = region;
      const int middle = (first + last) / 2;
      region = me_ < middle ? regions[region].first_half : regions.second_half(region);
      (me_ < middle ? last : first) = middle;
    }
    if (me_ != first) return;  // more threads than regions
    first_tile = regions[region].first_tile;
    last_tile = regions[region].last_tile;
    first_ = regions.first_inside(region);
    last_ = region + 1;
  }

  std::int32_t first_tile = 0, last_tile = 0;  ///< its own

  bool leads() const { return me_ == 0; }

  /// Calls work(region) for all regions that are this thread's to do.
  void each(auto&& work) const {
    for (std::int32_t region = first_; region < last_; ++region) work(region);
    for (int level = levels_ - 1; level >= 0; --level)
      if (shared_[level] >= 0) work(shared_[level]);
  }

 protected:
  int me_, threads_, levels_ = 0;
  std::int32_t first_ = 0, last_ = 0;    ///< own regions
  std::array<std::int32_t, 32> shared_;  ///< by level, 0 the whole bed: the region that is this thread's to do, or -1
};

/// Calls work(tile) for all tiles, each on the thread that has it during a step.
void for_tiles(const Regions& regions, base::Crew* crew, auto&& work) {
  base::together(crew, [&](int me, int threads) {
    const Share share(regions, me, threads);
    for (std::int32_t tile = share.first_tile; tile < share.last_tile; ++tile) work(tile);
  });
}

/// Calls work(region) for all regions, in no order, each on the thread that has it during a step.
void for_regions(const Regions& regions, base::Crew* crew, auto&& work) {
  base::together(crew, [&](int me, int threads) { Share(regions, me, threads).each(work); });
}

/// Adds the seconds since the last lap to a part of the profile.
class Laps {
 public:
  explicit Laps(base::Profile& profile) : profile_(profile), last_(Clock::now()) {}
  void lap(std::size_t part) {
    const auto now = Clock::now();
    profile_.add(part, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  base::Profile& profile_;
  Clock::time_point last_;
};

/// A thread of a crew during a step. The profile is that of the first thread.
class Worker : public Share {
 public:
  Worker(const Regions& regions, base::Crew* crew, int me, int threads, base::Profile& profile, std::size_t waiting)
      : Share(regions, me, threads), crew_(crew), laps_(profile), waiting_(waiting) {}

  /// The time up to now went into a part.
  void lap(std::size_t part) {
    if (leads()) laps_.lap(part);
  }

  /// Waits for the others.
  void meet(std::size_t part) {
    lap(part);
    if (threads_ == 1) return;
    crew_->meet(me_);
    lap(waiting_);
  }

  /// Calls work(region) for this thread's regions, each after all that it holds, whoever does those. Does not wait for
  /// the end: the first thread goes on while the others' work inside their own regions is done.
  void climb(std::size_t part, auto&& work) {
    for (std::int32_t region = first_; region < last_; ++region) work(region);
    for (int level = levels_ - 1; level >= 0; --level) {
      meet(part);
      if (shared_[level] >= 0) work(shared_[level]);
    }
    lap(part);
  }

 private:
  base::Crew* crew_;
  Laps laps_;
  std::size_t waiting_;
};

}  // namespace seapile::grains
