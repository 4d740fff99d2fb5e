// How the cases of a plan become arrays of a batch system: pure functions, nothing is asked or written.
#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "runner/execute/plan.h"

namespace seapile::cluster {

/// One array: its tasks are lines of cases.txt, each with one case or several short ones.
struct Array {
  execute::Kind kind = execute::Kind::drive;
  std::size_t first = 0;                        ///< line of its task 0, from 0
  std::vector<std::vector<std::size_t>> tasks;  ///< the plan's tasks that each runs, one after another
  std::set<std::size_t> after;                  ///< arrays that it waits for: its beds are there
};

/// Cases of a kind for one array task, so that it takes at least about `batch_seconds`; `pace`: median CPU time [s] of
/// such a case, 0: not known, one by one. At most so many that they fit `limit_seconds` twice.
std::size_t cases_per_task(double pace, double batch_seconds, double limit_seconds);

/// Arrays of at most `most_tasks` tasks for those tasks of the plan that `wanted` names, beds first. Drives whose bed
/// is among them are in arrays of their own, by the order of their beds, and wait for the arrays of those.
std::vector<Array> make_arrays(const execute::Plan& plan, const std::vector<bool>& wanted, std::size_t most_tasks,
                               const std::function<std::size_t(execute::Kind)>& cases_per_task);

}  // namespace seapile::cluster
