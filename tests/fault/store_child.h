// Runs the small worker as a process of its own, with or without a fault.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seapile::store::fault {

struct Ending {
  int exit_code = -1;  ///< -1: killed
  int signal = 0;
  std::vector<std::string> promises;  ///< lines of its standard output
  std::string complaint;              ///< its standard error
};

/// `environment`: what is added to ours, as "NAME=value". `notes`: where its output may lie meanwhile; beside the root
/// when empty.
Ending run_writer(const std::filesystem::path& root, const std::vector<std::string>& environment = {},
                  const std::filesystem::path& notes = {});

/// The environment of a worker whose `at`-th system call goes wrong; `mark` is created when that call is reached.
std::vector<std::string> with_fault(const std::string& mode, std::size_t at, const std::filesystem::path& root,
                                    const std::filesystem::path& mark);

}  // namespace seapile::store::fault
