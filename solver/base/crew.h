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
  /// Waits until all of so many threads have come, and looks so many times before it lies down; true when it did.
  bool wait(int threads, int looks) {
    const unsigned round = round_.load(std::memory_order_relaxed);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == threads) {
      arrived_.store(0, std::memory_order_relaxed);
      round_.store(round + 1, std::memory_order_release);
      // Who is asleep is asked after the new round is seen by all: a thread that lies down between would sleep on.
      std::atomic_thread_fence(std::memory_order_seq_cst);
      round_.notify_all();
      return false;
    }
    for (int look = 0; look < looks; ++look)
      if (round_.load(std::memory_order_acquire) != round) return false;
    round_.wait(round, std::memory_order_acquire);
    return true;
  }

 private:
  alignas(64) std::atomic<int> arrived_ = 0;
  alignas(64) std::atomic<unsigned> round_ = 0;
};

/// Threads from the start of a run to its end; between two jobs they wait for the next.
///
/// On a machine that others use, a meeting waits for the system to let the other thread run, which takes longer than
/// the work. A crew that has met this works the next jobs with its first thread alone, each time twice as many; a job
/// together that goes well halves that number.
class Crew {
 public:
  static constexpr int kLooks = 300'000;           ///< within a job: a few tenths of a millisecond
  static constexpr int kLooksForAJob = 5'000'000;  ///< longer than what one thread does between two jobs

  explicit Crew(int threads, int looks = kLooks, int looks_for_a_job = kLooksForAJob)
      : threads_(threads), looks_(looks), looks_for_a_job_(looks_for_a_job) {
    for (int me = 1; me < threads; ++me) others_.emplace_back([this, me] { serve(me); });
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  ~Crew() {
    job_ = nullptr;
    meeting_.wait(threads_, looks_);
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
    meeting_.wait(threads_, looks_);  // to wake the others is not to wait for them in the work
    work(0, threads_);
    meet(0);
    patience_ = late_ ? std::min(2 * patience_, kLongest) : std::max(patience_ / 2, kShortest);
    alone_ = late_ ? patience_ : 0;
  }

  /// Within a job: waits for the others.
  void meet(int me) {
    const bool lay_down = meeting_.wait(threads_, looks_);
    if (me == 0) late_ = late_ || lay_down;
  }

 private:
  static constexpr std::int64_t kShortest = 2, kLongest = 1 << 14;  // jobs; the longest are some seconds

  void serve(int me) {
    for (;;) {
      meeting_.wait(threads_, looks_for_a_job_);
      if (job_ == nullptr) return;
      call_(job_, me, threads_);
      meeting_.wait(threads_, looks_for_a_job_);
    }
  }

  int threads_, looks_, looks_for_a_job_;
  Meeting meeting_;
  const void* job_ = nullptr;
  void (*call_)(const void*, int, int) noexcept = nullptr;
  bool late_ = false;                      ///< the first thread lay down in this job
  std::int64_t patience_ = kShortest, alone_ = 0;  ///< jobs
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
