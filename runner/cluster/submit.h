// A planned study handed over to Slurm: all of it, or nothing.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "runner/cluster/batches.h"
#include "runner/cluster/job_script.h"
#include "runner/cluster/submission.h"
#include "runner/execute/plan.h"
#include "runner/study/study.h"

namespace seapile::cluster {

struct SubmitOptions {
  std::filesystem::path root = "results";  ///< of the store
  Resources resources;
  Engine engine;
  std::size_t throttle = 0;         ///< tasks of an array at a time; 0: as many as Slurm likes
  double batch_seconds = 30;        ///< least time of a task [s], where the history tells how long its cases take
  double checkpoint_every = 60;     ///< [s] of wall time
  std::vector<std::string> sbatch;  ///< more arguments for sbatch, after those of the site
};

/// Cases that wait or run in Slurm for any study of a store, with the jobs of their arrays. Throws SchedulerError.
std::map<std::string, std::string> cases_in_queue(const std::filesystem::path& root);

/// A plan as arrays, and why its tasks hold as many cases as they do.
struct Layout {
  std::vector<Array> arrays;
  std::map<std::size_t, std::set<std::string>> after_jobs;  ///< by array: jobs of earlier submissions that run its beds
  std::vector<std::string> remarks;                         ///< one line each
};

/// `in_queue`: the cases that are not submitted again. Asks Slurm for the size of an array. Throws SchedulerError.
Layout lay_out(const study::Study& study, const execute::Plan& plan, const std::map<std::string, std::string>& in_queue,
               const SubmitOptions& options);

/// The command lines of a layout, with "<job of array N>" in the place of ids.
std::vector<std::string> command_lines(const study::Study& study, const Layout& layout, const SubmitOptions& options);

/// Writes the submission's folder and submits. Nothing starts before everything is accepted; when Slurm refuses a part,
/// what was accepted is cancelled, the folder is removed, and SchedulerError tells Slurm's sentence. Throws
/// store::StoreError too.
Submission submit(const study::Study& study, const execute::Plan& plan, const Layout& layout,
                  const SubmitOptions& options);

}  // namespace seapile::cluster
