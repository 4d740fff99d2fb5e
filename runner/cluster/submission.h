// What was submitted: <root>/jobs/<study>/<stamp>/
//
//   submit.json              what is in this header, with the command lines as they were given
//   cases.txt                a line per array task: the ids of its cases
//   job.sh, ingest.sh        what the batch system runs
//   requests/<case id>.json  what a worker is asked (execute/request.h)
//   messages/<case id>.jsonl what the worker says while it works (execute/message.h)
//   endings/<case id>.json   how it ended, by the job script
//   logs/                    what Slurm and the job script say
//   verdicts.json            what the batch system knew of the ended cases before it forgot (job_states.h)
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seapile::cluster {

struct SubmittedArray {
  std::string job;                   ///< id; "" when it was not submitted
  std::string kind;                  ///< "bed", "drive" or "flow"
  std::size_t first = 0, tasks = 0;  ///< lines of cases.txt, from 0
  std::vector<std::string> command;  ///< as it was given
};

struct SubmittedCase {
  std::string id, name, kind;
  std::size_t array = 0, task = 0;  ///< which task of which array runs it
  std::string newest;               ///< its newest complete run when it was submitted; "": none
};

struct Submission {
  std::filesystem::path folder;
  std::string study, stamp;
  std::vector<SubmittedArray> arrays;
  std::vector<SubmittedCase> cases;
  std::string ingest;                       ///< id of the job that ingests the results; "" when not submitted
  std::vector<std::string> ingest_command;  ///< as it was given

  /// The ids of all its jobs.
  std::vector<std::string> jobs() const;
};

/// Throws store::StoreError.
void write_submission(const Submission& submission);

/// The submissions of a study ("": of every study) below a root, the newest first. A folder without a submit.json that
/// can be read is none. Reads only.
std::vector<Submission> read_submissions(const std::filesystem::path& root, const std::string& study);

/// The folder of a study's submissions.
std::filesystem::path jobs_folder(const std::filesystem::path& root, const std::string& study);

}  // namespace seapile::cluster
