// What became of a submitted case, from what is known of it. A pure function.
#pragma once

#include <optional>
#include <string>

#include "runner/cluster/slurm.h"

namespace seapile::cluster {

enum class JobWord {
  queued,
  running,
  requeued,  ///< waits to go on from its checkpoint
  done,
  diverged,
  failed,   ///< the worker ended with an error
  not_run,  ///< its bed could not be had, or its task ended before its turn
  timed_out,
  over_memory,
  killed,   ///< by a signal that nobody sent on purpose
  stopped,  ///< at a checkpoint, and not put back
  cancelled,
  lost,  ///< neither Slurm nor the store knows of its end
};

/// "not run", "timed out", ...
const char* word(JobWord state);
std::optional<JobWord> job_word(const std::string& text);

/// Whether nothing more will come of it by itself.
bool is_final(JobWord state);

/// A case's ending as the job script wrote it.
struct ScriptEnding {
  int exit_code = 0, signal = 0;
  std::string asked_by;  ///< "USR1", "TERM", or "" when nobody asked it to stop
  bool checkpoint = false;
};

struct Evidence {
  bool sealed = false;      ///< a run of the case was completed since it was submitted ...
  std::string diverged;     ///< ... with this reason, when it diverged
  bool started = false;     ///< the task's present or last attempt has come to it
  bool checkpoint = false;  ///< something to continue from is in the store
  std::optional<ScriptEnding> ending;
  std::optional<SlurmTask> task;  ///< absent when Slurm has forgotten it
  bool memory_exceeded = false;   ///< Slurm says so in the task's log
  std::string trouble;            ///< the worker's last sentence; may be empty
};

struct JobVerdict {
  JobWord state = JobWord::lost;
  std::string detail;  ///< one clause; may be empty
  bool operator==(const JobVerdict&) const = default;
};

JobVerdict judge(const Evidence& evidence);

}  // namespace seapile::cluster
