// Work in a child process, so that what crashes or never ends takes nothing along.
//
// The child is a fork that executes nothing: the work is a function of this program, with all that it refers to. That
// is safe for work in one thread that takes no lock of ours, and Gmsh is such work:
// - Of the parent's threads only the calling one goes on in the child. The others are those of a crew, which wait for
//   the next job and hold no lock between two (solver/base/crew.h), and no job calls this. glibc's malloc may be used
//   after a fork.
// - The parent uses no OpenMP, and never starts Gmsh itself, so that the child's first parallel region misses no
//   threads. Gmsh runs with one thread.
// - The child ends by _exit: nothing of the parent's is flushed, closed or destroyed twice.
// - It lets go of the parent's descriptors at once: locks, files, and the pipe by which others see that the parent has
//   ended. What it prints goes nowhere.
// - It ends with the thread that called, by a signal from the system.
// - Signals that ask a run to stop are the parent's to answer: the child ignores them, also where they go to a whole
//   process group, so that a run that is stopped and gone on with has the mesh of one that was not. Of all others the
//   parent's handlers are taken off.
#pragma once

#include <functional>
#include <string>

namespace seapile::mesh {

/// How a child has ended.
struct Ending {
  std::string answer;   ///< what it returned
  std::string trouble;  ///< "ended by signal 11", or empty when the answer is there
  bool in_time = true;  ///< otherwise it was killed
};

/// Returns what `work` returns in a child of this process, which has ended then. A child that has not answered after
/// `patience` [s] is killed. Only what the parent waits counts, not the time in which it was itself stopped. Throws
/// std::system_error when there is no child to be had.
Ending in_child(const std::function<std::string()>& work, double patience);

}  // namespace seapile::mesh
