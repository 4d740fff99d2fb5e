// What the thesis' dry runs cost: a bed of 11,596 grains, then the conical pile to 1.2 m, with the breakdown by part.
//
//   dry_runs [--speeds 0.4,0.2,0.06] [--substeps 10,20] [--threads 1] [--simd best] [--depth 1.2] > machine.csv
//
// One row per run. CPU seconds are of the whole process, all threads; `clock` is read off a chain of dependent
// multiplications just before the run (three cycles each on the processors of today), so that rows of different machines, or of one
// machine under load, can be compared by cycles. Work counters do not depend on the machine at all.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "solver/simulation/run.h"

using namespace seapile;
using namespace seapile::bench;
using namespace seapile::simulation;

namespace {

void row(const std::string& run, double substep, int threads, double simulated, const Cost& cost, double contact_substeps,
         double overlap, double mean_force, const std::vector<ProfileEntry>& profile) {
  std::map<std::string, double> seconds = seconds_of(profile);
  std::printf("%s,%g,%d,%.3f,%.2f,%.2f,%.2f,%.3g,%.2f,%.4f,%.0f", run.c_str(), substep, threads, simulated, cost.clock, cost.cpu,
              cost.wall, contact_substeps, cost.cpu * cost.clock * 1e9 / contact_substeps, overlap, mean_force);
  double parts = 0;
  for (const char* part : kParts) {
    std::printf(",%.2f", seconds[part]);
    parts += seconds[part];
  }
  std::printf(",%.2f\n", cost.wall - parts);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<double> speeds = {0.4, 0.2, 0.06};
  std::vector<int> substeps = {10};
  Execution execution;
  double depth = 1.2;
  std::string simd = "best";
  CLI::App app("Costs of the thesis' dry runs");
  app.add_option("--speeds", speeds, "of the pile [m/s]")->delimiter(',');
  app.add_option("--substeps", substeps, "per step of 5e-4 s")->delimiter(',');
  app.add_option("--threads", execution.threads, "of one run");
  app.add_option("--depth", depth, "to which the pile is driven [m]");
  app.add_option("--simd", simd, "best, generic, avx2 or avx512")->check(CLI::IsMember(kSimdWords));
  CLI11_PARSE(app, argc, argv);
  execution.simd = simd_named(simd);

  std::printf("run,substep[s],threads,simulated[s],clock[GHz],cpu[s],wall[s],contact_substeps,cycles_per_contact_substep,overlap_max,pile_force_mean[N/m]");
  for (const char* part : kParts) std::printf(",%s[s]", part);
  std::printf(",rest[s]\n");

  scene::SceneSpec scene;
  Bed bed;
  const Cost bed_cost = measured([&] { bed = prepare_bed(scene.bed, {}, execution, {}); });
  double bed_work = 0;
  for (const Record& r : bed.records) bed_work += contact_substeps(r, scene.contact);
  row("bed", scene.contact.step / static_cast<double>(scene.contact.substeps), execution.threads, bed.records.back().time, bed_cost,
      bed_work, metric(bed.metrics, "overlap_max"), 0, bed.profile);

  for (const int n : substeps)
    for (const double speed : speeds) {
      scene.pile.emplace();
      scene.pile->driving = pile::ConstantDriving{speed};
      scene.pile->depth = depth;
      scene.contact.substeps = n;
      RunResult result;
      double work = 0;
      RunHooks hooks;
      hooks.record = [&](const Record& r) { work += contact_substeps(r, scene.contact); };
      const Cost cost = measured([&] { result = run(scene, {}, bed, execution, {}, {}, hooks); });
      char name[40];
      std::snprintf(name, sizeof name, "conical %g m/s", speed);
      row(name, scene.contact.step / n, execution.threads, result.time, cost, work, metric(result.metrics, "overlap_max"),
          metric(result.metrics, "pile_force_mean"), result.profile);
    }
}
