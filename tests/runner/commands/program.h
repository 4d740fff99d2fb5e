// The real program, run as a user runs it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace seapile::commands {

struct Finished {
  int exit_code = -1;  ///< -1: killed by a signal
  std::string out, error;
};

/// A folder of its own for a test, removed at the end.
class Workplace {
 public:
  Workplace();
  ~Workplace();
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path results() const { return folder_ / "results"; }

  /// Writes a file of the folder.
  std::filesystem::path write(const std::string& name, const std::string& text) const;

  /// Runs the program in the folder until it ends.
  Finished run(const std::vector<std::string>& arguments, const std::string& input = "") const;

  /// Writes a study NAME.json, runs it, which has to succeed, and returns the ids of its cases, shortened.
  std::vector<std::string> run_study(const std::string& name, const std::string& text) const;

  /// Starts the program in the folder; its output goes to the files "out" and "error" there.
  pid_t start(const std::vector<std::string>& arguments) const;

 private:
  std::filesystem::path folder_;
};

/// Waits for a started program; its exit code, or minus the signal that killed it.
int wait_for(pid_t process);

std::string content(const std::filesystem::path& file);

/// Everything below a folder with its content: to see that a command wrote nothing.
std::map<std::string, std::string> everything(const std::filesystem::path& folder);

/// A study of two tips in a bed of 200 grains, about a second of work. `more` goes into the study's top level.
std::string small_study(const std::string& name, const std::string& more = "");

}  // namespace seapile::commands
