#include <fmt/format.h>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/present/run_text.h"
#include "runner/store/catalogue.h"

namespace seapile::commands {
namespace {

struct ShowArguments {
  std::string id, root = "results";
  bool as_study = false;
};

int show(const ShowArguments& arguments) {
  const auto catalogue = store::Catalogue::open_read_only(arguments.root);
  const auto folder = usage_checked([&] { return catalogue.find(arguments.id); });
  if (folder.empty()) {
    fmt::print(stderr, "no case has an id that begins with {}\n", arguments.id);
    return execute::kNothingMatched;
  }
  const store::Manifest manifest = store::read_manifest(folder);
  if (arguments.as_study) {
    fmt::print("{}", present::study_text(manifest));
    return execute::kDone;
  }
  const std::string id = manifest.header.case_id.substr(0, 10);
  const std::string store = arguments.root == "results" ? "" : " --store " + arguments.root;
  const std::string command =
      fmt::format("runner show {0}{1} --study > {0}.json && runner {0}.json --store again", id, store);
  fmt::print("{}", present::run_text(manifest, folder, command));
  return execute::kDone;
}

}  // namespace

void add_show(CLI::App& app, Call& call) {
  static ShowArguments arguments;
  CLI::App* command = app.add_subcommand("show", "Everything about one run");
  command->add_option("ID", arguments.id, "Case id, or how it begins")->required();
  command->add_flag("--study", arguments.as_study, "Print a study file of this one case instead");
  add_store_option(*command, arguments.root);
  command->footer(
      "Examples:\n"
      "  runner show 1a2b3c4d5e\n"
      "  runner show 1a2b3c4d5e --study > case.json");
  command->callback([&call] { call = [] { return show(arguments); }; });
}

}  // namespace seapile::commands
