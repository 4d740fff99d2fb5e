#include <fmt/format.h>

#include <algorithm>

#include "runner/commands/command.h"
#include "runner/commands/findings.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/tint.h"

namespace seapile::commands {
namespace {

struct DoctorArguments {
  std::string root = "results";
  present::Format format = present::Format::table;
};

int doctor(const DoctorArguments& arguments) {
  std::vector<Finding> findings = findings_of_machine();
  const std::vector<Finding> of_store = findings_of_store(arguments.root);
  findings.insert(findings.end(), of_store.begin(), of_store.end());

  store::Table table{{"state", "area", "what", "words"}, {"", "", "", ""}, {}};
  for (const Finding& finding : findings)
    table.rows.push_back({name(finding.health), finding.area, finding.what, finding.words});
  fmt::print("{}", execute::tinted(present::text(table, arguments.format), stdout));
  std::fflush(stdout);
  const auto problems = std::ranges::count(findings, Health::problem, &Finding::health);
  if (problems == 0) return execute::kDone;
  fmt::print(stderr, "{} problem{}, to be mended before studies are run here\n", problems, problems == 1 ? "" : "s");
  return execute::kCheckFailed;
}

}  // namespace

const char* name(Health health) {
  static constexpr const char* kNames[] = {"ok", "note", "problem"};
  return kNames[static_cast<int>(health)];
}

void add_doctor(CLI::App& app, Call& call) {
  static DoctorArguments arguments;
  CLI::App* command = app.add_subcommand("doctor", "Examine the installation, this machine and a store of results");
  add_format_option(*command, arguments.format);
  add_store_option(*command, arguments.root);
  command->footer(
      "Tries what a run leans on: meshes a square, writes and locks a small file in the store's folder and removes "
      "it.\n"
      "Nothing else is written, and nothing is mended. A note is worth knowing; a problem (exit code 3) is to be "
      "mended\n"
      "first, and its line says how.\n\n"
      "Examples:\n"
      "  runner doctor\n"
      "  runner doctor --store archive/results --format json");
  command->callback([&call] { call = [] { return doctor(arguments); }; });
}

}  // namespace seapile::commands
