// What the submitted jobs of a study have come to: asked of the store, of what the job scripts wrote, and of Slurm.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runner/cluster/submission.h"
#include "runner/cluster/verdict.h"

namespace seapile::cluster {

/// A submitted case.
struct JobState {
  std::string study, stamp;   ///< of the submission
  std::string case_id, name;  ///< of the case
  std::string kind;           ///< "bed", "drive" or "flow"
  std::string job;            ///< task of an array, "123_4"
  JobWord state = JobWord::queued;
  std::string detail;              ///< one clause; may be empty
  std::optional<double> fraction;  ///< how far a running case is, 0..1
  int restarts = 0;                ///< times that its task was put back in the queue; 0 once Slurm has forgotten it
};

/// Every case that was submitted for a study ("": for any), each once, as of its newest submission, in the order of the
/// submission. Slurm is asked only where the files do not tell the end; what it knew of an ended case is kept beside
/// the submission (verdicts.json), for it forgets within minutes. Throws SchedulerError when it has to be asked and
/// cannot be reached.
std::vector<JobState> job_states(const std::filesystem::path& root, const std::string& study);

/// The same of one submission.
std::vector<JobState> states_of(const std::filesystem::path& root, const Submission& submission);

}  // namespace seapile::cluster
