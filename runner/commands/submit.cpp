#include "runner/cluster/submit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runner/commands/command.h"
#include "runner/commands/edges.h"
#include "runner/commands/packings.h"
#include "runner/execute/campaign.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/history.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

struct SubmitArguments {
  std::string study, root = "results", engine = "slurm", engine_file;
  study::Options options;
  cluster::SubmitOptions submit;
  bool dry_run = false;
};

/// The site's wishes: from the file that is named, or from engines/NAME.json; "slurm" needs none.
cluster::Engine engine_of(const SubmitArguments& arguments) {
  if (!arguments.engine_file.empty()) return cluster::read_engine(arguments.engine_file);
  const fs::path file = fs::path("engines") / (arguments.engine + ".json");
  if (fs::exists(file) || arguments.engine != "slurm") return cluster::read_engine(file);
  return {};
}

/// Words for sbatch that would take apart what this command puts together.
void refuse_own_words(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    for (const std::string own : {"--array", "-a", "--dependency", "-d", "--wrap", "--hold", "-H", "--output", "-o"}) {
      const bool is_short = own.size() == 2;
      if (word != own && !word.starts_with(is_short ? own : own + "=")) continue;
      throw UsageError(fmt::format("{} cannot be given to sbatch: submit sets it itself", word));
    }
  }
}

/// The study as `run` would have it next: the packings that its rule has come to, the values of its edge to try. Absent
/// when no value is left to try.
std::optional<study::Study> next_round(const SubmitArguments& arguments) {
  study::Options options = arguments.options;
  study::Study study = read_settled(arguments.study, options, arguments.root);
  while (study.edge) {
    const auto searches = edge_searches(study, arguments.root);
    const auto untried = untried_probes(study, searches);
    options.probes = untried.empty() ? next_probes(study, searches) : untried;
    if (options.probes.empty()) return std::nullopt;
    study = study::read(arguments.study, options);
    if (!untried.empty()) return study;
  }
  return study;
}

std::string counted(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

int submit(SubmitArguments arguments) {
  cluster::SubmitOptions& options = arguments.submit;
  options.root = arguments.root;
  if (cluster::limit_seconds(options.resources.time) < 60)
    throw UsageError(fmt::format("--time {} is no time limit of at least a minute: MINUTES, HH:MM:SS or D-HH:MM:SS",
                                 options.resources.time));
  options.engine = engine_of(arguments);
  refuse_own_words(options.engine.sbatch);
  refuse_own_words(options.sbatch);

  const auto study = next_round(arguments);
  const auto disk = [&](const std::string& id) { return execute::read_history(options.root, id); };
  const auto equivalences = execute::declared_equivalences(options.root);
  const execute::Plan plan =
      study ? execute::make_plan(*study, execute::todays_numerics, disk, equivalences) : execute::Plan{};
  if (std::ranges::all_of(plan.tasks,
                          [](const auto& task) { return task.decision.action == execute::Action::fresh; })) {
    fmt::print(stderr, "nothing to submit: every case is fresh\n");
    return execute::kDone;
  }
  for (const std::string& line : execute::describe(plan)) fmt::print(stderr, "{}\n", line);
  const auto in_queue = cluster::cases_in_queue(options.root);
  const cluster::Layout layout = cluster::lay_out(*study, plan, in_queue, options);
  const auto waiting = std::ranges::count_if(plan.tasks, [&](const auto& task) {
    return task.decision.action != execute::Action::fresh && in_queue.contains(task.id);
  });
  if (waiting > 0) fmt::print(stderr, "{} in the queue already\n", counted(static_cast<std::size_t>(waiting), "case"));
  if (layout.arrays.empty()) {
    fmt::print(stderr, "nothing to submit: every case is fresh or in the queue\n");
    return execute::kDone;
  }
  for (const std::string& remark : layout.remarks) fmt::print(stderr, "{}\n", remark);
  if (arguments.dry_run) {
    for (const std::string& line : cluster::command_lines(*study, layout, options)) fmt::print("{}\n", line);
    return execute::kDone;
  }
  const cluster::Submission submission = cluster::submit(*study, plan, layout, options);
  fmt::print(stderr, "submitted {} in {}, and the job that ingests them\n", counted(submission.cases.size(), "case"),
             counted(submission.arrays.size(), "array"));
  if (study->edge || study->packing_rule)
    fmt::print(stderr, "This is one round of the study: give the command again once it is done.\n");
  for (const std::string& job : submission.jobs()) fmt::print("{}\n", job);
  return execute::kDone;
}

}  // namespace

void add_submit(CLI::App& app, Call& call) {
  static SubmitArguments arguments;
  cluster::SubmitOptions& options = arguments.submit;
  CLI::App* command = app.add_subcommand("submit", "Hand over what a study lacks to a batch system");
  command->add_option("STUDY", arguments.study, "Study file")->required();
  command->add_option("--engine", arguments.engine, "slurm, or a site: engines/NAME.json")
      ->capture_default_str()
      ->type_name("NAME");
  command->add_option("--engine-file", arguments.engine_file, "File with a site's account, partition, modules")
      ->type_name("FILE");
  add_study_options(*command, arguments.options);
  add_store_option(*command, arguments.root);
  command->add_option("--throttle", options.throttle, "Tasks of an array at a time; default: as many as Slurm likes")
      ->type_name("N")
      ->check(from_up(1));
  command->add_option("--time", options.resources.time, "Time limit of a task, as sbatch takes it")
      ->capture_default_str()
      ->type_name("TIME");
  command->add_option("--memory", options.resources.memory, "Memory of a task, as sbatch takes it")
      ->capture_default_str()
      ->type_name("SIZE");
  command->add_option("--threads", options.resources.threads, "Threads per case; changes no bit of the results")
      ->capture_default_str()
      ->type_name("N")
      ->check(from_up(1));
  command
      ->add_option("--batch-seconds", options.batch_seconds,
                   "Short cases share a task until it takes about this long [s]")
      ->capture_default_str()
      ->check(from_up(0));
  command->add_option("--checkpoint", options.checkpoint_every, "Wall time between two checkpoints of a case [s]")
      ->capture_default_str()
      ->check(from_up(0));
  command
      ->add_option("--restarts", options.resources.most_restarts,
                   "Times that a task goes back into the queue at its time limit")
      ->capture_default_str()
      ->type_name("N")
      ->check(from_up(0));
  command->add_flag("--dry-run", arguments.dry_run, "Print the command lines; submit and write nothing");
  command->add_option("SBATCH", options.sbatch, "Arguments for sbatch, after \"--\"")->type_name("");
  command->footer(
      "Examples:\n"
      "  runner submit studies/chapter_6.json --dry-run\n"
      "  runner submit studies/velocity.json --seeds 20 --throttle 50 --time 04:00:00 --memory 1G\n"
      "  runner submit studies/velocity.json --engine my_cluster -- --qos=long --mail-type=END");
  command->callback([&call] { call = [] { return submit(arguments); }; });
}

}  // namespace seapile::commands
