// What a study's variants are compared for: "frontier" asks what accuracy costs, "ablate" what a part does.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runner/study/json_value.h"
#include "solver/base/problem.h"

namespace seapile::study {

enum class TradeKind {
  frontier,  ///< levels of fidelity against a reference: errors, and what they cost
  ablation,  ///< parts left out or forced in against the whole: what changes, and what that saves
};

struct Trade {
  TradeKind kind = TradeKind::frontier;
  /// The variant that the others are compared with; "": none, the metrics are errors by themselves.
  std::string against;
  /// Of a frontier: the variant with steps twice as long as the reference's; what separates the two is the reference's
  /// own error at most. "": nothing is said of it.
  std::string coarser;
  std::vector<std::string> metrics;  ///< with a "*" at its end all that begin like this, as one curve
};

/// Of the members "frontier" and "ablate" of a study, of which it has one at most; absent when it has none and after a
/// problem. `variants`: the names that there are.
std::optional<Trade> read_trade(const Value& document, const std::vector<std::string>& variants,
                                base::Problems& problems);

}  // namespace seapile::study
