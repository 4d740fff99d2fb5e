#include "runner/execute/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "runner/commands/command.h"
#include "runner/execute/campaign.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/price.h"
#include "runner/execute/progress.h"

namespace seapile::commands {
namespace {

using execute::Action;
using execute::Prices;

struct PlanArguments {
  std::string study;
  std::string root = "results";
  study::Options options;
  present::Format format = present::Format::table;
  bool each = false;
};

using store::Cell;

/// What a price was made from, in words.
std::string source(const std::optional<execute::Price>& price) {
  if (!price) return "no history";
  return fmt::format("{} run{}{}", price->runs, price->runs == 1 ? "" : "s", price->scaled ? ", scaled" : " alike");
}

/// One row per case.
store::Table table_of_cases(const execute::Plan& plan, const Prices& prices) {
  store::Table table;
  table.columns = {"case", "kind", "name", "action", "reason", "cpu", "memory", "disk", "price from"};
  table.units = {"", "", "", "", "", "s", "MB", "B", ""};
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    const execute::Task& task = plan.tasks[i];
    std::vector<Cell> row = {execute::short_id(task.id), execute::name(task.kind), task.name,
                             execute::name(task.decision.action), task.decision.reason};
    const bool priced = task.decision.action != Action::fresh && prices[i];
    if (priced) {
      row.insert(row.end(), {prices[i]->cpu_seconds, prices[i]->memory_mb, prices[i]->bytes});
    } else {
      row.insert(row.end(), 3, Cell{});
    }
    row.push_back(task.decision.action == Action::fresh ? Cell{} : Cell{source(prices[i])});
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// One row per action, kind and reason: what a study of ten thousand cases is read as.
store::Table table_of_groups(const execute::Plan& plan, const Prices& prices) {
  struct Group {
    double cases = 0, unpriced = 0, cpu = 0, memory = 0, bytes = 0;
  };
  std::map<std::tuple<Action, execute::Kind, std::string>, Group> groups;
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    const execute::Task& task = plan.tasks[i];
    Group& group = groups[{task.decision.action, task.kind, task.decision.reason}];
    ++group.cases;
    if (!prices[i]) {
      ++group.unpriced;
      continue;
    }
    group.cpu += prices[i]->cpu_seconds;
    group.bytes += prices[i]->bytes;
    group.memory = std::max(group.memory, prices[i]->memory_mb);
  }
  store::Table table;
  table.columns = {"action", "cases", "kind", "reason", "without history", "cpu", "memory of one", "disk"};
  table.units = {"", "", "", "", "", "s", "MB", "MB"};
  for (const auto& [key, group] : groups) {
    const auto& [action, kind, reason] = key;
    std::vector<Cell> row = {execute::name(action), group.cases, execute::name(kind), reason};
    if (action == Action::fresh) {
      row.insert(row.end(), 4, Cell{});
    } else if (group.unpriced == group.cases) {
      row.insert(row.end(), {group.unpriced, Cell{}, Cell{}, Cell{}});
    } else {
      row.insert(row.end(), {group.unpriced, group.cpu, group.memory, group.bytes / 1e6});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// "12 cases to run: 4:12 of CPU time, 120 MB of memory for the largest, 96 MB on disk; at least 2:10 on 2 cores. 3 of
/// them have no history and are not in these figures."
std::string estimate_text(const execute::Estimate& estimate, int cores) {
  if (estimate.to_run == 0) return "Nothing to run: every case is fresh.";
  std::string text = fmt::format("{} case{} to run", estimate.to_run, estimate.to_run == 1 ? "" : "s");
  if (estimate.unpriced == estimate.to_run) return text + "; no history to tell their price by.";
  text +=
      fmt::format(": {} of CPU time, {:.0f} MB of memory for the largest, {:.3g} MB on disk; at least {} on {} core{}.",
                  execute::duration_text(estimate.cpu_seconds), estimate.largest_mb, estimate.bytes / 1e6,
                  execute::duration_text(estimate.wall_seconds), cores, cores == 1 ? "" : "s");
  if (estimate.unpriced > 0)
    text += fmt::format(" {} of them ha{} no history and {} not in these figures.", estimate.unpriced,
                        estimate.unpriced == 1 ? "s" : "ve", estimate.unpriced == 1 ? "is" : "are");
  return text;
}

int plan(const PlanArguments& arguments) {
  const study::Study study = study::read(arguments.study, arguments.options);
  execute::CampaignOptions options;
  options.root = arguments.root;
  const execute::Campaign campaign(study, options);
  const execute::Plan& plan = campaign.plan();
  const Prices prices = execute::prices_of(study, plan, arguments.root);
  const bool for_people = arguments.format == present::Format::table;
  const bool by_case = arguments.each || !for_people;
  fmt::print("{}",
             present::text(by_case ? table_of_cases(plan, prices) : table_of_groups(plan, prices), arguments.format));
  fmt::print(for_people ? stdout : stderr, "{}{}\n", for_people ? "\n" : "",
             estimate_text(execute::estimate(plan, prices, campaign.sharing().cores), campaign.sharing().cores));
  return execute::kDone;
}

}  // namespace

void add_plan(CLI::App& app, Call& call) {
  static PlanArguments arguments;
  CLI::App* command = app.add_subcommand("plan", "What a study lacks, why, and what it will cost; runs nothing");
  command->add_option("STUDY", arguments.study, "Study file")->required();
  add_study_options(*command, arguments.options);
  add_format_option(*command, arguments.format);
  command->add_flag("--each", arguments.each, "One row per case; csv and json always have one");
  add_store_option(*command, arguments.root);
  command->footer(
      "A case is fresh when its newest run can stand for it, and otherwise run, for the reason that is said. Prices "
      "are\n"
      "those of runs in the catalogue that were computed alike; what has no such run has no price.\n\n"
      "Examples:\n"
      "  runner plan studies/chapter_6.json\n"
      "  runner plan studies/velocity.json --seeds 8\n"
      "  runner plan studies/tip_shape.json --each --format csv");
  command->callback([&call] { call = [] { return plan(arguments); }; });
}

}  // namespace seapile::commands
