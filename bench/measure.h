// What every benchmark measures by: clocks, the parts of a run, work done.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "solver/scene/spec.h"
#include "solver/simulation/run.h"

namespace seapile::bench {

/// Of the whole process, all threads.
inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of the calling thread.
inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Cycles per nanosecond, from dependent integer multiplications: three cycles each on the processors of today.
inline double clock_rate() {
  constexpr long kCount = 100'000'000;
  const double start = thread_seconds();
  unsigned long product = 3;
  for (long k = 0; k < kCount; ++k) __asm__ volatile("imul %0,%0" : "+r"(product));
  return 3 * static_cast<double>(kCount) / (thread_seconds() - start) * 1e-9;
}

struct Cost {
  double clock, cpu, wall;
};
template <class Work>
Cost measured(Work&& work) {
  const double clock = clock_rate();
  const double cpu = cpu_seconds(), wall = wall_seconds();
  work();
  return {clock, cpu_seconds() - cpu, wall_seconds() - wall};
}

/// The middle one; of an even number the mean of the two in the middle.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// Parts of a run's profile, in the order of the columns.
inline constexpr const char* kParts[] = {"neighbour list",       "contact detection", "sweeps",
                                         "waiting",              "pile contacts",     "places"};

/// Seconds of each part.
inline std::map<std::string, double> seconds_of(const std::vector<simulation::ProfileEntry>& profile) {
  std::map<std::string, double> seconds;
  for (const simulation::ProfileEntry& e : profile) seconds[e.part] = e.seconds;
  return seconds;
}

/// Touching contacts times sub-steps: the work of a record, which no machine changes.
inline double contact_substeps(const simulation::Record& record, const grains::ContactSpec& contact) {
  return record.contacts * record.span / contact.step * static_cast<double>(contact.substeps);
}

inline double metric(const std::vector<simulation::Metric>& metrics, const std::string& name) {
  for (const simulation::Metric& m : metrics)
    if (m.name == name) return m.value;
  return 0;
}

/// Of an option's word.
inline simulation::Simd simd_named(const std::string& word) {
  using simulation::Simd;
  return word == "generic" ? Simd::generic : word == "avx2" ? Simd::avx2 : word == "avx512" ? Simd::avx512 : Simd::best;
}
inline const std::vector<std::string> kSimdWords = {"best", "generic", "avx2", "avx512"};

}  // namespace seapile::bench
