#include "tests/fault/store_child.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

extern char** environ;

namespace seapile::store::fault {

namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

Ending run_writer(const std::filesystem::path& root, const std::vector<std::string>& environment,
                  const std::filesystem::path& notes) {
  const std::string beside = notes.empty() ? root.string() : notes.string();
  const std::string output = beside + ".out", errors = beside + ".err";
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  std::string program = SEAPILE_STORE_WRITER, argument = root.string();
  char* arguments[] = {program.data(), argument.data(), nullptr};
  std::vector<std::string> variables = environment;
  for (char** entry = environ; *entry != nullptr; ++entry) variables.emplace_back(*entry);
  std::vector<char*> pointers;
  for (std::string& variable : variables) pointers.push_back(variable.data());
  pointers.push_back(nullptr);

  pid_t child = 0;
  if (::posix_spawn(&child, program.c_str(), &files, nullptr, arguments, pointers.data()) != 0) {
    throw std::runtime_error("cannot start " + program);
  }
  posix_spawn_file_actions_destroy(&files);
  int status = 0;
  if (::waitpid(child, &status, 0) != child) throw std::runtime_error("cannot wait for " + program);

  Ending ending;
  if (WIFEXITED(status)) ending.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ending.signal = WTERMSIG(status);
  std::istringstream lines(content(output));
  for (std::string line; std::getline(lines, line);) ending.promises.push_back(line);
  ending.complaint = content(errors);
  std::filesystem::remove(output);
  std::filesystem::remove(errors);
  return ending;
}

std::vector<std::string> with_fault(const std::string& mode, std::size_t at, const std::filesystem::path& root,
                                    const std::filesystem::path& mark) {
  return {"LD_PRELOAD=" SEAPILE_STORE_SHIM, "ASAN_OPTIONS=verify_asan_link_order=0", "FAULT_MODE=" + mode,
          "FAULT_AT=" + std::to_string(at), "FAULT_ROOT=" + root.string() + "/",     "FAULT_MARK=" + mark.string()};
}

}  // namespace seapile::store::fault
