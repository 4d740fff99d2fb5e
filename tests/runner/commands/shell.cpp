#include "tests/runner/commands/shell.h"

#include <sys/wait.h>

#include <cstdlib>

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

Finished run_bash(const Workplace& place, const std::string& command) {
  // Outside the folder, for what a command finds there is part of what is tested.
  const fs::path beside = place.folder().string() + "_shell";
  fs::create_directories(beside);
  const std::string bin = fs::path(SEAPILE_RUNNER).parent_path().string();
  const int status =
      std::system(("cd '" + place.folder().string() + "' && PATH='" + bin + "':\"$PATH\" " + command + " > '" +
                   (beside / "out").string() + "' 2> '" + (beside / "error").string() + "' < /dev/null")
                      .c_str());
  Finished finished{WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(beside / "out"), content(beside / "error")};
  fs::remove_all(beside);
  return finished;
}

/// As one word of a shell.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace

Finished shell(const Workplace& place, const std::string& lines) { return run_bash(place, "bash -c " + quoted(lines)); }

Finished on_terminal(const Workplace& place, const std::string& lines) {
  return run_bash(place, "script --quiet --return --command " + quoted("bash -c " + quoted(lines)) + " /dev/null");
}

}  // namespace seapile::commands
