// What a study says and no case of it heeds.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "runner/study/grammar.h"
#include "runner/study/problem_collector.h"

namespace seapile::study {

/// What became of the combinations of a study.
struct Tally {
  std::size_t kept = 0;                           ///< cases that are not excluded
  std::size_t drives = 0, basins = 0;             ///< of them those that are recorded
  std::map<std::string_view, std::size_t> kinds;  ///< of those cases, by water_of()
  std::vector<std::size_t> excluded, met;         ///< cases that each exclude and each when matched
  std::set<const Assignment*> used_settings;
  std::set<std::string> choices;  ///< members of `model` that a case has a choice about
};

/// What never takes effect was meant otherwise. The command line may make a study's conditions idle, and a study with
/// other problems is not judged. `total`: combinations.
void report_idle(const Grammar& grammar, const Tally& tally, std::size_t total, ProblemCollector& collector);

}  // namespace seapile::study
