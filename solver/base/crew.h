// Threads that work on a step together, and where they wait for each other.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace seapile::base {

/// Where threads meet, some tens of thousands of times per second: each wait is a few microseconds of work away from
/// the next, so a thread looks for a while before it asks the system to be woken. To be woken takes far longer than
/// that.
class Meeting {
 public:
  static constexpr int kLooks = 300'000;  ///< a few tenths of a millisecond

  explicit Meeting(int looks = kLooks) : looks_(looks) {}

  /// Waits until all of so many threads have come. True when it had to lie down.
  bool wait(int threads) {
    const unsigned round = round_.load(std::memory_order_relaxed);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == threads) {
      arrived_.store(0, std::memory_order_relaxed);
      round_.store(round + 1, std::memory_order_release);
      // Who is asleep is asked after the new round is seen by all: a thread that lies down between would sleep on.
      std::atomic_thread_fence(std::memory_order_seq_cst);
      round_.notify_all();
      return false;
    }
    for (int look = 0; look < looks_; ++look)
      if (round_.load(std::memory_order_acquire) != round) return false;
    round_.wait(round, std::memory_order_acquire);
    return true;
  }

 private:
  int looks_;
  alignas(64) std::atomic<int> arrived_ = 0;
  alignas(64) std::atomic<unsigned> round_ = 0;
};

/// Threads from the start of a run to its end; between two jobs they wait for the next.
///
/// On a machine that others use, a meeting waits for the system to let the other thread run, which takes longer than
/// the work. A crew that has met this works the next jobs with its first thread alone, twice as many each time in a
/// row.
class Crew {
 public:
  explicit Crew(int threads, int looks = Meeting::kLooks) : threads_(threads), meeting_(looks) {
    for (int me = 1; me < threads; ++me) others_.emplace_back([this, me] { serve(me); });
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  ~Crew() {
    job_ = nullptr;
    meeting_.wait(threads_);
  }

  /// Calls work(me, threads) on each of so many threads, me = 0 on this one, and returns when all are done. All or one.
  template <class Work>
  void run(const Work& work) noexcept {
    if (alone_ > 0) {
      --alone_;
      work(0, 1);
      return;
    }
    job_ = &work;
    call_ = [](const void* job, int me, int threads) noexcept { (*static_cast<const Work*>(job))(me, threads); };
    late_ = false;
    meeting_.wait(threads_);
    work(0, threads_);
    meet(0);
    patience_ = late_ ? std::min(2 * patience_, kLongest) : 1;
    alone_ = late_ ? patience_ : 0;
  }

  /// Within a job: waits for the others.
  void meet(int me) {
    const bool lay_down = meeting_.wait(threads_);
    if (me == 0) late_ = late_ || lay_down;
  }

 private:
  static constexpr std::int64_t kLongest = 1 << 14;  // jobs, some seconds

  void serve(int me) {
    for (;;) {
      meeting_.wait(threads_);
      if (job_ == nullptr) return;
      call_(job_, me, threads_);
      meeting_.wait(threads_);
    }
  }

  int threads_;
  Meeting meeting_;
  const void* job_ = nullptr;
  void (*call_)(const void*, int, int) noexcept = nullptr;
  bool late_ = false;                      ///< the first thread lay down in this job
  std::int64_t patience_ = 1, alone_ = 0;  ///< jobs
  std::vector<std::jthread> others_;
};

/// Calls work(me, threads) on all threads of a crew; without one, work(0, 1).
template <class Work>
void together(Crew* crew, const Work& work) {
  if (crew != nullptr)
    crew->run(work);
  else
    work(0, 1);
}

}  // namespace seapile::base
