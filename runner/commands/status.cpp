#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "runner/commands/command.h"
#include "runner/execute/campaign.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/progress.h"
#include "runner/execute/standing.h"

namespace seapile::commands {
namespace {

using execute::CaseStanding;
using execute::Standing;
using store::Cell;

struct StatusArguments {
  std::string study, root = "results";
  study::Options options;
  present::Format format = present::Format::table;
  bool watch = false, each = false;
  double every = 2;
};

constexpr std::size_t kShownLogLines = 3;
constexpr std::size_t kMostDetails = 20;  // cases that are told one by one

std::size_t count(const std::vector<CaseStanding>& cases, Standing standing) {
  return static_cast<std::size_t>(std::ranges::count(cases, standing, &CaseStanding::standing));
}

/// By the study itself where there is its file, else by what the catalogue knows of it; absent: nothing is known.
std::optional<std::vector<CaseStanding>> look(const StatusArguments& arguments) {
  const bool is_file = arguments.study.ends_with(".json") || std::filesystem::is_regular_file(arguments.study);
  if (is_file) {
    const study::Study study = study::read(arguments.study, arguments.options);
    execute::CampaignOptions options;
    options.root = arguments.root;
    return execute::standings(execute::Campaign(study, options).plan(), arguments.root);
  }
  const auto catalogue = store::Catalogue::open_read_only(arguments.root);
  if (!is_known(arguments.study, catalogue)) return {};
  return execute::standings(*catalogue.entry(arguments.study), arguments.root);
}

/// A row per case.
store::Table table_of_cases(const std::vector<CaseStanding>& cases) {
  store::Table table;
  table.columns = {"case", "name", "state", "done", "left", "threads", "host", "reason"};
  table.units = {"", "", "", "%", "s", "", "", ""};
  for (const CaseStanding& about : cases) {
    std::vector<Cell> row = {execute::short_id(about.case_id), about.name, execute::name(about.standing)};
    if (about.progress) {
      const auto left = about.standing == Standing::running ? execute::seconds_left(*about.progress) : std::nullopt;
      row.emplace_back(100 * about.progress->fraction);
      row.push_back(left ? Cell{std::ceil(*left)} : Cell{});
      row.emplace_back(static_cast<double>(about.progress->threads));
      row.emplace_back(about.progress->host);
    } else {
      row.insert(row.end(), 4, Cell{});
    }
    row.emplace_back(about.reason);
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// For people: how many cases stand where, then those that are being computed, then those that came to no good end.
std::string text_for_people(const std::vector<CaseStanding>& cases) {
  std::vector<std::string> counts;
  for (const Standing standing : execute::kStandings) {
    if (const std::size_t n = count(cases, standing))
      counts.push_back(fmt::format("{} {}", n, execute::name(standing)));
  }
  std::string text = fmt::format("{} of {} completed: {}\n", count(cases, Standing::completed), cases.size(),
                                 counts.empty() ? "no cases" : fmt::format("{}", fmt::join(counts, ", ")));
  std::size_t told = 0;
  for (const CaseStanding& about : cases) {
    if (about.standing == Standing::completed || about.standing == Standing::missing || ++told > kMostDetails) continue;
    text += fmt::format("{:<11}  {} {}", execute::name(about.standing), execute::short_id(about.case_id), about.name);
    if (about.progress) text += fmt::format(": {:.0f} %", 100 * about.progress->fraction);
    if (about.progress && about.standing == Standing::running) {
      const auto left = execute::seconds_left(*about.progress);
      text += left ? fmt::format(", about {} left", execute::clock_text(*left)) : "";
      text += fmt::format(" ({} thread{} on {})", about.progress->threads, about.progress->threads == 1 ? "" : "s",
                          about.progress->host);
    }
    if (!about.reason.empty() && about.standing != Standing::running) text += ": " + about.reason;
    text += "\n";
    if (about.standing != Standing::failed && about.standing != Standing::diverged) continue;
    for (const std::string& line : execute::last_log_lines(about.run_folder, kShownLogLines)) {
      text += fmt::format("{:>13}| {}\n", "", line);
    }
  }
  if (told > kMostDetails) text += fmt::format("and {} more; --each lists all\n", told - kMostDetails);
  return text;
}

std::string text_of(const std::vector<CaseStanding>& cases, const StatusArguments& arguments) {
  const bool for_people = arguments.format == present::Format::table && !arguments.each;
  return for_people ? text_for_people(cases) : present::text(table_of_cases(cases), arguments.format);
}

/// Without a study: one row per study that the catalogue knows.
int overview(const StatusArguments& arguments) {
  const auto catalogue = store::Catalogue::open_read_only(arguments.root);
  store::Table table;
  table.columns = {"study", "cases"};
  for (const Standing standing : execute::kStandings) table.columns.emplace_back(execute::name(standing));
  table.units.resize(table.columns.size());
  for (const std::string& study : catalogue.studies()) {
    const auto cases = execute::standings(*catalogue.entry(study), arguments.root);
    std::vector<Cell> row = {study, static_cast<double>(cases.size())};
    for (const Standing standing : execute::kStandings) row.emplace_back(static_cast<double>(count(cases, standing)));
    table.rows.push_back(std::move(row));
  }
  if (table.rows.empty()) {
    fmt::print(stderr, "no study was run here\n");
    return execute::kNothingMatched;
  }
  fmt::print("{}", present::text(table, arguments.format));
  return execute::kDone;
}

/// As the command that ran the study would have ended.
int code_of(const std::vector<CaseStanding>& cases) {
  if (count(cases, Standing::failed) + count(cases, Standing::diverged) > 0) return execute::kSomeCasesFailed;
  return count(cases, Standing::completed) == cases.size() ? execute::kDone : execute::kStoppedResumable;
}

/// Again and again while a case is being computed; on a terminal each look takes the place of the one before.
int watch(const StatusArguments& arguments) {
  const bool terminal = ::isatty(STDOUT_FILENO) == 1;
  for (std::string before;;) {
    const auto cases = look(arguments);
    if (!cases) return execute::kNothingMatched;
    const std::string text = text_of(*cases, arguments);
    if (terminal) fmt::print("\x1b[{}A\x1b[J", std::ranges::count(before, '\n'));
    if (terminal || text != before) fmt::print("{}", text);
    std::fflush(stdout);
    if (count(*cases, Standing::running) == 0) return code_of(*cases);
    before = text;
    std::this_thread::sleep_for(std::chrono::duration<double>(arguments.every));
  }
}

int status(const StatusArguments& arguments) {
  if (arguments.study.empty()) {
    if (arguments.watch) throw UsageError("--watch needs a STUDY");
    return overview(arguments);
  }
  if (arguments.watch) return watch(arguments);
  const auto cases = look(arguments);
  if (!cases) return execute::kNothingMatched;
  fmt::print("{}", text_of(*cases, arguments));
  return execute::kDone;
}

}  // namespace

void add_status(CLI::App& app, Call& call) {
  static StatusArguments arguments;
  CLI::App* command = app.add_subcommand("status", "How far a study is: what is done, running, failed or missing");
  command->add_option("STUDY", arguments.study, "File or name of a study; default: one row for each that was run here");
  add_study_options(*command, arguments.options);
  command->add_flag("--watch", arguments.watch, "Look again while a case is running; then end as the study did");
  command->add_option("--every", arguments.every, "Time between two looks [s]")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 3600.0))
      ->needs("--watch");
  command->add_flag("--each", arguments.each, "One row per case; csv and json always have one");
  add_format_option(*command, arguments.format);
  add_store_option(*command, arguments.root);
  command->footer(
      "By a study's file its beds are among the cases, and results that can no longer stand for them are stale; by "
      "its\n"
      "name the catalogue tells what was run. Nothing is written and no claim is touched. --watch ends with 0 when "
      "all\n"
      "cases are completed, 1 when some failed, and 75 when some are missing and nobody is at them.\n\n"
      "Examples:\n"
      "  runner status\n"
      "  runner status studies/chapter_6.json --watch\n"
      "  runner status chapter_6 --format csv");
  command->callback([&call] { call = [] { return status(arguments); }; });
}

}  // namespace seapile::commands
