// Workers as processes of this machine, started by exec: `<program> exec -` with the request on standard input and the
// messages on standard output. A fork without exec is no option: a child of a process that has used OpenMP hangs in its
// first parallel region.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "runner/execute/pool.h"
#include "runner/execute/request.h"

namespace seapile::execute {

/// The program that is running now, also when its file has been replaced since.
inline constexpr const char* kThisProgram = "/proc/self/exe";

/// While one exists, SIGINT, SIGTERM and SIGHUP become events, and a worker does not see the terminal's Ctrl-C (it has
/// a process group of its own). Destroying it kills what still runs. At most one at a time in a process.
class Processes : public Workers {
 public:
  /// `request`: what to ask for a task; its `threads` and `parent` are filled in here.
  Processes(std::filesystem::path program, std::function<Request(const Task&)> request);
  ~Processes() override;
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;

  void start(std::size_t task, const Task& what, int threads) override;
  std::optional<Event> wait(std::chrono::milliseconds patience) override;
  void ask_to_stop() override;
  void kill() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seapile::execute
