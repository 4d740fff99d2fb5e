#include "tests/runner/commands/program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace seapile::commands {

namespace fs = std::filesystem;

namespace {

void redirect(int to, const fs::path& file, int flags) {
  const int opened = ::open(file.c_str(), flags, 0644);
  if (opened < 0 || ::dup2(opened, to) < 0) ::_exit(126);
  ::close(opened);
}

}  // namespace

Workplace::Workplace() {
  static std::atomic<int> count = 0;
  folder_ = fs::temp_directory_path() / ("seapile_" + std::to_string(::getpid()) + "_" + std::to_string(++count));
  fs::create_directories(folder_);
}

Workplace::~Workplace() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

fs::path Workplace::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name) << text;
  return folder_ / name;
}

pid_t Workplace::start(const std::vector<std::string>& arguments) const {
  std::vector<char*> words = {const_cast<char*>(SEAPILE_RUNNER)};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  const pid_t process = ::fork();
  if (process < 0) throw std::runtime_error("fork failed");
  if (process > 0) return process;
  if (::chdir(folder_.c_str()) != 0) ::_exit(126);
  const fs::path input = folder_ / "in";
  redirect(STDIN_FILENO, fs::exists(input) ? input : fs::path("/dev/null"), O_RDONLY);
  redirect(STDOUT_FILENO, folder_ / "out", O_WRONLY | O_CREAT | O_TRUNC);
  redirect(STDERR_FILENO, folder_ / "error", O_WRONLY | O_CREAT | O_TRUNC);
  ::execv(SEAPILE_RUNNER, words.data());
  ::_exit(127);
}

std::vector<std::string> Workplace::run_study(const std::string& name, const std::string& text) const {
  write(name + ".json", text);
  if (const Finished finished = run({name + ".json"}); finished.exit_code != 0)
    throw std::runtime_error(finished.error);
  std::vector<std::string> ids;
  const auto answer = nlohmann::json::parse(run({"query", name, "--each", "--format", "json"}).out);
  for (const auto& row : answer.at("rows")) ids.push_back(row.at("case"));
  return ids;
}

Finished Workplace::run(const std::vector<std::string>& arguments, const std::string& input) const {
  if (!input.empty()) write("in", input);
  const int code = wait_for(start(arguments));
  if (!input.empty()) fs::remove(folder_ / "in");
  return {code < 0 ? -1 : code, content(folder_ / "out"), content(folder_ / "error")};
}

int wait_for(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) throw std::runtime_error("waitpid failed");
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::map<std::string, std::string> everything(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files[entry.path().string()] = content(entry.path());
  }
  return files;
}

std::string small_study(const std::string& name, const std::string& more) {
  return R"({
  "study": ")" +
         name + R"(",
  "question": "Which tip meets more resistance?",
  "base": {
    "bed": {
      "domain": {"width": "0.8 m", "height": "1.5 m"},
      "grains": {"count": 200, "radius": {"min": "0.02 m", "max": "0.03 m"}}
    },
    "pile": {"radius": "0.05 m", "depth": "0.3 m", "driving": {"constant": {"speed": "0.4 m/s"}}},
    "fluid": null
  },
  "record": {"frames": ["0 m", "0.1 m"]},
  )" + more +
         R"(
  "axes": {"pile.tip": ["conical", "flat"]}
})";
}

}  // namespace seapile::commands
