#include <fmt/format.h>

#include <filesystem>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/store/catalogue.h"
#include "runner/store/store_error.h"

namespace seapile::commands {
namespace {

/// A damaged catalogue, or one of another version, is kept under another name, and an empty one takes its place.
store::Catalogue open_for_rebuilding(const std::string& root) {
  try {
    auto catalogue = store::Catalogue::open(root);
    catalogue.check();
    return catalogue;
  } catch (const store::StoreError& error) {
    if (error.kind != store::StoreError::Kind::damaged) throw;
    fmt::print(stderr, "{}\n", error.what());
    return store::Catalogue::open_anew(root);
  }
}

int reindex(const std::string& root) {
  if (!std::filesystem::is_directory(root)) {
    fmt::print(stderr, "{} is no folder of results\n", root);
    return execute::kNothingMatched;
  }
  std::vector<std::string> left_out;
  const std::size_t count = open_for_rebuilding(root).rebuild(&left_out);
  for (const std::string& sentence : left_out) fmt::print("{}\n", sentence);
  fmt::print(stderr, "{} runs listed\n", count);
  return left_out.empty() ? execute::kDone : execute::kCheckFailed;
}

}  // namespace

void add_reindex(CLI::App& app, Call& call) {
  static std::string root = "results";
  CLI::App* command = app.add_subcommand("reindex", "Write the catalogue anew from the run folders");
  add_store_option(*command, root);
  command->footer("Example:\n  runner reindex --store results");
  command->callback([&call] { call = [] { return reindex(root); }; });
}

}  // namespace seapile::commands
