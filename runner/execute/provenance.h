// How a result was made: program, compiler, libraries, machine.
#pragma once

#include <string>

#include "runner/store/run_folder.h"

namespace seapile::execute {

/// Everything that is known before the run.
store::Provenance provenance();

/// "0.1.0 (commit 52d3b69, with changes)".
std::string version_line();

struct Cost {
  double cpu_seconds = 0;
  double wall_seconds = 0;
};

/// What this process and its children have used since it started.
Cost cost_so_far();

/// Largest resident memory of this process, or of a child of its, so far [MB].
double peak_memory_mb();

/// Memory [MB] that could be had now without swapping.
double available_memory_mb();

/// Cores that this process may use.
int usable_cores();

}  // namespace seapile::execute
