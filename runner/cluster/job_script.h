#pragma once

#include <string>

#include "runner/cluster/engine_file.h"

namespace seapile::cluster {

/// What every task of an array is given.
struct Resources {
  std::string time = "02:00:00";  ///< limit, as sbatch takes it
  std::string memory = "2G";      ///< likewise
  int threads = 1;
  int most_restarts = 10;  ///< times that a task is put back in the queue at its time limit
};

/// The seconds of a time limit: "90" (minutes), "MM:SS", "HH:MM:SS", "D-HH", "D-HH:MM" or "D-HH:MM:SS"; 0 when it is
/// none.
long limit_seconds(const std::string& time);

/// How long before its limit a task is told to seal a checkpoint [s]. Slurm looks at limits about every half minute, so
/// that less than two minutes are no lead; of a limit of a few minutes it is half.
long lead_seconds(long limit);

/// The script of the arrays. Its arguments are the folder of the submission, the line of its task 0, and the program:
/// no path stands in its text.
std::string job_script(const Resources& resources, const Engine& engine);

/// The script of the job that ingests what was computed. Its arguments are the store, the program, and the study.
std::string ingest_script(const Engine& engine);

}  // namespace seapile::cluster
