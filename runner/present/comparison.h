// One number of a study beside what it is compared with: a published value, bounds, or our own value that was accepted.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "runner/present/replicates.h"
#include "runner/present/statistics.h"
#include "runner/present/table.h"

namespace seapile::present {

enum class Against { published, bounds, accepted };

struct Comparison {
  Against against = Against::published;
  std::string metric, unit;
  std::vector<std::string> case_ids;                  ///< several: packings of the same case
  Labels labels;                                      ///< the seed apart where there are several
  std::vector<double> values;                         ///< of the cases that are finished
  std::optional<double> reference;                    ///< absent: nothing was accepted yet, or there are bounds instead
  double tolerance = 0;                               ///< in the metric's unit
  std::string source;                                 ///< where the reference is from
  std::string reason;                                 ///< why the tolerance is right, or the accepted value
  std::optional<double> at_least = {}, at_most = {};  ///< bounds
};

enum class Finding {
  ok,
  failed,        ///< the mean is further away than the tolerance, or beyond a bound
  missing,       ///< a case has no completed result
  underpowered,  ///< the packings say less than the tolerance asks
  not_accepted,  ///< no failure
};

/// "ok", "FAILED", "missing", "underpowered", "not accepted yet".
std::string words(Finding finding);

struct Judgement {
  Finding finding = Finding::missing;
  Interval mean;          ///< over the finished packings
  double difference = 0;  ///< mean less reference, or less the bound that it is beyond; NaN where one of them is absent
};

/// The first that holds: not accepted yet, missing, FAILED where the whole interval is beyond the tolerance,
/// underpowered where half of it is wider than the tolerance, FAILED where the mean is beyond the tolerance, ok. One
/// packing has no interval, and its value decides. Of bounds the mean decides, and what lies on one is within.
Judgement judge(const Comparison& comparison);

/// A case's number as the store has it.
struct Measured {
  std::string case_id;
  Labels labels;
  std::optional<double> value;  ///< absent: no completed result
};

/// One comparison like `one` for each case, packings of the same case together, in the order of first occurrence.
std::vector<Comparison> over_packings(const Comparison& one, const std::vector<Measured>& cases);

}  // namespace seapile::present
