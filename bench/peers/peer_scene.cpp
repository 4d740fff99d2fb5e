// Our side of a comparison with other codes: the state from which all start, our own runs from it, and the overlaps of
// anybody's grains.
//
//   peer_scene ours --out DIR [--seed 1] [--solid-fraction 0.82] [--tip conical] [--speed 0.4]
//                   [--start 0.55] [--from 0.6] [--end 0.8] [--substeps 5,10,20,40] [--sweeps 100,200] [--moments 25]
//                   [--grains 11596] [--nonsmooth-step 1e-4]
//   peer_scene overlaps --state DIR/state.json --dt DT DUMP
//
// `ours` prepares the bed, drives the pile to the depth `start`, writes DIR/state.data, pile.stl and state.json, drives
// on to `end` once for each number of sub-steps, and by the non-smooth method once for each number of sweeps,
// and writes DIR/ours.csv with a row per run and a series of the pile's force beside it. CPU seconds are the process's,
// from the first record after the state to the last, without what the analysis of overlaps takes. Overlaps are those of
// the depths from `from` on, by the same function for every code.
#include <fmt/format.h>
#include <fmt/os.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/peers/overlaps.h"
#include "bench/peers/peer_files.h"
#include "bench/scaling_case.h"
#include "solver/pile/pile.h"
#include "solver/simulation/run.h"

using namespace seapile;
using namespace seapile::simulation;

namespace {

constexpr std::int64_t kStateSubsteps = 10;  // with which the bed is made and the pile driven to the state

struct Options {
  std::filesystem::path out;
  std::uint64_t seed = 1;
  std::optional<double> solid_fraction;
  std::string tip = "conical";
  double speed = 0.4, start = 0.55, from = 0.6, end = 0.8;
  std::vector<std::int64_t> substeps = {5, 10, 20, 40};
  std::vector<std::int64_t> sweeps;  ///< of the non-smooth method
  double nonsmooth_step = 1e-4;      ///< [s], the thesis'
  std::int64_t grains = scene::SceneSpec{}.bed.grains.count;
  int moments = 25;
};

struct Stopwatch {
  double cpu = 0, wall = 0;
  static Stopwatch now() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return {static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec),
            std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count()};
  }
  Stopwatch operator-(const Stopwatch& o) const { return {cpu - o.cpu, wall - o.wall}; }
  Stopwatch operator+(const Stopwatch& o) const { return {cpu + o.cpu, wall + o.wall}; }
};

double pile_force(const Record& r) { return r.tip_force_y + r.sleeve_force_y; }

std::vector<base::Segment> outline(const scene::SceneSpec& scene, const Options& options) {
  // Higher than the bed is ever heaved, and below the top of the box at the start.
  return pile::outline(*scene.pile, options.end + 0.5);
}

peers::Surroundings surroundings(const scene::DomainSpec& domain, std::vector<base::Segment> outline, double pile_y) {
  return {-domain.width / 2, domain.width / 2, 0, std::move(outline), 0, pile_y};
}

scene::SceneSpec scene_of(const Options& options) {
  scene::SceneSpec scene = bench::scaled_scene(options.grains, options.speed);
  scene.bed.seed = options.seed;
  scene.bed.preparation.solid_fraction = options.solid_fraction;
  if (options.tip == "flat") scene.pile->tip = pile::FlatTip{};
  scene.pile->depth = options.end;
  scene.contact.substeps = kStateSubsteps;
  return scene;
}

/// The state at the depth `start`, and how deep it lies.
struct Start {
  std::vector<Array> checkpoint;
  Record record;
};
Start drive_to_start(const scene::SceneSpec& scene, const Bed& bed, const Options& options) {
  Start start;
  RunHooks hooks;
  hooks.record = [&](const Record& r) { start.record = r; };
  hooks.stop = [&] { return start.record.depth >= options.start; };  // asked after each step
  hooks.checkpoint = [&](const std::vector<Array>& state) { start.checkpoint = state; };
  const RunResult result = run(scene, {}, bed, {1, Simd::best, {1}}, {}, {}, hooks);
  if (result.outcome != Outcome::stopped) throw std::runtime_error("the state was not reached: " + result.reason);
  return start;
}

/// The state for a run of another step, sub-step or method: impulses of a solve are forces times its length, and time
/// is counted in steps.
std::vector<Array> continued(std::vector<Array> checkpoint, const grains::ContactSpec& contact) {
  const grains::ContactSpec state;
  const bool soft = std::holds_alternative<grains::SoftMethod>(contact.method);
  const double solve = contact.step / static_cast<double>(soft ? contact.substeps : 1);
  const double factor = solve / (state.step / static_cast<double>(kStateSubsteps));
  for (Array& array : checkpoint) {
    if (array.info.name == "clock/step") {
      auto& steps = std::get<std::vector<std::int64_t>>(array.values)[0];
      steps = std::llround(static_cast<double>(steps) * state.step / contact.step);
    }
    if (array.info.name == "blocks/impulse" || array.info.name == "pile/impulse")
      std::visit(
          [&](auto& held) {
            for (auto& v : held) v = static_cast<std::decay_t<decltype(v)>>(static_cast<double>(v) * factor);
          },
          array.values);
  }
  return checkpoint;
}

/// One run of ours from the state on.
struct Ours {
  std::vector<Record> records;
  Stopwatch cost;
  double simulated = 0;  ///< [s] that the cost is for
  std::vector<peers::Overlaps> moments;
  double recorded_p999 = 0;  ///< mean of the records' own 99.9th percentile, for comparison
  double residual = 0;       ///< rms over the records [m/s]
  RunResult result;
};
Ours drive_on(const scene::SceneSpec& scene, const Bed& bed, const Start& start, const Options& options) {
  Ours ours;
  Stopwatch begin, end, analysed, paused;
  RunHooks hooks;
  int due = 0;
  const double spacing = (options.end - options.from) / options.moments;
  // Records are held back until their steps are accepted; progress is told with each.
  bool first = true;
  hooks.record = [&](const Record& r) { ours.records.push_back(r); };
  hooks.progress = [&](const Progress&) {
    end = Stopwatch::now() - analysed;
    if (std::exchange(first, false)) begin = end;
  };
  hooks.checkpoint_due = [&] {
    if (due >= options.moments || ours.records.empty() || ours.records.back().depth < options.from + due * spacing)
      return false;
    ++due;
    paused = Stopwatch::now();
    return true;
  };
  hooks.checkpoint = [&](const std::vector<Array>& checkpoint) {
    const peers::State state = peers::state_of(checkpoint, scene.contact.precision);
    ours.moments.push_back(
        peers::overlaps(state.discs, surroundings(scene.bed.domain, outline(scene, options), state.pile_y)));
    analysed = analysed + (Stopwatch::now() - paused);
  };
  ours.result =
      run(scene, {}, bed, {}, continued(start.checkpoint, scene.contact), RecordsSoFar{{start.record}, {}}, hooks);
  if (ours.result.outcome != Outcome::completed) throw std::runtime_error(ours.result.reason);
  ours.cost = end - begin;
  ours.simulated = ours.records.back().time - ours.records.front().time;
  double count = 0;
  for (const Record& r : ours.records)
    if (r.depth >= options.from)
      ours.recorded_p999 += r.overlap_p999, ours.residual += r.residual * r.residual, ++count;
  ours.recorded_p999 /= count;
  ours.residual = std::sqrt(ours.residual / count);
  return ours;
}

void run_ours(const Options& options) {
  std::filesystem::create_directories(options.out);
  scene::SceneSpec scene = scene_of(options);
  const Bed bed = prepare_bed(scene.bed, {}, {}, {});
  const Start start = drive_to_start(scene, bed, options);

  peers::State state = peers::state_of(start.checkpoint, scene.contact.precision);
  state.surface = start.record.depth + state.pile_y;
  peers::write_data(options.out / "state.data", state, scene.bed);
  peers::write_stl(options.out / "pile.stl", state, outline(scene, options));
  double solid_fraction = 0;
  for (const Metric& m : bed.metrics)
    if (m.name == "solid_fraction") solid_fraction = m.value;
  peers::write_facts(options.out / "state.json", {{"seed", static_cast<double>(options.seed)},
                                                  {"solid_fraction", solid_fraction},
                                                  {"grains", static_cast<double>(state.discs.size())},
                                                  {"radius_min", scene.bed.grains.radius.min},
                                                  {"radius_max", scene.bed.grains.radius.max},
                                                  {"density", scene.bed.grains.density},
                                                  {"friction_grain", scene.bed.grains.friction.grain},
                                                  {"friction_wall", scene.bed.grains.friction.wall},
                                                  {"friction_pile", scene.pile->friction},
                                                  {"gravity", scene.bed.domain.gravity},
                                                  {"width", scene.bed.domain.width},
                                                  {"height", scene.bed.domain.height},
                                                  {"pile_radius", scene.pile->radius},
                                                  {"tip_height", pile::tip_height(*scene.pile)},
                                                  {"pile_length", options.end + 0.5},
                                                  {"pile_y", state.pile_y},
                                                  {"surface", state.surface},
                                                  {"kinetic_energy", start.record.kinetic_energy},
                                                  {"speed", options.speed},
                                                  {"start", start.record.depth},
                                                  {"from", options.from},
                                                  {"end", options.end}});

  auto table = fmt::output_file((options.out / "ours.csv").string());
  table.print(
      "method,solves,dt,simulated,steps,cpu,wall,overlap_p999,overlap_mean,overlap_max,contacts,recorded_p999,residual,"
      "kinetic_energy\n");
  // `solves`: sub-steps of a step, or sweeps of one.
  const auto drive = [&](const char* method, std::int64_t solves, double dt) {
    const Ours ours = drive_on(scene, bed, start, options);
    const peers::Overlaps o = peers::over_moments(ours.moments);
    table.print("{},{},{:g},{:.6g},{:.0f},{:.4f},{:.4f},{:.5g},{:.5g},{:.5g},{:.0f},{:.5g},{:.4g},{:.4g}\n", method,
                solves, dt, ours.simulated, ours.simulated / dt, ours.cost.cpu, ours.cost.wall, o.p999, o.mean, o.max,
                o.contacts, ours.recorded_p999, ours.residual, ours.records.back().kinetic_energy);
    table.flush();
    auto series = fmt::output_file((options.out / fmt::format("force_{}_{}.csv", method, solves)).string());
    series.print("depth,span,force\n");
    for (const Record& r : ours.records) series.print("{:.9g},{:.9g},{:.9g}\n", r.depth, r.span, pile_force(r));
  };
  for (const std::int64_t substeps : options.substeps) {
    scene.contact.substeps = substeps;
    drive("soft", substeps, scene.contact.step / static_cast<double>(substeps));
  }
  scene.contact = {};
  scene.contact.step = options.nonsmooth_step;
  for (const std::int64_t sweeps : options.sweeps) {
    scene.contact.method = grains::NonSmoothMethod{sweeps, 0};
    drive("nonsmooth", sweeps, options.nonsmooth_step);
  }
}

void print_overlaps(const std::filesystem::path& state, double dt, const std::string& path) {
  const auto read = [&](const char* name) { return peers::fact(state, name); };
  scene::DomainSpec domain;
  domain.width = read("width");
  pile::PileSpec pile;
  pile.radius = read("pile_radius");
  if (read("tip_height") > 0)
    pile.tip = pile::ConicalTip{2 * std::atan(pile.radius / read("tip_height"))};
  else
    pile.tip = pile::FlatTip{};
  const auto outline = pile::outline(pile, read("pile_length"));

  std::ifstream dump(path);
  if (!dump) throw std::runtime_error(path + " cannot be read");
  std::vector<peers::Overlaps> moments;
  const double pile_y = read("pile_y"), speed = read("speed"), start = read("start"), from = read("from");
  for (peers::Snapshot snapshot; peers::read_snapshot(dump, snapshot);) {
    const double travel = speed * static_cast<double>(snapshot.step) * dt;
    if (start + travel < from) continue;
    moments.push_back(peers::overlaps(snapshot.discs, surroundings(domain, outline, pile_y - travel)));
  }
  if (moments.empty()) throw std::runtime_error(path + " has no moment after the run-in");
  const peers::Overlaps o = peers::over_moments(moments);
  std::printf("moments,overlap_p999,overlap_mean,overlap_max,contacts\n%zu,%.5g,%.5g,%.5g,%.0f\n", moments.size(),
              o.p999, o.mean, o.max, o.contacts);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("The state that codes are compared from, our runs from it, and everybody's overlaps");
  app.require_subcommand(1);
  CLI::App* ours = app.add_subcommand("ours", "writes the state, and drives on from it");
  ours->add_option("--out", options.out, "folder for what is written")->required();
  ours->add_option("--seed", options.seed, "of the bed");
  ours->add_option("--solid-fraction", options.solid_fraction, "target of the bed's preparation [-]");
  ours->add_option("--tip", options.tip, "conical or flat")->check(CLI::IsMember({"conical", "flat"}));
  ours->add_option("--speed", options.speed, "of the pile [m/s]")->check(CLI::Range(1e-3, 10.0));
  ours->add_option("--start", options.start, "depth of the state [m]")->check(CLI::Range(0.01, 1.5));
  ours->add_option("--from", options.from, "depth from which forces and overlaps count [m]");
  ours->add_option("--end", options.end, "depth at the end [m]");
  ours->add_option("--substeps", options.substeps, "per step of 5e-4 s")->delimiter(',')->check(CLI::Range(1, 1000));
  ours->add_option("--sweeps", options.sweeps, "of the non-smooth method, per step")
      ->delimiter(',')
      ->check(CLI::Range(1, 100'000));
  ours->add_option("--nonsmooth-step", options.nonsmooth_step, "of the non-smooth method [s]")
      ->check(CLI::Range(1e-6, 1e-3));
  ours->add_option("--grains", options.grains, "in a box of the same shape; the pile stays as it is")
      ->check(CLI::Range(100, 10'000'000));
  ours->add_option("--moments", options.moments, "at which overlaps are taken")->check(CLI::Range(1, 1000));

  std::filesystem::path state;
  double dt = 0;
  std::string dump;
  CLI::App* measure = app.add_subcommand("overlaps", "of a LAMMPS or LIGGGHTS text dump \"id x y radius\"");
  measure->add_option("--state", state, "state.json of the run")->required();
  measure->add_option("--dt", dt, "time step of the dump's step numbers [s]")->required()->check(CLI::PositiveNumber);
  measure->add_option("dump", dump, "the dump")->required();
  try {
    app.parse(argc, argv);
    if (ours->parsed() && !(options.start < options.from && options.from < options.end && options.end < 1.5))
      throw CLI::ValidationError("--start, --from, --end", "must rise, and end below 1.5");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    if (ours->parsed())
      run_ours(options);
    else
      print_overlaps(state, dt, dump);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "peer_scene: %s\n", error.what());
    return 1;
  }
}
