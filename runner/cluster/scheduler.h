// The programs of a batch system, called as a user would call them.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace seapile::cluster {

/// The batch system is absent, cannot be reached, or refused; its own sentence where it had one. Exit code 6.
struct SchedulerError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a program of the batch system answered.
struct Answer {
  int exit_code = 0;
  std::string out, error;
};

/// Runs `program`, found in PATH, until it ends. The arguments reach it as they are: no shell reads them. Throws
/// SchedulerError when there is no such program.
Answer ask(const std::string& program, const std::vector<std::string>& arguments);

/// The same, for an answer that has to be had: throws SchedulerError with what the program said when it failed.
std::string ask_surely(const std::string& program, const std::vector<std::string>& arguments);

/// A program's complaint in one line, without its name before it: "Batch job submission failed: ...".
std::string complaint(const std::string& program, const Answer& answer);

}  // namespace seapile::cluster
