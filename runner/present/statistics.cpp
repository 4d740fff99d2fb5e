#include "runner/present/statistics.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace seapile::present {
namespace {

constexpr std::size_t kMostPairs = 1'000'000;

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

double mean(std::span<const double> values) {
  // What is the same everywhere has no scatter, not even that of rounding.
  if (std::ranges::all_of(values, [&](double value) { return value == values[0]; })) return values[0];
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Of the sample: divisor n - 1. In two passes, so that a small scatter about a large mean is not rounded away.
double variance(std::span<const double> values) {
  const double middle = mean(values);
  double sum = 0;
  for (const double value : values) sum += (value - middle) * (value - middle);
  return sum / static_cast<double>(values.size() - 1);
}

/// The smallest sample of two or more that is enough, where more never is less; absent beyond kMostPairs.
std::optional<std::size_t> smallest_sample(const auto& enough) {
  // Double until it is enough, then halve the gap.
  std::size_t high = 2;
  while (!enough(high)) {
    if (high >= kMostPairs) return {};
    high *= 2;
  }
  std::size_t low = high / 2;  // not enough, or 1
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (enough(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace

double student_quantile(double probability, double degrees_of_freedom) {
  require(probability > 0 && probability < 1, "a probability lies between 0 and 1");
  require(degrees_of_freedom > 0, "degrees of freedom are positive");
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), probability);
}

Estimate mean_of(std::span<const double> values) {
  Estimate estimate;
  estimate.n = values.size();
  if (values.empty()) return estimate;
  estimate.value = mean(values);
  if (values.size() < 2) return estimate;
  const auto n = static_cast<double>(values.size());
  estimate.standard_error = std::sqrt(variance(values) / n);
  estimate.degrees_of_freedom = n - 1;
  return estimate;
}

Estimate paired_difference(std::span<const double> a, std::span<const double> b) {
  require(a.size() == b.size(), "pairs need two samples of one length");
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(b[i] - a[i]);
  return mean_of(differences);
}

Estimate paired_log_ratio(std::span<const double> a, std::span<const double> b) {
  require(a.size() == b.size(), "pairs need two samples of one length");
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size(); ++i) {
    require(a[i] > 0 && b[i] > 0, "a ratio needs positive values");
    ratios.push_back(std::log(b[i] / a[i]));
  }
  return mean_of(ratios);
}

Estimate welch_difference(std::span<const double> a, std::span<const double> b) {
  Estimate estimate;
  estimate.n = std::min(a.size(), b.size());
  if (estimate.n == 0) return estimate;
  estimate.value = mean(b) - mean(a);
  if (estimate.n < 2) return estimate;
  const auto na = static_cast<double>(a.size()), nb = static_cast<double>(b.size());
  const double va = variance(a) / na, vb = variance(b) / nb;
  estimate.standard_error = std::sqrt(va + vb);
  // Two groups without any scatter: every number of degrees of freedom gives the same interval, of no width.
  const double denominator = va * va / (na - 1) + vb * vb / (nb - 1);
  estimate.degrees_of_freedom = denominator > 0 ? (va + vb) * (va + vb) / denominator : na + nb - 2;
  return estimate;
}

Interval interval(const Estimate& estimate, double level) {
  require(level > 0 && level < 1, "the level of an interval lies between 0 and 1");
  Interval result;
  result.n = estimate.n;
  result.mean = estimate.value;
  if (!(estimate.degrees_of_freedom > 0)) return result;
  const double half = student_quantile(0.5 + level / 2, estimate.degrees_of_freedom) * estimate.standard_error;
  result.low = estimate.value - half;
  result.high = estimate.value + half;
  return result;
}

Interval mean_interval(std::span<const double> values, double level) { return interval(mean_of(values), level); }

Interval paired_ratio(std::span<const double> a, std::span<const double> b, double level) {
  const Interval logarithm = interval(paired_log_ratio(a, b), level);
  return {logarithm.n, std::exp(logarithm.mean), std::exp(logarithm.low), std::exp(logarithm.high)};
}

std::string words(Verdict verdict) {
  switch (verdict) {
    case Verdict::equivalent:
      return "equivalent";
    case Verdict::different:
      return "different";
    case Verdict::not_distinguishable:
      return "not distinguishable";
    case Verdict::underpowered:
      return "underpowered";
  }
  return "";
}

Equivalence equivalence(const Estimate& difference, double margin, double alpha) {
  require(margin > 0 && std::isfinite(margin), "a margin is positive");
  require(alpha > 0 && alpha < 0.5, "the risk alpha lies between 0 and 0.5");
  Equivalence result;
  result.margin = margin;
  result.difference = interval(difference, 1 - alpha);
  if (!(difference.degrees_of_freedom > 0)) return result;
  const double reach = student_quantile(1 - alpha, difference.degrees_of_freedom) * difference.standard_error;
  result.resolved_margin = std::abs(difference.value) + reach;
  const double low = result.difference.low, high = result.difference.high;
  if (result.resolved_margin <= margin) {
    result.verdict = Verdict::equivalent;
  } else if (low > 0 || high < 0) {
    result.verdict = Verdict::different;
  } else if (low > -2 * margin && high < 2 * margin) {
    result.verdict = Verdict::not_distinguishable;
  }
  return result;
}

double equivalence_power(double margin, double standard_error, double degrees_of_freedom, double alpha) {
  require(margin > 0, "a margin is positive");
  require(standard_error >= 0, "a standard error is not negative");
  if (standard_error == 0) return 1;
  const double t = student_quantile(1 - alpha, degrees_of_freedom), reach = margin / standard_error;
  const boost::math::chi_squared square(degrees_of_freedom);
  const boost::math::normal normal;
  // With the sample's deviation u times the true one, the tests reject when |value| < margin - t u standard_error.
  const auto chance = [&](double u) {
    const double density = 2 * degrees_of_freedom * u * boost::math::pdf(square, degrees_of_freedom * u * u);
    return density * (2 * boost::math::cdf(normal, reach - t * u) - 1);
  };
  // Beyond 12 of its own standard deviations nothing of u is left.
  const double spread = 12 / std::sqrt(2 * degrees_of_freedom);
  const double from = std::max(0.0, 1 - spread), to = std::min(1 + spread, reach / t);
  if (from >= to) return 0;
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(chance, from, to, 8, 1e-10);
}

std::size_t sample_needed(double sd, double margin, double power, double alpha) {
  require(sd >= 0 && std::isfinite(sd), "a standard deviation is not negative");
  require(power > 0 && power < 1, "a power lies between 0 and 1");
  const auto enough = [&](std::size_t n) {
    const auto count = static_cast<double>(n);
    return equivalence_power(margin, sd / std::sqrt(count), count - 1, alpha) >= power;
  };
  const auto needed = smallest_sample(enough);
  require(needed.has_value(), "more than a million pairs would be needed");
  return *needed;
}

std::optional<std::size_t> sample_for_half_width(double sd, double half_width, double level) {
  require(sd >= 0, "a standard deviation is not negative");
  require(half_width >= 0, "a half-width is not negative");
  return smallest_sample([&](std::size_t n) {
    const auto count = static_cast<double>(n);
    return student_quantile(0.5 + level / 2, count - 1) * sd / std::sqrt(count) <= half_width;
  });
}

std::string words(Decision decision) {
  switch (decision) {
    case Decision::confirmed:
      return "confirmed";
    case Decision::refuted:
      return "refuted";
    case Decision::not_distinguishable:
      return "not distinguishable";
    case Decision::underpowered:
      return "underpowered";
  }
  return "";
}

Decision test_bound(const Estimate& estimate, Side side, double bound, double margin, double alpha) {
  require(margin > 0 && std::isfinite(margin), "a margin is positive");
  require(alpha > 0 && alpha < 0.5, "the risk alpha lies between 0 and 0.5");
  if (!(estimate.degrees_of_freedom > 0)) return Decision::underpowered;
  const double reach = student_quantile(1 - alpha, estimate.degrees_of_freedom) * estimate.standard_error;
  const double beyond = side == Side::above ? estimate.value - bound : bound - estimate.value;
  if (beyond > reach) return Decision::confirmed;
  if (beyond < -reach) return Decision::refuted;
  const Interval both = interval(estimate, 1 - alpha);
  const bool within = both.low > bound - 2 * margin && both.high < bound + 2 * margin;
  return within ? Decision::not_distinguishable : Decision::underpowered;
}

double bound_power(double distance, double sd, std::size_t n, double alpha) {
  require(distance >= 0, "a distance is not negative");
  require(sd >= 0, "a standard deviation is not negative");
  require(n >= 2, "a test needs two values");
  if (distance == 0) return alpha;
  constexpr double kCertain = 30;  // standard errors: beyond it the chance is 1, and its series is long
  const double away = distance * std::sqrt(static_cast<double>(n)) / sd;
  const auto degrees = static_cast<double>(n - 1);
  const double t = student_quantile(1 - alpha, degrees);
  if (!(away < kCertain + t)) return 1;
  return boost::math::cdf(boost::math::complement(boost::math::non_central_t(degrees, away), t));
}

std::optional<std::size_t> sample_to_decide(double sd, double distance, double margin, double power, double alpha) {
  require(sd >= 0 && std::isfinite(sd), "a standard deviation is not negative");
  require(margin > 0 && std::isfinite(margin), "a margin is positive");
  require(power > 0 && power < 1, "a power lies between 0 and 1");
  // A number `distance` away stays within 2 margins at least as often as one on the bound within so much less.
  const double room = 2 * margin - distance;
  return smallest_sample([&](std::size_t n) {
    if (bound_power(distance, sd, n, alpha) >= power) return true;
    const auto count = static_cast<double>(n);
    return room > 0 && equivalence_power(room, sd / std::sqrt(count), count - 1, alpha / 2) >= power;
  });
}

}  // namespace seapile::present
