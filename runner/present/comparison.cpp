#include "runner/present/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seapile::present {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

std::string words(Finding finding) {
  switch (finding) {
    case Finding::ok:
      return "ok";
    case Finding::failed:
      return "FAILED";
    case Finding::missing:
      return "missing";
    case Finding::underpowered:
      return "underpowered";
    case Finding::not_accepted:
      return "not accepted yet";
  }
  return "";
}

namespace {

bool is_complete(const Comparison& comparison) {
  return !comparison.values.empty() && comparison.values.size() == comparison.case_ids.size();
}

Judgement judge_bounds(const Comparison& comparison) {
  Judgement judgement;
  judgement.mean = mean_interval(comparison.values);
  const double mean = judgement.mean.mean;
  judgement.difference = comparison.at_least && mean < *comparison.at_least ? mean - *comparison.at_least
                         : comparison.at_most && mean > *comparison.at_most ? mean - *comparison.at_most
                                                                            : std::numeric_limits<double>::quiet_NaN();
  const bool within =
      mean >= comparison.at_least.value_or(-kInfinity) && mean <= comparison.at_most.value_or(kInfinity);
  judgement.finding = !is_complete(comparison) ? Finding::missing : within ? Finding::ok : Finding::failed;
  return judgement;
}

}  // namespace

Judgement judge(const Comparison& comparison) {
  if (comparison.against == Against::bounds) return judge_bounds(comparison);
  Judgement judgement;
  judgement.mean = mean_interval(comparison.values);
  judgement.difference =
      comparison.reference ? judgement.mean.mean - *comparison.reference : std::numeric_limits<double>::quiet_NaN();
  // Without an interval: NaN, which is neither beyond nor wider than anything.
  const double half = (judgement.mean.high - judgement.mean.low) / 2;
  const double away = std::abs(judgement.difference), tolerance = comparison.tolerance;
  judgement.finding = !comparison.reference      ? Finding::not_accepted
                      : !is_complete(comparison) ? Finding::missing
                      : away - half > tolerance  ? Finding::failed
                      : half > tolerance         ? Finding::underpowered
                      : away <= tolerance        ? Finding::ok
                                                 : Finding::failed;
  return judgement;
}

std::vector<Comparison> over_packings(const Comparison& one, const std::vector<Measured>& cases) {
  std::vector<Labels> keys;
  std::vector<Comparison> comparisons;
  for (const Measured& measured : cases) {
    Labels key = measured.labels;
    std::erase_if(key, [](const auto& label) { return label.first == kSeed; });
    const auto known = std::ranges::find(keys, key);
    const auto at = static_cast<std::size_t>(known - keys.begin());
    if (known == keys.end()) {
      comparisons.push_back(one);
      comparisons.back().labels = measured.labels;
      keys.push_back(std::move(key));
    } else {
      comparisons[at].labels = keys[at];
    }
    comparisons[at].case_ids.push_back(measured.case_id);
    if (measured.value) comparisons[at].values.push_back(*measured.value);
  }
  return comparisons;
}

}  // namespace seapile::present
