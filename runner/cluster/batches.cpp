#include "runner/cluster/batches.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace seapile::cluster {

using execute::Kind;

std::size_t cases_per_task(double pace, double batch_seconds, double limit_seconds) {
  if (!(pace > 0)) return 1;
  const double wanted = std::ceil(batch_seconds / pace), fitting = std::floor(limit_seconds / (2 * pace));
  return static_cast<std::size_t>(std::clamp(std::min(wanted, fitting), 1.0, 10'000.0));
}

std::vector<Array> make_arrays(const execute::Plan& plan, const std::vector<bool>& wanted, std::size_t most_tasks,
                               const std::function<std::size_t(Kind)>& cases_per_task) {
  // In the order in which they are submitted, so that whatever waits follows what it waits for.
  std::vector<std::size_t> beds, flows, ready, waiting;
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    const execute::Task& task = plan.tasks[i];
    if (!wanted[i]) continue;
    if (task.kind == Kind::bed) {
      beds.push_back(i);
    } else if (task.kind == Kind::flow) {
      flows.push_back(i);
    } else {
      (task.bed && wanted[*task.bed] ? waiting : ready).push_back(i);
    }
  }
  std::ranges::stable_sort(waiting, {}, [&](std::size_t i) { return *plan.tasks[i].bed; });

  std::vector<Array> arrays;
  std::map<std::size_t, std::size_t> array_of;  // by the plan's task
  std::size_t line = 0;
  for (const std::vector<std::size_t>* group : {&beds, &flows, &ready, &waiting}) {
    if (group->empty()) continue;
    const Kind kind = plan.tasks[group->front()].kind;
    const std::size_t together = std::max<std::size_t>(1, cases_per_task(kind));
    for (std::size_t begin = 0; begin < group->size(); begin += together) {
      if (begin % (together * most_tasks) == 0) arrays.push_back({kind, line, {}, {}});
      Array& array = arrays.back();
      const auto end = std::min(begin + together, group->size());
      array.tasks.emplace_back(group->begin() + static_cast<std::ptrdiff_t>(begin),
                               group->begin() + static_cast<std::ptrdiff_t>(end));
      ++line;
      for (const std::size_t i : array.tasks.back()) {
        array_of[i] = arrays.size() - 1;
        if (group == &waiting) array.after.insert(array_of.at(*plan.tasks[i].bed));
      }
    }
  }
  return arrays;
}

}  // namespace seapile::cluster
