#include "runner/present/claim.h"

#include <fmt/format.h>

#include <cmath>

namespace seapile::present {
namespace {

/// Numbers of both sides in packings that have them.
struct Pairs {
  std::vector<double> of, over;
  std::string trouble;  ///< of the packings that have not; "" when all have
};

Pairs pairs_of(const Claimed& claim) {
  Pairs pairs;
  const bool two = claim.compared != Compared::value;
  std::size_t absent = 0;
  for (const auto& [of, over] : claim.packings) {
    if (!of || (two && !over)) {
      ++absent;
      continue;
    }
    const auto usable = [&](double value) {
      return std::isfinite(value) && (claim.compared != Compared::ratio || value > 0);
    };
    if (const double wrong = !usable(*of) ? *of : two && !usable(*over) ? *over : 1.0; !usable(wrong)) {
      pairs.trouble = fmt::format("a value is {:.6g}, which has no {}", wrong, words(claim.compared));
      continue;
    }
    pairs.of.push_back(*of);
    if (two) pairs.over.push_back(*over);
  }
  if (absent > 0)
    pairs.trouble = fmt::format("{} of {} packings have no completed result", absent, claim.packings.size());
  return pairs;
}

Estimate estimate_of(const Claimed& claim, const Pairs& pairs) {
  switch (claim.compared) {
    case Compared::value:
      return mean_of(pairs.of);
    case Compared::ratio:
      return paired_log_ratio(pairs.over, pairs.of);
    case Compared::difference:
      return paired_difference(pairs.over, pairs.of);
  }
  return {};
}

/// The number of one packing, with no way round by logarithms.
double single(const Claimed& claim, const Pairs& pairs) {
  if (claim.compared == Compared::value) return pairs.of[0];
  return claim.compared == Compared::ratio ? pairs.of[0] / pairs.over[0] : pairs.of[0] - pairs.over[0];
}

}  // namespace

std::string words(Compared compared) {
  return compared == Compared::value ? "value" : compared == Compared::ratio ? "ratio" : "difference";
}

ClaimVerdict judge(const Claimed& claim) {
  const Pairs pairs = pairs_of(claim);
  const bool ratio = claim.compared == Compared::ratio;
  const Estimate estimate = estimate_of(claim, pairs);
  ClaimVerdict verdict;
  verdict.trouble = pairs.trouble;
  verdict.estimate = interval(estimate);
  if (ratio) {
    for (double* number : {&verdict.estimate.mean, &verdict.estimate.low, &verdict.estimate.high})
      *number = std::exp(*number);
  }
  if (pairs.of.size() == 1) verdict.estimate.mean = single(claim, pairs);
  if (!pairs.trouble.empty()) return verdict;
  if (claim.deterministic) {
    const double value = verdict.estimate.mean;
    const bool holds = claim.side == Side::above ? value >= claim.bound : value <= claim.bound;
    verdict.decision = holds ? Decision::confirmed : Decision::refuted;
    return verdict;
  }
  const double bound = ratio ? std::log(claim.bound) : claim.bound;
  const double margin = ratio ? std::log1p(claim.margin) : claim.margin;
  verdict.decision = test_bound(estimate, claim.side, bound, margin);
  if (verdict.decision == Decision::underpowered && estimate.n > 1) {
    const double sd = estimate.standard_error * std::sqrt(static_cast<double>(estimate.n));
    verdict.needed = sample_to_decide(sd, std::abs(estimate.value - bound), margin);
  }
  return verdict;
}

std::string words(const ClaimVerdict& verdict) { return verdict.decision ? words(*verdict.decision) : "missing"; }

Standing standing(const Claimed& claim, const ClaimVerdict& verdict) {
  if (!verdict.decision) return Standing::undecided;
  if (claim.expect.empty() || words(verdict) == claim.expect) return Standing::fine;
  return verdict.decision == Decision::underpowered ? Standing::undecided : Standing::contrary;
}

}  // namespace seapile::present
