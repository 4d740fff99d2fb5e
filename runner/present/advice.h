// Which of the levels that were measured is the cheapest that holds a tolerance.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace seapile::present {

/// A level as one recorded frontier has it.
struct MeasuredLevel {
  std::string name;
  double cpu_seconds = std::numeric_limits<double>::quiet_NaN();  ///< of a run of the scene that was measured
  double error = std::numeric_limits<double>::quiet_NaN();        ///< relative, signed [-]
  double bound = std::numeric_limits<double>::quiet_NaN();        ///< of its size, 95 % [-]
  std::size_t runs = 0, asked = 0;
};

/// One frontier that was recorded.
struct MeasuredFrontier {
  std::string study;  ///< its name
  std::vector<MeasuredLevel> levels;
  double work = 1;  ///< of its scene, in the measure that costs are scaled by
};

struct Advice {
  std::optional<std::size_t> level;  ///< of the first frontier; absent: none that was measured holds
  double bound = 0;                  ///< largest over the frontiers that have the level
  std::vector<std::string> measured_in, lacking_in;  ///< frontiers that have the level, and others
  double cpu_seconds = 0;            ///< of the scene asked about, scaled by work
  /// Where none holds: the level with the smallest bound.
  std::optional<std::size_t> closest;
  double closest_bound = 0;
};

/// The level of the first frontier with the least cost of those whose bound, in every frontier that has the level, is
/// at most `tolerance`, and of whose runs all have a result. One that all frontiers have goes before those that some
/// lack, whatever it costs: less evidence is no advantage. `may_use`: by the first frontier's levels; a level that
/// makes another scene is not for use. `work`: of the scene asked about.
Advice advise(const std::vector<MeasuredFrontier>& frontiers, const std::vector<bool>& may_use, double tolerance,
              double work);

}  // namespace seapile::present
