#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/job.h"
#include "runner/study/problem_text.h"
#include "runner/study/study.h"

namespace seapile::commands {
namespace {

int exec(const std::string& request_file) {
  execute::listen_for_stop();
  execute::Request request;
  try {
    request = execute::read_request(request_file);
  } catch (const study::BadInput& error) {
    for (const base::Problem& problem : error.problems) {
      fmt::print(stderr, "{}\n", study::sentence(error.file, problem));
    }
    return execute::kBadRequest;
  }
  if (!execute::die_with(request.parent)) return execute::kStoppedResumable;
  return execute::work(request, [](const execute::Message& message) {
    fmt::print("{}\n", execute::encode(message));
    std::fflush(stdout);
  });
}

}  // namespace

void add_exec(CLI::App& app, Call& call) {
  static std::string request;
  CLI::App* command = app.add_subcommand("exec", "Run one case as a worker process");
  command->group("");  // for the runner and for batch systems, not for people
  command->add_option("REQUEST", request, "File with the request, \"-\" for standard input")->required();
  command->callback([&call] {
    call = [] {
      const int code = exec(request);
      std::fflush(nullptr);
      // After a failure nothing is tidied up: HDF5's own exit handlers would write once more to what has failed.
      ::_exit(code);
      return code;
    };
  });
}

}  // namespace seapile::commands
