// Problems that many cases of a study share, each told once.
#pragma once

#include <set>
#include <string>
#include <tuple>

#include "solver/base/problem.h"

namespace seapile::study {

/// Problems, each once.
class ProblemCollector {
 public:
  explicit ProblemCollector(base::Problems& problems) : problems_(problems) {
    for (const auto& problem : problems) seen_.insert(key(problem));
  }
  bool empty() const { return problems_.empty(); }
  void add(const base::Problem& problem) {
    if (seen_.insert(key(problem)).second) problems_.push_back(problem);
  }
  /// Of several problems at one place only the first is told.
  void add_once_at(const base::Problem& problem) {
    if (places_.insert(problem.pointer).second) add(problem);
  }

 private:
  using Key = std::tuple<std::string, std::string, std::string>;
  static Key key(const base::Problem& problem) { return {problem.pointer, problem.what, problem.allowed}; }

  base::Problems& problems_;
  std::set<Key> seen_;
  std::set<std::string> places_;
};

}  // namespace seapile::study
