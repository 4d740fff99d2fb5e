#include "runner/present/advice.h"

#include <algorithm>
#include <cmath>

namespace seapile::present {

Advice advise(const std::vector<MeasuredFrontier>& frontiers, const std::vector<bool>& may_use, double tolerance,
              double work) {
  Advice advice;
  advice.closest_bound = std::numeric_limits<double>::infinity();
  if (frontiers.empty()) return advice;
  const MeasuredFrontier& first = frontiers.front();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < first.levels.size(); ++i) {
    if (!may_use[i]) continue;
    const MeasuredLevel& level = first.levels[i];
    double bound = level.bound;
    std::vector<std::string> measured_in, lacking_in;
    bool complete = level.runs > 0 && level.runs == level.asked;
    for (const MeasuredFrontier& other : frontiers) {
      const auto found = std::ranges::find(other.levels, level.name, &MeasuredLevel::name);
      (found == other.levels.end() ? lacking_in : measured_in).push_back(other.study);
      if (found == other.levels.end()) continue;
      complete = complete && found->runs == found->asked;
      if (!(found->bound <= bound)) bound = found->bound;  // also when it is none
    }
    if (!complete || std::isnan(bound)) continue;
    if (bound < advice.closest_bound) {
      advice.closest = i;
      advice.closest_bound = bound;
    }
    const bool everywhere = lacking_in.empty(), known_better = advice.level && advice.lacking_in.empty();
    if (bound <= tolerance &&
        (everywhere > known_better || (everywhere == known_better && level.cpu_seconds < least))) {
      advice.measured_in = std::move(measured_in);
      advice.lacking_in = std::move(lacking_in);
      least = level.cpu_seconds;
      advice.level = i;
      advice.bound = bound;
      advice.cpu_seconds = level.cpu_seconds * work / first.work;
    }
  }
  return advice;
}

}  // namespace seapile::present
