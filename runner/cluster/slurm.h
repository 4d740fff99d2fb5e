// Slurm's verbs that a submission needs: submit, release, look, cancel. Only squeue's and scontrol's knowledge is used:
// many clusters keep no accounts, and sacct then knows nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace seapile::cluster {

/// The most tasks that one array may have. Throws SchedulerError.
std::size_t most_array_tasks();

/// Submits a job and returns its id. Throws SchedulerError with sbatch's sentence when it is refused.
std::string submit_job(const std::vector<std::string>& sbatch_arguments);

/// Lets jobs that were submitted on hold go. Throws SchedulerError.
void release_jobs(const std::vector<std::string>& ids);

/// Cancels jobs; ids that are gone already are no error. Throws SchedulerError when Slurm cannot be reached.
void cancel_jobs(const std::vector<std::string>& ids);

/// One task of an array, or a job that is none, as Slurm knows it.
struct SlurmTask {
  std::string job;                ///< id of the array
  std::optional<long> task;       ///< index in the array; absent: no array
  std::string state;              ///< "PENDING", "RUNNING", "COMPLETED", ...
  std::string reason;             ///< why it waits or ended; "" when Slurm has none
  int exit_code = 0, signal = 0;  ///< once it ended
  int restarts = 0;
};

/// Whether the task can still do something: it waits, runs, or is about to.
bool is_live(const SlurmTask& task);

/// Every task of a job that Slurm still knows; none when it has forgotten the job. Throws SchedulerError.
std::vector<SlurmTask> job_tasks(const std::string& id);

/// The tasks in the answer of `scontrol show job --oneliner`; a pending range becomes one entry per task.
std::vector<SlurmTask> parse_tasks(const std::string& text);

/// The indices of an array expression, "0-3,7%2" or "1-9:4".
std::vector<long> array_indices(const std::string& expression);

}  // namespace seapile::cluster
