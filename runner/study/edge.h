// Where a scene stops holding: one value of it, bisected between one that holds and one that does not.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runner/study/json_value.h"
#include "runner/study/schema.h"
#include "solver/base/problem.h"

namespace seapile::study {

/// What a run has to keep to, in the metric's own unit.
struct Invariant {
  std::string metric;
  std::optional<double> at_least, at_most;
};

struct Edge {
  Path path;
  const SchemaNode* node = nullptr;
  PlacePtr place;
  double good = 0, bad = 0;           ///< the ends; positive, in SI units; either may be the larger
  double within = 0.05;               ///< ratio of first bad and last good, less 1, at which the search ends
  std::vector<Invariant> invariants;  ///< beside that the run reaches its end
};

/// The member "edge" of a study; absent when it has none and after a problem.
std::optional<Edge> read_edge(const Value& document, base::Problems& problems);

}  // namespace seapile::study
