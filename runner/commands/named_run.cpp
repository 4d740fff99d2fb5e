#include "runner/commands/named_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "runner/commands/command.h"
#include "runner/store/catalogue.h"
#include "runner/store/layout.h"

namespace seapile::commands {

std::optional<present::FinishedRun> find_run(const std::string& root, const std::string& name) {
  const std::size_t slash = name.find('/');
  const std::string prefix = name.substr(0, slash);
  const auto catalogue = store::Catalogue::open_read_only(root);
  std::filesystem::path folder = usage_checked([&] { return catalogue.find(prefix); });
  if (folder.empty()) {
    fmt::print(stderr, "no case has an id that begins with {}\n", prefix);
    return std::nullopt;
  }
  if (slash != std::string::npos) {
    const std::string run = fmt::format("{:0>4}", name.substr(slash + 1));
    const std::filesystem::path of_case = folder.parent_path();
    const std::vector<std::string> runs = store::complete_runs(of_case);
    if (std::ranges::find(runs, run) == runs.end()) {
      fmt::print(stderr, "case {} has no complete run {}; it has {}\n", prefix, run, fmt::join(runs, ", "));
      return std::nullopt;
    }
    folder = of_case / run;
  }
  return present::FinishedRun{folder, store::read_manifest(folder)};
}

}  // namespace seapile::commands
