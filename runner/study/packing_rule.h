// As many packings as narrow a band: what "replicates" may ask for instead of a number.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runner/study/json_value.h"

namespace seapile::study {

struct PackingRule {
  std::int64_t at_least = 0, at_most = 0;  ///< packings of every case; two or more
  std::string metric;     ///< "bed:NAME" is one of the drive's bed; with a "*" at its end all that begin like this
  double half_width = 0;  ///< of the 95 % interval of the mean, as a share of the mean
};

/// Whether "replicates" is meant as a rule: it says something that only a rule has.
bool is_packing_rule(const Value& replicates);

/// Absent after a problem.
std::optional<PackingRule> read_packing_rule(const Value& replicates, base::Problems& problems);

}  // namespace seapile::study
