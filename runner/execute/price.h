// What a case will cost, by what cases like it have cost. Nothing is guessed: a case without a run like it has no
// price.
//
// Two runs are computed alike when every parameter is equal but those that say how much is computed (grains, depth,
// speed, duration) and those that only change its numbers (materials, seeds). Of the runs computed alike, those with as
// much to compute count, the latest 20 of them; where there are none, those nearest in amount, up to a factor of 10,
// scaled by it. The amount is the number of grains times the duration: steps are as long where runs are computed alike.
// Neglected: that contacts and iterations change with materials and with depth.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runner/execute/plan.h"
#include "runner/store/past_cost.h"
#include "runner/study/study.h"

namespace seapile::execute {

struct Price {
  double cpu_seconds = 0;  ///< [s]
  double memory_mb = 0;    ///< largest resident memory [MB]
  double bytes = 0;        ///< on disk
  std::size_t runs = 0;    ///< that it was made from
  bool scaled = false;     ///< from runs with more or less to compute
};

/// The history as prices are looked up in it.
class PriceList {
 public:
  explicit PriceList(const std::vector<store::PastCost>& history);

  /// Of a case of this kind and scene; absent without a run like it. What is left of an interrupted run is not
  /// reckoned.
  std::optional<Price> price(const std::string& kind, const scene::SceneSpec& scene) const;

 private:
  struct Cost {
    double cpu_seconds, memory_mb, bytes;
  };
  using Amount = std::pair<double, double>;  ///< grains [-] and duration [s]; 1 where the kind has none
  std::map<std::string, std::map<Amount, std::vector<Cost>>> alike_;  ///< by how they are computed
};

using Prices = std::vector<std::optional<Price>>;

/// One per task of the plan; none for what is fresh, and none at all where there is no catalogue yet. Throws
/// store::StoreError.
Prices prices_of(const study::Study& study, const Plan& plan, const std::filesystem::path& root);

/// The median price [CPU s] of the cases of a kind that are to be run; absent when none has a price.
std::optional<double> typical_cpu_seconds(const Plan& plan, const Prices& prices, Kind kind);

/// What is left to be done of a plan.
struct Estimate {
  std::size_t to_run = 0;    ///< cases that are not fresh
  std::size_t unpriced = 0;  ///< those of them without history
  double cpu_seconds = 0;    ///< of the priced ones [s]
  double largest_mb = 0;     ///< largest memory of one case [MB]
  double bytes = 0;          ///< on disk
  double wall_seconds = 0;   ///< at least, on `cores` cores [s]: a drive waits for its bed
};

/// `prices`: one per task of the plan.
Estimate estimate(const Plan& plan, const Prices& prices, int cores);

}  // namespace seapile::execute
