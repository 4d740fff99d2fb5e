// What a site asks of every job: engines/<name>.json. Its members:
//   "engine"     "slurm"
//   "account", "partition", "qos"      as sbatch takes them
//   "modules"    [names] that `module load` loads before a case
//   "setup"      [lines] of shell that are run before a case, as they stand
//   "sbatch"     [arguments] for sbatch, before those of the command line
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seapile::cluster {

struct Engine {
  std::string engine = "slurm";
  std::string account, partition, qos;
  std::vector<std::string> modules, setup, sbatch;
};

/// Throws study::BadInput with every problem of the file.
Engine read_engine(const std::filesystem::path& file);

/// The site's words for sbatch.
std::vector<std::string> sbatch_words(const Engine& engine);

}  // namespace seapile::cluster
