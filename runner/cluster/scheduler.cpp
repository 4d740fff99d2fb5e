#include "runner/cluster/scheduler.h"

#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/process/args.hpp>
#include <boost/process/async.hpp>
#include <boost/process/child.hpp>
#include <boost/process/env.hpp>
#include <boost/process/environment.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/io.hpp>
#include <boost/process/search_path.hpp>
#include <future>
#include <sstream>

namespace seapile::cluster {

namespace bp = boost::process;

Answer ask(const std::string& program, const std::vector<std::string>& arguments) {
  const auto found = bp::search_path(program);
  if (found.empty())
    throw SchedulerError(
        fmt::format("{} is not in PATH: Slurm's programs are needed on the machine that submits", program));
  // Both streams are read while the program runs, so that it never waits for a full pipe.
  boost::asio::io_context reading;
  std::future<std::string> out, error;
  bp::environment variables = boost::this_process::environment();
  variables["SLURM_BITSTR_LEN"] = "0";  // or Slurm shortens the list of an array's tasks with dots
  bp::child child(bp::exe = found.string(), bp::args = arguments, variables, bp::std_in<bp::null, bp::std_out> out,
                  bp::std_err > error, reading);
  reading.run();
  child.wait();
  return {child.exit_code(), out.get(), error.get()};
}

std::string ask_surely(const std::string& program, const std::vector<std::string>& arguments) {
  Answer answer = ask(program, arguments);
  if (answer.exit_code != 0) throw SchedulerError(complaint(program, answer));
  return answer.out;
}

std::string complaint(const std::string& program, const Answer& answer) {
  std::istringstream text(answer.error.empty() ? answer.out : answer.error);
  std::string joined;
  for (std::string line; std::getline(text, line);) {
    for (const std::string& before : {program + ": ", std::string("error: ")}) {
      if (line.starts_with(before)) line.erase(0, before.size());
    }
    if (!line.empty()) joined += (joined.empty() ? "" : "; ") + line;
  }
  if (joined.empty()) joined = fmt::format("ended with exit code {}", answer.exit_code);
  return fmt::format("{}: {}", program, joined);
}

}  // namespace seapile::cluster
