#include "bench/memory_speed.h"

#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <ctime>
#include <new>
#include <numeric>
#include <thread>
#include <vector>

#include "bench/measure.h"
#include "solver/base/crew.h"

// One version per instruction set, chosen when the program starts: the build itself asks for none.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define SEAPILE_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define SEAPILE_CLONES
#endif

namespace seapile::bench {
namespace {

/// A cache line. Integers: no value is slower than another.
using Line = std::int64_t __attribute__((vector_size(64)));
constexpr std::size_t kUnroll = 32;
constexpr std::size_t kMinimumBytes = std::size_t{64} << 20;  // moved by one measurement, so that clocks do not matter
constexpr std::size_t kHugePage = std::size_t{2} << 20;

// What the compiler may not leave out: it believes that the memory is looked at.
inline void look_at(const void* p) { __asm__ volatile("" : : "r"(p) : "memory"); }

SEAPILE_CLONES void read_all(const Line* line, std::size_t count, long passes) {
  Line sum[8] = {};
  for (long pass = 0; pass < passes; ++pass) {
    look_at(line);
    for (std::size_t k = 0; k < count; k += kUnroll)
#pragma GCC unroll 32
      for (std::size_t u = 0; u < kUnroll; ++u) sum[u % 8] ^= line[k + u];
  }
  look_at(sum);
}

SEAPILE_CLONES void write_all(Line* line, std::size_t count, long passes) {
  for (long pass = 0; pass < passes; ++pass) {
    const Line value = Line{} + pass;
    for (std::size_t k = 0; k < count; k += kUnroll)
#pragma GCC unroll 32
      for (std::size_t u = 0; u < kUnroll; ++u) line[k + u] = value;
    look_at(line);
  }
}

SEAPILE_CLONES void update_all(Line* line, std::size_t count, long passes) {
  for (long pass = 0; pass < passes; ++pass) {
    for (std::size_t k = 0; k < count; k += kUnroll)
#pragma GCC unroll 32
      for (std::size_t u = 0; u < kUnroll; ++u) line[k + u] += 1;
    look_at(line);
  }
}

void move(Access access, Line* line, std::size_t count, long passes) {
  switch (access) {
    case Access::read:
      return read_all(line, count, passes);
    case Access::write:
      return write_all(line, count, passes);
    case Access::update:
      return update_all(line, count, passes);
  }
}

}  // namespace

const char* name_of(Access access) {
  return access == Access::read ? "read" : access == Access::write ? "write" : "update";
}

double memory_speed(Access access, std::size_t bytes, int threads, int repeat, bool huge) {
  const std::size_t block = kUnroll * sizeof(Line),
                    size = std::max<std::size_t>(1, (bytes + block - 1) / block) * block;
  const long passes = static_cast<long>(std::max<std::size_t>(1, kMinimumBytes / size));
  std::vector<double> own(threads), speed;
  base::Crew crew(threads);
  crew.run([&](int me, int) {
    // Each thread touches its array first, so that it lies with its core.
    const std::align_val_t alignment{kHugePage};
    void* memory = ::operator new(size + kHugePage, alignment);
    madvise(memory, size + kHugePage, huge ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
    Line* line = new (memory) Line[size / sizeof(Line)];
    move(Access::write, line, size / sizeof(Line), 1);
    move(access, line, size / sizeof(Line), 1);
    for (int k = 0; k < repeat; ++k) {
      crew.meet(me);
      const double start = thread_seconds();
      move(access, line, size / sizeof(Line), passes);
      own[me] = 1e-9 * static_cast<double>(size) * static_cast<double>(passes) / (thread_seconds() - start);
      crew.meet(me);
      if (me == 0) speed.push_back(std::accumulate(own.begin(), own.end(), 0.0));
    }
    ::operator delete(memory, alignment);
  });
  return median(speed);
}

double handover_time() {
  constexpr int kTrips = 1000, kRepeat = 101;
  alignas(64) std::atomic<int> turn = 0;
  std::thread other([&] {
    for (int k = 0; k < kTrips * kRepeat; ++k) {
      while (turn.load(std::memory_order_acquire) != 2 * k + 1) {
      }
      turn.store(2 * k + 2, std::memory_order_release);
    }
  });
  std::vector<double> times;
  for (int k = 0; k < kTrips * kRepeat; k += kTrips) {
    const double start = wall_seconds();
    for (int trip = k; trip < k + kTrips; ++trip) {
      turn.store(2 * trip + 1, std::memory_order_release);
      while (turn.load(std::memory_order_acquire) != 2 * trip + 2) {
      }
    }
    times.push_back(1e9 * (wall_seconds() - start) / (2 * kTrips));
  }
  other.join();
  return median(times);
}

}  // namespace seapile::bench
