// What the machine's memory gives: bandwidth against the size of the working set, and a cache line between two cores.
//
//   bandwidth [--threads 1,2] [--sizes 32,64,...,524288] [--repeat 7] [--huge] > bandwidth.csv
//
// One row per threads, kind of access and size: `bytes` of each thread's own array, GB/s of all threads together. An
// `update` counts each line once although it moves twice. The last row is the time of a handover in ns
// (memory_speed.h).
#include <CLI/CLI.hpp>

#include <cstdio>
#include <thread>
#include <vector>

#include "bench/memory_speed.h"

using namespace seapile::bench;

int main(int argc, char** argv) {
  std::vector<int> threads = {1, 2};
  std::vector<std::size_t> kilobytes;
  for (std::size_t size = 32; size <= 512 * 1024; size *= 2) kilobytes.push_back(size);
  int repeat = 7;
  bool huge = false;
  CLI::App app("Memory bandwidth by working set, and the time of a handover between two cores");
  app.add_option("--threads", threads, "at once")->delimiter(',')->check(CLI::Range(1, 1024));
  app.add_option("--sizes", kilobytes, "of each thread's array [KB]")->delimiter(',');
  app.add_option("--repeat", repeat, "measurements, of which the median is told")->check(CLI::Range(1, 1000));
  app.add_flag("--huge", huge, "with pages of 2 MB");
  CLI11_PARSE(app, argc, argv);

  std::printf("access,threads,bytes,speed[GB/s],handover[ns]\n");
  for (const int count : threads)
    for (const Access access : kAccesses)
      for (const std::size_t size : kilobytes) {
        std::printf("%s,%d,%zu,%.2f,\n", name_of(access), count, 1024 * size,
                    memory_speed(access, 1024 * size, count, repeat, huge));
        std::fflush(stdout);
      }
  if (std::thread::hardware_concurrency() > 1) std::printf("handover,2,64,,%.1f\n", handover_time());
}
