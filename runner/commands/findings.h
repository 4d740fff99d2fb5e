// What `runner doctor` finds: about the program and its machine, and about a store of results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seapile::commands {

enum class Health {
  ok,
  note,     ///< works, but something is worth knowing
  problem,  ///< a study cannot be run, or its results cannot be kept, before it is mended
};
const char* name(Health health);  ///< "ok", "note", "problem"

struct Finding {
  Health health = Health::ok;
  std::string area;  ///< "program", "machine", "store", "cluster"
  std::string what;
  std::string words;
};

/// The program, the mesher, gnuplot, cores and memory, the batch system.
std::vector<Finding> findings_of_machine();

/// Its file system, whether it can be written to and locked, free space, the catalogue's schema and state, runs that
/// came to no end or cannot be read, declarations of equivalence. Writes small files of its own and removes them; takes
/// no claim.
std::vector<Finding> findings_of_store(const std::filesystem::path& root);

}  // namespace seapile::commands
