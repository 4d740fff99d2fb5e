// How a worker ended, and what follows from it.
#pragma once

#include <string>

namespace seapile::execute {

struct Ending {
  int exit_code = 0;    ///< when it exited
  int signal = 0;       ///< that killed it; 0: it exited
  std::string trouble;  ///< the worker's own sentence; may be empty
};

enum class Verdict {
  completed,
  diverged,  ///< sealed, with the reason
  stopped,   ///< at a checkpoint, on request
  claimed,   ///< another process runs the case
  killed,    ///< by a signal that nobody sent on purpose
  io,        ///< the world failed: disk, permission
  failed,    ///< anything else
};

Verdict classify(const Ending& ending);

/// Whether trying once more can help: the same case fails the same way, the world does not.
bool worth_a_retry(Verdict verdict);

/// One clause for people: "killed by SIGSEGV (segmentation fault)".
std::string in_words(const Ending& ending);

}  // namespace seapile::execute
