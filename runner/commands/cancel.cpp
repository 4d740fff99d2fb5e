#include <fmt/format.h>

#include <algorithm>

#include "runner/cluster/job_states.h"
#include "runner/cluster/slurm.h"
#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"

namespace seapile::commands {
namespace {

/// Cancels the jobs of a study that were submitted from this store and are still there, and no other.
int cancel(const std::string& root, const std::string& study) {
  std::vector<std::string> live;
  std::size_t tasks = 0;
  for (const cluster::Submission& submission : cluster::read_submissions(root, study)) {
    for (const std::string& job : submission.jobs()) {
      const auto known = cluster::job_tasks(job);
      const auto count = static_cast<std::size_t>(std::ranges::count_if(known, cluster::is_live));
      if (count == 0) continue;
      live.push_back(job);
      if (job != submission.ingest) tasks += count;
    }
  }
  if (live.empty()) {
    fmt::print(stderr, "no job of {} waits or runs\n", study);
    return execute::kNothingMatched;
  }
  cluster::cancel_jobs(live);
  fmt::print(stderr,
             "cancelled {} task{} of {}, jobs {}\n"
             "What was completed before is in the store; `runner reindex` lists it.\n",
             tasks, tasks == 1 ? "" : "s", study, fmt::join(live, ", "));
  return execute::kDone;
}

}  // namespace

void add_cancel(CLI::App& app, Call& call) {
  static std::string study, root = "results";
  CLI::App* command = app.add_subcommand("cancel", "Take a study's jobs out of the batch system");
  command->add_option("STUDY", study, "Name or file of a study")->required();
  add_store_option(*command, root);
  command->footer(
      "A case that runs seals a checkpoint first, where it has time to; `runner submit` or `runner run` continues "
      "it.\n\n"
      "Example:\n  runner cancel velocity");
  command->callback([&call] { call = [] { return cancel(root, study_name(study)); }; });
}

}  // namespace seapile::commands
