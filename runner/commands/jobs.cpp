#include <fmt/format.h>

#include "runner/cluster/job_states.h"
#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/plan.h"
#include "runner/present/table.h"

namespace seapile::commands {
namespace {

struct JobsArguments {
  std::string study, root = "results";
  present::Format format = present::Format::table;
};

store::Table table_of(const std::vector<cluster::JobState>& states) {
  store::Table table;
  table.columns = {"study", "case", "kind", "name", "job", "state", "done", "restarts", "detail"};
  table.units = {"", "", "", "", "", "", "%", "", ""};
  for (const cluster::JobState& state : states) {
    const store::Cell done = state.fraction ? store::Cell{100 * *state.fraction} : store::Cell{};
    table.rows.push_back({state.study, execute::short_id(state.case_id), state.kind, state.name, state.job,
                          std::string(cluster::word(state.state)), done, static_cast<double>(state.restarts),
                          state.detail});
  }
  return table;
}

int jobs(const JobsArguments& arguments) {
  const std::string study = study_name(arguments.study);
  const std::vector<cluster::JobState> states = cluster::job_states(arguments.root, study);
  if (states.empty()) {
    fmt::print(stderr, "nothing of {} was submitted from this store\n", study.empty() ? "any study" : study);
    return execute::kNothingMatched;
  }
  fmt::print("{}", present::text(table_of(states), arguments.format));
  return execute::kDone;
}

}  // namespace

void add_jobs(CLI::App& app, Call& call) {
  static JobsArguments arguments;
  CLI::App* command = app.add_subcommand("jobs", "List what was submitted to a batch system, and what became of it");
  command->add_option("STUDY", arguments.study, "Name or file of a study; default: every one that was submitted");
  add_format_option(*command, arguments.format);
  add_store_option(*command, arguments.root);
  command->footer(
      "A case is queued, running, requeued (waits to go on from its checkpoint), done, diverged, failed, not run (its\n"
      "bed could not be had), timed out, over memory, killed, stopped, cancelled, or lost.\n\n"
      "Examples:\n"
      "  runner jobs velocity\n"
      "  runner jobs --format csv");
  command->callback([&call] { call = [] { return jobs(arguments); }; });
}

}  // namespace seapile::commands
