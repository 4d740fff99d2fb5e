#include "runner/execute/provenance.h"

#include <fmt/format.h>
#include <gnu/libc-version.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>

#include "runner/execute/build_info.h"

namespace seapile::execute {
namespace {

const auto process_start = std::chrono::steady_clock::now();

/// The processor's model, without its clock: a machine's identity must survive a reboot.
std::string cpu_model() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// `who`: RUSAGE_SELF, or RUSAGE_CHILDREN for those that have ended, in which meshes are made.
rusage usage(int who) {
  rusage used = {};
  ::getrusage(who, &used);
  return used;
}

}  // namespace

store::Provenance provenance() {
  store::Provenance made;
  made.version = kVersion;
  made.commit = kCommit;
  made.dirty = kDirty;
  made.compiler = kCompiler;
  made.flags = kFlags;
  made.build_type = kBuildType;
  made.libraries = fmt::format("{}, glibc {}", kLibraries, gnu_get_libc_version());
  made.host_cpu = cpu_model();
  made.cores = usable_cores();
  return made;
}

std::string version_line() {
  return fmt::format("{} (commit {}{})", kVersion, std::string(kCommit).substr(0, 10), kDirty ? ", with changes" : "");
}

Cost cost_so_far() {
  double cpu = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    const rusage used = usage(who);
    cpu += seconds(used.ru_utime) + seconds(used.ru_stime);
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - process_start;
  return {cpu, wall.count()};
}

double peak_memory_mb() {
  return static_cast<double>(std::max(usage(RUSAGE_SELF).ru_maxrss, usage(RUSAGE_CHILDREN).ru_maxrss)) / 1024;
}

double available_memory_mb() {
  std::ifstream meminfo("/proc/meminfo");
  std::string name, unit;
  for (double kib = 0; meminfo >> name >> kib; std::getline(meminfo, unit)) {
    if (name == "MemAvailable:") return kib * 1024 / 1e6;
  }
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

int usable_cores() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (::sched_getaffinity(0, sizeof allowed, &allowed) != 0) return 1;
  return std::max(1, CPU_COUNT(&allowed));
}

}  // namespace seapile::execute
