// What a step of the water costs: a pile comes down into a box of water on a moving mesh, with the breakdown by part.
//
//   fluid_step [--vertices 1950] [--steps 1000] [--dt 1e-4] [--tolerance 1e-8] [--tip conical] [--water]
//   [--instructions best]
//
// One row per number of vertices, CSV. Milliseconds per step are of all steps, the moving of the mesh and what is
// remembered included, but not the porosity, which has a formula here. Those of the parts are wall time, `rest` is what
// is left of it. `velocity_difference` is the largest difference of a velocity, by the pile's, after 20 steps, from a
// run that factorises in every step and iterates to rounding.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "bench/pile_box.h"
#include "solver/fluid/advance.h"

using namespace seapile;
using namespace seapile::bench;

namespace {

constexpr int kCheckedSteps = 20;
constexpr double kDirectTolerance = 1e-13;
constexpr const char* kFluidParts[] = {"fluid packing", "fluid residual", "fluid solve", "fluid factor"};

struct Options {
  std::vector<int> vertices = {1950};
  int steps = 1000;
  double dt = 1e-4, tolerance = 1e-8;
  std::string tip = "conical", instructions = "best", mesh_file;
  bool water = false;
};

struct Stepped {
  fluid::Flow flow;
  base::Profile profile;
  double cpu = 0, wall = 0;
  std::int64_t iterations = 0, refactorisations = 0;
  int most_iterations = 0;
  double residual = 0;
};

base::InstructionSet instructions_of(const std::string& word) {
  using base::InstructionSet;
  return word == "generic"  ? InstructionSet::generic
         : word == "avx2"   ? InstructionSet::avx2
         : word == "avx512" ? InstructionSet::avx512
                            : base::fastest();
}

/// Steps from rest. `direct`: with the factors of each step's own Jacobian.
Stepped stepped(const PileBox& box, const mesh::TriangleMesh& mesh, const Options& options, int steps, bool direct) {
  Stepped run{flow_of(box, mesh), {}};
  fluid::FlowSolver solver;
  solver.tolerance = direct ? kDirectTolerance : options.tolerance;
  solver.instructions = instructions_of(options.instructions);
  fluid::Past past;
  const std::vector<double> share = shares(box, mesh);
  // At rest before: what is held moves from now on.
  fluid::Flow before = run.flow;
  std::ranges::fill(before.unknown, 0.0);
  remember(past, before, options.dt);
  for (int n = 1; n <= steps; ++n) {
    double cpu = cpu_seconds(), wall = wall_seconds();
    const auto pause = [&] { run.cpu += cpu_seconds() - cpu, run.wall += wall_seconds() - wall; };
    move(mesh, share, n * options.dt * box.speed, run.flow.mesh);
    pause();
    fill_bed(box, run.flow);
    cpu = cpu_seconds(), wall = wall_seconds();
    set_rates(run.flow, past, solver.order);
    if (direct) solver.factor_rate = -1;
    const fluid::FlowReport report = advance(run.flow, past, solver, run.profile);
    if (!report.converged) throw std::runtime_error("step " + std::to_string(n) + ": " + report.reason);
    remember(past, run.flow, options.dt);
    pause();
    run.iterations += report.iterations;
    run.most_iterations = std::max(run.most_iterations, report.iterations);
    run.residual = report.residual;
  }
  run.refactorisations = solver.refactorisations;
  return run;
}

/// By the pile's speed.
double velocity_difference(const fluid::Flow& a, const fluid::Flow& b, double speed) {
  double largest = 0;
  for (std::size_t i = 0; i < a.unknown.size(); ++i)
    if (i % 3 != fluid::kPressure) largest = std::max(largest, std::abs(a.unknown[i] - b.unknown[i]) / speed);
  return largest;
}

void row(const PileBox& box, const Options& options, int vertices) {
  const mesh::TriangleMesh mesh = mesh_of(box, vertices);
  if (!options.mesh_file.empty()) write_mesh(mesh, options.mesh_file);
  const int checked = std::min(kCheckedSteps, options.steps);
  const double difference = velocity_difference(stepped(box, mesh, options, checked, false).flow,
                                                stepped(box, mesh, options, checked, true).flow, box.speed);
  const double clock = clock_rate();
  const Stepped run = stepped(box, mesh, options, options.steps, false);
  const BoxState state = state_of(box, run.flow);

  const double per_step = 1e3 / options.steps;
  std::printf("%s,%s,%zu,%zu,%d,%g,%g,%.2f,%.4f,%.4f", box.bed ? "bed" : "water", options.tip.c_str(), mesh.vertices(),
              mesh.triangles(), options.steps, options.dt, options.tolerance, clock, per_step * run.cpu,
              per_step * run.wall);
  double parts = 0;
  std::map<std::string, double> seconds;
  for (const base::Profile::Entry& e : run.profile.entries()) seconds[e.part] = e.seconds;
  for (const char* part : kFluidParts) {
    std::printf(",%.4f", per_step * seconds[part]);
    parts += seconds[part];
  }
  std::printf(",%.4f,%.3f,%d,%lld,%.2e,%.2e,%.6f,%.5g,%.5g,%.1e,%.4f\n", per_step * (run.wall - parts),
              static_cast<double>(run.iterations) / options.steps, run.most_iterations,
              static_cast<long long>(run.refactorisations), run.residual, difference, state.outflow,
              state.kinetic_energy, state.far_energy, state.tip_error, state.largest_speed);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Cost of a step of the water, on a moving mesh");
  app.add_option("--vertices", options.vertices, "about so many; some numbers with commas")
      ->delimiter(',')
      ->check(CLI::Range(200, 1'000'000));
  app.add_option("--steps", options.steps)->check(CLI::Range(1, 1'000'000));
  app.add_option("--dt", options.dt, "[s]")->check(CLI::Range(1e-7, 0.1));
  app.add_option("--tolerance", options.tolerance, "of the residual [-]")->check(CLI::Range(1e-13, 1e-2));
  app.add_option("--tip", options.tip, "conical or flat")->check(CLI::IsMember({"conical", "flat"}));
  app.add_flag("--water", options.water, "water alone: no porosity, no drag");
  app.add_option("--instructions", options.instructions, "best, generic, avx2 or avx512")
      ->check(CLI::IsMember(kSimdWords));
  app.add_option("--mesh", options.mesh_file, "file for the mesh, in FreeFEM's format");
  CLI11_PARSE(app, argc, argv);

  PileBox box;
  box.bed = !options.water;
  if (options.tip == "flat") box.cone = 0;
  try {
    if (!base::available(instructions_of(options.instructions)))
      throw std::runtime_error("this processor has no " + options.instructions);
    if (options.steps * options.dt * box.speed > 2) throw std::runtime_error("the pile would move by more than 2 m");
    std::printf("case,tip,vertices,triangles,steps,dt[s],tolerance,clock[GHz],cpu_per_step[ms],wall_per_step[ms]");
    for (const char* part : kFluidParts) std::printf(",%s[ms]", part);
    std::printf(
        ",rest[ms],iterations,most_iterations,refactorisations,residual,velocity_difference,outflow,"
        "kinetic_energy[J/m],far_energy[J/m],tip_error,largest_speed\n");
    for (const int vertices : options.vertices) row(box, options, vertices);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fluid_step: %s\n", error.what());
    return 2;
  }
}
