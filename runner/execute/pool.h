// Carries out a plan with worker processes, the cores shared out among them. The pool decides; the processes behind the
// Workers interface are real ones (processes.h) or fakes.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "runner/execute/ending.h"
#include "runner/execute/message.h"
#include "runner/execute/plan.h"

namespace seapile::execute {

/// A worker said something.
struct Said {
  std::size_t task;
  Message message;
};

/// A worker is gone.
struct Ended {
  std::size_t task;
  Ending ending;
};

/// The runner itself received a signal.
struct Signalled {
  int signal;
};

using Event = std::variant<Said, Ended, Signalled>;

class Workers {
 public:
  virtual ~Workers() = default;
  /// Starts a worker for a task of the plan. Throws std::system_error when no process can be started.
  virtual void start(std::size_t task, const Task& what, int threads) = 0;
  /// The next event; absent after `patience` without one.
  virtual std::optional<Event> wait(std::chrono::milliseconds patience) = 0;
  virtual void ask_to_stop() = 0;  ///< all running workers: seal a checkpoint and leave
  virtual void kill() = 0;         ///< all running workers, at once
};

struct Sharing {
  int cores = 1;
  std::optional<int> jobs = {};          ///< cases at a time; absent: as many as are ready
  std::optional<int> threads = {};       ///< per case; absent: the cores shared out
  bool oversubscribe = false;            ///< more threads than cores are wanted
  std::optional<double> memory_mb = {};  ///< that all running cases may have together [MB]; absent: no limit
};

/// What is wrong with a wish for more threads than there are cores; empty when nothing is, or they are wanted.
std::string objection(const Sharing& sharing);

/// Threads for the next case to be started, 0 when it has to wait: `running` cases use `busy` cores, `ready` cases
/// wait. Unless the user says otherwise, at most `useful` ones.
int threads_for_next(const Sharing& sharing, int running, int busy, int ready, int useful);

/// Whether a case that is thought to need `wanted` fits beside those that have `taken` [MB]. A case that needs more
/// than there is runs by itself.
bool memory_suffices(const Sharing& sharing, double taken, double wanted);

enum class State {
  fresh,    ///< nothing to do
  waiting,  ///< for its bed
  ready,
  running,
  elsewhere,  ///< another process runs it
  completed,
  diverged,
  failed,
  blocked,  ///< its bed could not be had
  stopped,  ///< before or at a checkpoint, resumable
};

/// What the pool tells of a task while it works.
struct Watch {
  std::function<void(std::size_t task, int threads)> started;
  std::function<void(std::size_t task, double fraction)> advanced;
  std::function<void(std::size_t task, State state, const std::string& why)> changed;  ///< any state but running
  std::function<void(std::size_t task, const std::string& why)> retried;               ///< it will be started once more
  std::function<void(int signal)> signalled;                                           ///< to the runner
  std::function<void()> tick;                                                          ///< at least twice a second
};

/// What the pool asks of the store.
struct StoreView {
  Disk disk;
  std::function<bool(const std::string& case_id)> claimed;  ///< by a live process
  /// Peak memory [MB] of a case's newest run; may be empty where nothing is known.
  std::function<double(const std::string& case_id)> memory_mb = {};
  Equivalences equivalences = {};  ///< those that the plan was made with
};

struct Summary {
  std::vector<State> states;     ///< one per task
  std::vector<std::string> why;  ///< one per task: what went wrong, or empty
  int signals = 0;               ///< that the runner received: the first stops, the second kills
};

/// Runs everything that is not fresh, a drive after its bed. Updates the decisions of tasks that had to be planned
/// again.
Summary carry_out(Plan& plan, const study::Study& study, const Numerics& numerics, const Sharing& sharing,
                  Workers& workers, const StoreView& store, const Watch& watch);

/// The exit code of the command.
int exit_code(const Summary& summary);

}  // namespace seapile::execute
