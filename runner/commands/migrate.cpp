#include "runner/store/migration.h"

#include <fmt/format.h>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"

namespace seapile::commands {
namespace {

struct MigrateArguments {
  std::string root = "results";
  bool check = false;
};

int migrate(const MigrateArguments& arguments) {
  const store::Migration migration =
      arguments.check ? store::planned_migration(arguments.root) : store::migrate(arguments.root);
  if (migration.steps.empty()) {
    fmt::print("the catalogue is of schema {}, as this program's: nothing to do\n", migration.to);
    return execute::kDone;
  }
  fmt::print("the catalogue {} of schema {}\n", arguments.check ? "is" : "was", migration.from);
  for (const std::string& step : migration.steps) {
    fmt::print("{} schema {}\n", arguments.check ? "would be brought to" : "brought to", step);
  }
  if (!migration.kept.empty()) fmt::print("as it was it is kept as {}\n", migration.kept.string());
  for (const std::string& sentence : migration.left_out) fmt::print("no longer listed: {}\n", sentence);
  return migration.left_out.empty() ? execute::kDone : execute::kCheckFailed;
}

}  // namespace

void add_migrate(CLI::App& app, Call& call) {
  static MigrateArguments arguments;
  CLI::App* command = app.add_subcommand("migrate", "Bring the catalogue of an older version up to date");
  command->add_flag("--check", arguments.check, "Say what would be done, and write nothing");
  add_store_option(*command, arguments.root);
  command->footer(
      "The catalogue is copied aside first, and changed as a whole or not at all. The run folders stay as they are.\n\n"
      "Examples:\n"
      "  runner migrate --check\n"
      "  runner migrate --store results");
  command->callback([&call] { call = [] { return migrate(arguments); }; });
}

}  // namespace seapile::commands
