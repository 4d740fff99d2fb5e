// What a study's results are compared with: published values, or bounds that it sets itself, each of certain cases. No
// part of any case's identity.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/problem.h"

namespace seapile::study {

struct Case;
struct CheckText;

/// A published value, or bounds, and the cases that they are of.
struct Reference {
  double value = 0, tolerance = 0;          ///< as written; the tolerance is positive
  std::optional<double> at_least, at_most;  ///< one of them is there: bounds, and no published value
  std::string unit;                         ///< of all; "": the metric's own
  std::string reason;                       ///< of the tolerance
  std::string place;  ///< where it is written, for messages: "\"reference/tip.csv\" line 3"; "" in the study
  std::vector<std::size_t> cases;  ///< of the study, by index
};

/// A metric of finished cases and what is known of it.
struct Check {
  std::string pointer;  ///< its place in the study: "/checks/0"
  std::string metric;
  std::string source;  ///< where the values are from; "": bounds need no source
  double drift = 0;    ///< relative change of our own value that is no drift
  std::vector<Reference> references;
};

/// Relative change of a metric that is within what the solver promises: another machine may round a power or a sine
/// otherwise; anything more is another result.
inline constexpr double kDrift = 1e-6;

/// Reads the reference files and finds the cases of each value. `folder`: the study's. With `all_match` a value that no
/// case is of is a problem; the command line may take cases away from a study that is right.
std::vector<Check> find_checks(const std::vector<CheckText>& texts, const std::filesystem::path& folder,
                               const std::vector<Case>& cases, bool all_match, base::Problems& problems);

}  // namespace seapile::study
