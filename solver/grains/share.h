// What one thread of a team works on, and where it waits for the others.
#pragma once

#include <omp.h>

#include <array>
#include <atomic>
#include <bit>
#include <chrono>

#include "solver/base/profile.h"
#include "solver/grains/regions.h"

namespace seapile::grains {

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

/// The regions of the calling thread of a team. Threads are divided among the two halves of a region until each has one
/// of its own; a region that holds several threads' own is done by the first of them. Numbers of threads that are powers of two have
/// equal shares.
class Share {
 public:
  explicit Share(const Regions& regions) : me_(omp_get_thread_num()), threads_(omp_get_num_threads()) {
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
void for_tiles(const Regions& regions, int threads, auto&& work) {
#pragma omp parallel num_threads(threads) if (threads > 1)
  {
    const Share share(regions);
    for (std::int32_t tile = share.first_tile; tile < share.last_tile; ++tile) work(tile);
  }
}

/// Calls work(region) for all regions, in no order, each on the thread that has it during a step.
void for_regions(const Regions& regions, int threads, auto&& work) {
#pragma omp parallel num_threads(threads) if (threads > 1)
  Share(regions).each(work);
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

/// A thread of a team during a step. Its parts of the profile are those of the first thread.
class Worker : public Share {
 public:
  Worker(const Regions& regions, Meeting& meeting, base::Profile& profile, std::size_t waiting)
      : Share(regions), meeting_(meeting), laps_(profile), waiting_(waiting) {}

  /// The time up to now went into a part.
  void lap(std::size_t part) {
    if (leads()) laps_.lap(part);
  }

  /// Waits for the others.
  void meet(std::size_t part) {
    lap(part);
    if (threads_ == 1) return;
    meeting_.wait(threads_);
    lap(waiting_);
  }

  /// Calls work(region) for this thread's regions, each after all that it holds, whoever does those. Does not wait for the
  /// end: the first thread goes on while the others' work inside their own regions is done.
  void climb(std::size_t part, auto&& work) {
    for (std::int32_t region = first_; region < last_; ++region) work(region);
    for (int level = levels_ - 1; level >= 0; --level) {
      meet(part);
      if (shared_[level] >= 0) work(shared_[level]);
    }
    lap(part);
  }

 private:
  Meeting& meeting_;
  Laps laps_;
  std::size_t waiting_;
};

}  // namespace seapile::grains
