#include <fmt/format.h>

#include <filesystem>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/store/catalogue.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

struct IngestArguments {
  std::vector<std::string> folders;
  std::string root = "results";
};

int ingest(const IngestArguments& arguments) {
  for (const std::string& folder : arguments.folders) {
    if (!fs::is_directory(folder)) throw UsageError(fmt::format("{} is no folder", folder));
  }
  if (!fs::is_directory(arguments.root)) {
    fmt::print(stderr, "{} is no folder of results\n", arguments.root);
    return execute::kNothingMatched;
  }
  auto catalogue = store::Catalogue::open(arguments.root);
  const store::Ingested ingested = usage_checked([&] {
    return arguments.folders.empty() ? catalogue.ingest_missing()
                                     : catalogue.ingest_all({arguments.folders.begin(), arguments.folders.end()});
  });
  for (const std::string& sentence : ingested.left_out) fmt::print("{}\n", sentence);
  if (ingested.added + ingested.known == 0 && ingested.left_out.empty()) {
    fmt::print(stderr, "there is no complete run\n");
    return execute::kNothingMatched;
  }
  fmt::print(stderr, "{} runs added, {} were listed already\n", ingested.added, ingested.known);
  if (ingested.studies > 0) fmt::print(stderr, "{} studies added\n", ingested.studies);
  return ingested.left_out.empty() ? execute::kDone : execute::kCheckFailed;
}

}  // namespace

void add_ingest(CLI::App& app, Call& call) {
  static IngestArguments arguments;
  CLI::App* command = app.add_subcommand("ingest", "List run folders in the catalogue that others have written");
  command
      ->add_option("DIR", arguments.folders,
                   "Run folders, or folders that hold some, below the store's cases; default: every one that is not "
                   "listed, and every study")
      ->type_name("");
  add_store_option(*command, arguments.root);
  command->footer(
      "A run lies in DIR/cases/<case id>/<number> of the store: a folder of another machine is copied there first. "
      "What\n"
      "is listed already stays as it is, so that the same call again changes nothing.\n\n"
      "Examples:\n"
      "  runner ingest\n"
      "  rsync -a cluster:results/cases/ results/cases/ && runner ingest\n"
      "  runner ingest results/cases/1a2b3c*");
  command->callback([&call] { call = [] { return ingest(arguments); }; });
}

}  // namespace seapile::commands
