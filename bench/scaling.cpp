// What a step costs against the number of grains and threads, and how much of it is memory that moves.
//
//   scaling [--grains 10000,100000] [--threads 1,2] [--repeat 3] [--traffic traffic.csv] > scaling.csv
//
// For each number of grains: a bed in a box of the thesis' shape, settled by the product's rule, and the thesis' pile
// driven into it; from that state, the same drive over a fixed simulated time with each number of threads, in turn,
// several times; and with as many drives at once, each on one thread, which tells what the machine's cores give when
// they do not wait for each other. One row of each kind, medians. What the ratios say goes to the standard error, the
// bytes to the traffic file.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <vector>

#include "bench/scaling_case.h"
#include "bench/traffic.h"

using namespace seapile;
using namespace seapile::bench;

namespace {

/// Drives at once, and threads of each.
struct Kind {
  int at_once, threads;
  friend auto operator<=>(const Kind&, const Kind&) = default;
};

void row(const ScalingState& start, Kind kind, const std::vector<ScalingRun>& runs, double memory) {
  ScalingRun r = median_of(runs);
  double shortest = r.cost.wall, longest = r.cost.wall, parts = 0;
  for (const ScalingRun& run : runs)
    shortest = std::min(shortest, run.cost.wall), longest = std::max(longest, run.cost.wall);
  const auto grains = static_cast<double>(start.scene.bed.grains.count);
  std::printf("%.0f,%d,%d,%zu,%.2f,%.3f,%.3f,%.3f,%.3f,%.0f,%.4g,%.3f,%.3f,%.0f,%.1f", grains, kind.threads,
              kind.at_once, runs.size(), r.cost.clock, r.cost.cpu, r.cost.wall, shortest, longest, r.substeps,
              r.contact_substeps, 1e9 * r.cost.cpu / r.contact_substeps, 1e9 * r.cost.cpu / (r.substeps * grains), r.rebuilds,
              memory * 1e-6);
  for (const char* part : kParts) {
    std::printf(",%.3f", r.seconds[part]);
    parts += r.seconds[part];
  }
  std::printf(",%.3f\n", r.cost.wall - parts);
  std::fflush(stdout);
}

/// What is measured: each number of threads, and each above one as so many drives at once.
std::vector<Kind> kinds_of(const ScalingOptions& options) {
  std::vector<Kind> kinds;
  for (const int threads : options.threads) kinds.push_back({1, threads});
  for (const int threads : options.threads)
    if (threads > 1) kinds.push_back({threads, 1});
  return kinds;
}

/// Each kind in turn, again and again: a disturbance by neighbours hits all of them alike.
std::map<Kind, std::vector<ScalingRun>> run_all(const ScalingState& start, const ScalingOptions& options,
                                                std::map<Kind, double>& memory) {
  std::map<Kind, std::vector<ScalingRun>> runs;
  std::optional<std::uint64_t> hash;
  for (int k = 0; k < options.repeat; ++k)
    for (const Kind& kind : kinds_of(options)) {
      forget_peak_memory();
      runs[kind].push_back(run_at_once(start, options, kind.at_once, kind.threads));
      memory[kind] = std::max(memory[kind], peak_memory());
      if (hash.value_or(runs[kind].back().state_hash) != runs[kind].back().state_hash)
        throw std::runtime_error("two runs of the same case differ");
      hash = runs[kind].back().state_hash;
    }
  return runs;
}

/// The speed-up of threads, and that of as many drives at once: pair by pair, medians.
void tell_speed_up(double grains, int few, int threads, const std::map<Kind, std::vector<ScalingRun>>& runs) {
  const auto ratios = [&](const Kind& kind, double drives) {
    std::vector<double> of;
    for (std::size_t k = 0; k < runs.at(kind).size(); ++k)
      of.push_back(drives * runs.at({1, few})[k].cost.wall / runs.at(kind)[k].cost.wall);
    return median(of);
  };
  std::fprintf(stderr, "%.0f grains: wall time with %d threads over %d threads: %.2f", grains, few, threads,
               ratios({1, threads}, 1));
  if (few == 1 && threads > 1)
    std::fprintf(stderr, "; %d drives at once, each on one thread, in the time of one: %.2f", threads,
                 ratios({threads, 1}, threads));
  std::fprintf(stderr, "\n");
}

void traffic_rows(std::ofstream& file, const ScalingState& start, const ScalingOptions& options,
                  const std::map<int, ScalingRun>& medians) {
  const TrafficCounts counts = count_traffic(start, options);
  std::fprintf(
      stderr,
      "%.0f grains: %.0f blocks, %.0f of them active, %.0f of these between tiles (%.1f groups of bodies each), %.0f "
      "detected per step, %.0f bodies that do not move, %.0f blocks at walls\n",
      counts.grains, counts.blocks, counts.active, counts.crossing,
      counts.crossing > 0 ? counts.crossing_groups / counts.crossing : 0, counts.detected, counts.unmoved,
      counts.wall_blocks);
  for (const auto& [threads, run] : medians)
    for (const Traffic& t : traffic_of(counts, static_cast<double>(start.scene.contact.substeps))) {
      const Bound bound = bound_of(t, threads);
      // What neighbours took from the threads is left out; on a quiet machine that is nothing.
      const double had = std::min(1.0, run.cost.cpu / (threads * run.cost.wall));
      const double seconds = t.part == "step" ? run.cost.wall : run.seconds.at(t.part);
      const double measured_time = 1e9 * had * seconds / run.substeps;
      const double set = t.working_set / threads, level = second_level();
      char line[400];
      std::snprintf(line, sizeof line, "%.0f,%d,%s,%.0f,%.0f,%.0f,%.0f,%.0f,%.0f,%.2f,%.2f,%.2f,%.0f,%.0f,%.3f\n",
                    counts.grains, threads, t.part.c_str(), t.read, t.update, t.write, set, t.total(),
                    set > level ? t.total() : 0, bound.read_speed, bound.update_speed, bound.write_speed, bound.time,
                    measured_time, bound.time / measured_time);
      file << line << std::flush;
    }
}

}  // namespace

int main(int argc, char** argv) {
  ScalingOptions options;
  std::string traffic_file, simd = "best";
  CLI::App app("Cost of a step against grains and threads");
  app.add_option("--grains", options.grains, "in the bed")->delimiter(',')->check(CLI::Range(100, 10'000'000));
  app.add_option("--threads", options.threads, "of one run")->delimiter(',')->check(CLI::Range(1, 1024));
  app.add_option("--repeat", options.repeat, "runs of each kind, of which the median is told")
      ->check(CLI::Range(1, 1000));
  app.add_option("--speed", options.speed, "of the pile [m/s]");
  app.add_option("--depth", options.depth, "of the pile when the measured runs start [m]");
  app.add_option("--time", options.time, "simulated by each measured run [s]");
  app.add_option("--simd", simd, "best, generic, avx2 or avx512")->check(CLI::IsMember(kSimdWords));
  app.add_option("--traffic", traffic_file, "CSV file of the bytes that a sub-step moves; absent: not looked at");
  CLI11_PARSE(app, argc, argv);
  options.simd = simd_named(simd);

  std::ofstream traffic;
  if (!traffic_file.empty()) {
    traffic.open(traffic_file);
    traffic << "grains,threads,part,read[B],update[B],write[B],working_set[B],beyond_level_1[B],beyond_level_2[B],"
               "read_speed[GB/s],update_speed[GB/s],write_speed[GB/s],at_bandwidth[ns],measured[ns],share\n";
  }
  std::printf(
      "grains,threads,at_once,runs,clock[GHz],cpu[s],wall[s],wall_min[s],wall_max[s],substeps,contact_substeps,"
      "cpu_per_contact_substep[ns],cpu_per_grain_substep[ns],lists,peak_memory[MB]");
  for (const char* part : kParts) std::printf(",%s[s]", part);
  std::printf(",rest[s]\n");

  double least_grains = 0, least_cost = 0;  // of the first number of grains, by the first number of threads
  for (const std::int64_t grains : options.grains) {
    const ScalingState start = prepare(grains, options, options.threads.front());
    std::fprintf(stderr, "%lld grains: settled in %.2f s, which took %.1f CPU s; pile to %.2f m: %.1f CPU s\n",
                 static_cast<long long>(grains), start.bed.records.back().time, start.settling.cpu,
                 start.records.back().depth, start.driving.cpu);
    std::map<Kind, double> memory;
    const auto runs = run_all(start, options, memory);
    std::map<int, ScalingRun> medians;
    for (const Kind& kind : kinds_of(options)) {
      row(start, kind, runs.at(kind), memory[kind]);
      if (kind.at_once == 1) medians[kind.threads] = median_of(runs.at(kind));
    }

    const int few = options.threads.front();
    for (const int threads : options.threads)
      if (threads != few) tell_speed_up(static_cast<double>(grains), few, threads, runs);
    const double cost = medians[few].cost.cpu / medians[few].substeps;
    if (least_cost > 0)
      std::fprintf(stderr, "cost of %lld grains over %.0f grains, same steps, %d threads: %.2f\n",
                   static_cast<long long>(grains), least_grains, few, cost / least_cost);
    else
      least_grains = static_cast<double>(grains), least_cost = cost;
    if (traffic.is_open()) traffic_rows(traffic, start, options, medians);
  }
}
