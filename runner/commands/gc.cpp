#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>

#include "runner/commands/command.h"
#include "runner/execute/attempt.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/plan.h"
#include "runner/present/bytes.h"
#include "runner/store/garbage.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using present::bytes_text;
using store::Purpose;

struct GcArguments {
  std::string root = "results", budget;
  std::size_t keep = 1;
  std::vector<Purpose> drop;
  bool dry_run = false;
  present::Format format = present::Format::table;
};

std::uint64_t read_budget(const std::string& text) {
  if (const auto bytes = present::bytes_from(text)) return *bytes;
  throw UsageError(fmt::format("--budget: \"{}\" is no size; a number with K, M, G or T, such as 500M or 50G", text));
}

/// The runs of beds that interrupted drives may be built on. An attempt says only which run of its bed it is, so the
/// runs of that number are kept of every bed.
std::set<std::string> bed_runs_in_use(const std::vector<store::StoredRun>& runs) {
  std::set<std::string> in_use;
  for (const store::StoredRun& run : runs) {
    if (run.complete || !run.newest) continue;
    if (const auto attempt = execute::read_attempt(run.folder)) in_use.insert(attempt->bed_run);
  }
  return in_use;
}

store::Table removal_table(const std::vector<store::Removal>& removals, bool for_people) {
  store::Table table{
      {"case", "run", "what", "files", "size", "reason"}, {"", "", "", "", for_people ? "" : "B", ""}, {}};
  for (const store::Removal& removal : removals) {
    const auto size =
        for_people ? store::Cell{bytes_text(removal.bytes)} : store::Cell{static_cast<double>(removal.bytes)};
    const bool interrupted = removal.whole && removal.purpose == Purpose::leftover;
    table.rows.push_back({execute::short_id(removal.run->case_id), removal.run->run,
                          removal.whole ? interrupted ? "interrupted run" : "run" : store::name(removal.purpose),
                          static_cast<double>(removal.paths.size()), size, removal.reason});
  }
  if (for_people) present::align_right(table, 4);
  return table;
}

/// Bytes by what files are for, and what else there is.
std::string purposes_text(const std::vector<store::StoredRun>& runs, std::uint64_t total) {
  std::array<std::uint64_t, store::kPurposes> bytes{};
  std::uint64_t others = total;
  for (const store::StoredRun& run : runs) {
    for (const store::StoredFile& file : run.files) {
      bytes[static_cast<std::size_t>(file.purpose)] += file.bytes;
      others -= std::min(others, file.bytes);
    }
  }
  store::Table table{{"what", "size"}, {"", ""}, {}};
  for (std::size_t i = 0; i < bytes.size(); ++i)
    table.rows.push_back({store::name(static_cast<Purpose>(i)), bytes_text(bytes[i])});
  table.rows.push_back({"catalogue, studies, figures, others", bytes_text(others)});
  table.rows.push_back({"all", bytes_text(total)});
  present::align_right(table, 1);
  return present::text(table, present::Format::table);
}

void say_what_is_left_alone(const std::vector<store::StoredRun>& runs) {
  for (const store::StoredRun& run : runs) {
    if (!run.trouble.empty()) fmt::print(stderr, "left alone: {}\n", run.trouble);
    if (!run.strange.empty())
      fmt::print(stderr, "left alone: {} holds {}, which is none of ours\n", run.folder.string(),
                 fmt::join(run.strange, ", "));
  }
}

/// Carries the plan out; the bytes that went.
std::uint64_t carry_out(const std::vector<store::Removal>& removals, const std::string& root) {
  std::uint64_t freed = 0;
  auto catalogue = store::Catalogue::open(root);
  for (const store::Removal& removal : removals) {
    switch (store::remove(removal)) {
      case store::Removed::yes:
        freed += removal.bytes;
        if (removal.run->complete) catalogue.refresh(removal.run->folder);
        break;
      case store::Removed::claimed:
        fmt::print(stderr, "left alone: another process works on case {}\n", execute::short_id(removal.run->case_id));
        break;
      case store::Removed::changed:
        fmt::print(stderr, "left alone: {} has changed since this was planned\n", removal.run->folder.string());
        break;
    }
  }
  return freed;
}

int gc(const GcArguments& arguments) {
  store::GarbageRules rules;
  rules.keep = arguments.keep;
  if (!arguments.budget.empty()) rules.budget = read_budget(arguments.budget);
  rules.drop.insert(arguments.drop.begin(), arguments.drop.end());
  if (!fs::is_directory(fs::path(arguments.root) / "cases")) {
    fmt::print(stderr, "{} is no folder of results\n", arguments.root);
    return execute::kNothingMatched;
  }
  const std::vector<store::StoredRun> runs = store::runs_in_store(arguments.root);
  rules.bed_runs_in_use = bed_runs_in_use(runs);
  const std::uint64_t total = store::bytes_below(arguments.root);
  const std::vector<store::Removal> removals = store::plan_removals(runs, total, rules);

  const bool for_people = arguments.format == present::Format::table;
  if (for_people) fmt::print("{}\n", purposes_text(runs, total));
  if (!removals.empty() || !for_people)
    fmt::print("{}", present::text(removal_table(removals, for_people), arguments.format));
  std::fflush(stdout);
  say_what_is_left_alone(runs);
  std::uint64_t planned = 0;
  for (const store::Removal& removal : removals) planned += removal.bytes;
  const std::uint64_t freed = arguments.dry_run ? planned : carry_out(removals, arguments.root);
  const std::uint64_t rest = total - std::min(total, freed);
  fmt::print(stderr, "{} {} of {}; {} {}\n", arguments.dry_run ? "would remove" : "removed", bytes_text(freed),
             bytes_text(total), bytes_text(rest), arguments.dry_run ? "would stay" : "stay");
  if (!rules.budget || rest <= *rules.budget) return execute::kDone;
  fmt::print(stderr, "FAILED  {} are {} more than the budget of {}; what else may go is said by --drop and --keep\n",
             bytes_text(rest), bytes_text(rest - *rules.budget), bytes_text(*rules.budget));
  return execute::kCheckFailed;
}

}  // namespace

void add_gc(CLI::App& app, Call& call) {
  static GcArguments arguments;
  const std::map<std::string, Purpose> tiers = {
      {"checkpoints", Purpose::checkpoint}, {"fields", Purpose::fields}, {"series", Purpose::series}};
  CLI::App* command = app.add_subcommand("gc", "Remove superseded runs and leftovers, and keep within a budget");
  command->add_option("--keep", arguments.keep, "Newest complete runs of each case to keep")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(1, 1'000'000));
  command
      ->add_option("--budget", arguments.budget,
                   "Stop as soon as all results take no more than this: 500M, 50G, 1T (powers of 1024)")
      ->type_name("SIZE");
  command
      ->add_option("--drop", arguments.drop,
                   "Of the runs that stay: checkpoints of diverged ones, fields (frames), series")
      ->transform(CLI::CheckedTransformer(tiers).description(""))
      ->type_name("checkpoints|fields|series,...")
      ->delimiter(',');
  command->add_flag("--dry-run", arguments.dry_run, "Print the same plan and remove nothing");
  add_format_option(*command, arguments.format);
  add_store_option(*command, arguments.root);
  command->footer(
      "Goes in this order, in each the largest first: what was set aside or half written; interrupted runs that a "
      "newer\n"
      "one has replaced; runs that are no longer the newest of their case, but for beds that a kept drive was built "
      "on;\n"
      "then what --drop names. Manifests with their metrics stay for ever, and what was dropped is recorded in a "
      "sealed\n"
      "dropped.json: a study that asks for those frames runs its case again. Exit code 3: the budget is not met.\n\n"
      "Examples:\n"
      "  runner gc --dry-run\n"
      "  runner gc --budget 50G\n"
      "  runner gc --budget 50G --drop checkpoints,fields --dry-run\n"
      "  runner gc --keep 2");
  command->callback([&call] { call = [] { return gc(arguments); }; });
}

}  // namespace seapile::commands
