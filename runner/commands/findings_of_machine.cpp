#include <fmt/format.h>

#include "runner/cluster/scheduler.h"
#include "runner/commands/findings.h"
#include "runner/execute/provenance.h"
#include "runner/execute/trial.h"
#include "runner/present/gnuplot.h"

namespace seapile::commands {
namespace {

constexpr double kLittleMemory = 1000;  // [MB] what a run of 6,000 grains with water stays well below

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

Finding gnuplot() {
  const std::string version = present::gnuplot_version();
  if (!version.empty()) return {Health::ok, "program", "gnuplot", version};
  return {Health::note, "program", "gnuplot", "does not answer; figures and pictures of curves cannot be drawn"};
}

Finding mesher() {
  const execute::MesherTrial trial = execute::trial_of_mesher();
  if (trial.trouble.empty())
    return {Health::ok, "program", "mesher", fmt::format("meshed a unit square by {} triangles", trial.triangles)};
  return {Health::problem, "program", "mesher",
          trial.trouble + "; scenes with water cannot be run. An installation is moved as a whole"};
}

Finding memory() {
  const double free = execute::available_memory_mb();
  const Health health = free < kLittleMemory ? Health::note : Health::ok;
  return {health, "machine", "memory", fmt::format("{:.1f} GB can be had without swapping", free / 1000)};
}

Finding slurm() {
  try {
    const cluster::Answer answer = cluster::ask("scontrol", {"ping"});
    if (answer.exit_code == 0) return {Health::ok, "cluster", "Slurm", first_line(answer.out)};
    const std::string complaint = cluster::complaint("scontrol", answer);  // the cause stands last
    const auto before_last = complaint.rfind("; ");
    return {Health::note, "cluster", "Slurm",
            "no controller answers, and submit would be refused: " +
                (before_last == std::string::npos ? complaint : complaint.substr(before_last + 2))};
  } catch (const cluster::SchedulerError&) {
    return {Health::note, "cluster", "Slurm", "is not here; studies run on this machine alone"};
  }
}

}  // namespace

std::vector<Finding> findings_of_machine() {
  const store::Provenance made = execute::provenance();
  const bool for_users = made.build_type == "Release";
  std::vector<Finding> findings;
  findings.push_back({Health::ok, "program", "version", execute::version_line()});
  findings.push_back(
      {for_users ? Health::ok : Health::note, "program", "build",
       fmt::format("{}, {}{}", made.build_type, made.compiler,
                   for_users ? "" : "; the release build is faster, and is what results are compared with")});
  findings.push_back({Health::ok, "program", "libraries", made.libraries});
  findings.push_back(mesher());
  findings.push_back(gnuplot());
  findings.push_back(
      {Health::ok, "machine", "processor", fmt::format("{}, {} cores for us", made.host_cpu, made.cores)});
  findings.push_back(memory());
  findings.push_back(slurm());
  return findings;
}

}  // namespace seapile::commands
