#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/store/equivalence.h"
#include "runner/store/run_folder.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

struct VerifyArguments {
  std::string id, root = "results";
};

/// Case folders whose id begins with `prefix`, sorted.
std::vector<fs::path> case_folders(const fs::path& root, const std::string& prefix) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(root / "cases", error)) {
    if (entry.is_directory() && entry.path().filename().string().starts_with(prefix)) folders.push_back(entry.path());
  }
  std::ranges::sort(folders);
  return folders;
}

/// What is wrong with a run, a sentence each.
std::vector<std::string> faults(const fs::path& run_folder) {
  try {
    return store::verify(run_folder);
  } catch (const store::StoreError& error) {
    return {error.what()};
  }
}

int verify(const VerifyArguments& arguments) {
  std::size_t runs = 0, damaged = 0;
  for (const fs::path& folder : case_folders(arguments.root, arguments.id)) {
    for (const std::string& run : store::complete_runs(folder)) {
      const auto sentences = faults(folder / run);
      for (const std::string& sentence : sentences) fmt::print("{}\n", sentence);
      damaged += sentences.empty() ? 0 : 1;
      ++runs;
    }
  }
  if (runs == 0) {
    fmt::print(stderr, "nothing matched\n");
    return execute::kNothingMatched;
  }
  fmt::print(stderr, "{} of {} runs verified\n", runs - damaged, runs);
  // Declarations of equivalence are of no single case.
  const auto declarations = arguments.id.empty() ? store::read_equivalences(arguments.root) : store::Equivalences();
  for (const std::string& sentence : declarations.left_out) fmt::print("{}\n", sentence);
  return damaged == 0 && declarations.left_out.empty() ? execute::kDone : execute::kCheckFailed;
}

}  // namespace

void add_verify(CLI::App& app, Call& call) {
  static VerifyArguments arguments;
  CLI::App* command = app.add_subcommand("verify", "Compare every file of complete runs with its checksum");
  command->add_option("ID", arguments.id, "Case id, or how it begins; default: every case");
  add_store_option(*command, arguments.root);
  command->footer("Example:\n  runner verify && echo every sealed byte is as it was");
  command->callback([&call] { call = [] { return verify(arguments); }; });
}

}  // namespace seapile::commands
