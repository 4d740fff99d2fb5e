// What several packings say about a number: intervals, effects, and whether two methods agree.
//
// Everything rests on an estimate with a standard error and its degrees of freedom, so that a mean, a difference of
// pairs and a difference of groups are treated alike. Samples are taken as independent draws; Student's t then holds
// exactly for normal values, and closely for the means of q_c, which are averages over thousands of contacts.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>

namespace seapile::present {

inline constexpr double kLevel = 0.95;  ///< of an interval, unless stated
inline constexpr double kAlpha = 0.05;  ///< risk of calling two methods equivalent that differ by the margin
inline constexpr double kPower = 0.8;   ///< chance of seeing what is there, when a sample is planned

/// A number as a sample gives it.
struct Estimate {
  std::size_t n = 0;  ///< values, pairs, or values of the smaller group
  double value = std::numeric_limits<double>::quiet_NaN();
  double standard_error = std::numeric_limits<double>::quiet_NaN();  ///< NaN: one value tells nothing of it
  double degrees_of_freedom = 0;
};

/// A number and the two ends of its confidence interval; NaN for the ends when there is none (n < 2).
struct Interval {
  std::size_t n = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();
};

/// Quantile of Student's t: the value that a variable with these degrees of freedom stays below with `probability`.
/// Throws std::invalid_argument unless 0 < probability < 1 and the degrees of freedom are positive.
double student_quantile(double probability, double degrees_of_freedom);

/// Mean; its standard error is the sample's standard deviation (divisor n - 1) over sqrt(n).
Estimate mean_of(std::span<const double> values);

/// Mean of b - a over pairs, a and b of one length: what packings have in common cancels. Throws
/// std::invalid_argument when the lengths differ.
Estimate paired_difference(std::span<const double> a, std::span<const double> b);

/// Mean of ln(b / a) over pairs. Throws std::invalid_argument when lengths differ or a value is not positive.
Estimate paired_log_ratio(std::span<const double> a, std::span<const double> b);

/// Mean of b less mean of a, of two independent groups of unequal variance: Welch (1947), with the degrees of freedom
/// of Satterthwaite (1946).
Estimate welch_difference(std::span<const double> a, std::span<const double> b);

/// Two-sided interval. Throws std::invalid_argument unless 0 < level < 1.
Interval interval(const Estimate& estimate, double level = kLevel);

/// interval(mean_of(values), level).
Interval mean_interval(std::span<const double> values, double level = kLevel);

/// Geometric mean of b / a over pairs, with its interval: exp of the interval of ln(b / a).
///
/// The logarithm, and not Fieller's ratio of two means: resistances are positive and their scatter grows with them, so
/// that it is the ratios that scatter evenly; b / a and a / b then give the same interval, read the other way round;
/// and no sample gives an unbounded interval. Throws as paired_log_ratio() does.
Interval paired_ratio(std::span<const double> a, std::span<const double> b, double level = kLevel);

enum class Verdict {
  equivalent,           ///< the difference is within the margin
  different,            ///< the difference is not zero, and not shown to be within the margin
  not_distinguishable,  ///< neither; a difference of twice the margin is excluded
  underpowered,         ///< neither; the sample is too small to say even that
};

/// "equivalent", "different", "not distinguishable", "underpowered".
std::string words(Verdict verdict);

struct Equivalence {
  Verdict verdict = Verdict::underpowered;
  Interval difference;  ///< at the level 1 - alpha
  double margin = 0;    ///< as stated
  /// The smallest margin within which this sample would be called equivalent; infinite without an interval.
  double resolved_margin = std::numeric_limits<double>::infinity();
};

/// Two one-sided tests (Schuirmann 1987), in this order:
///   equivalent           both reject at `alpha`: the interval at the level 1 - 2 alpha lies within +-margin;
///   different            the interval at the level 1 - alpha excludes zero;
///   not distinguishable  that interval lies within +-2 margin;
///   underpowered         otherwise, and without an interval.
/// `difference` is of either kind above; of a log ratio, the margin is one of logarithms. Throws std::invalid_argument
/// unless the margin is positive and 0 < alpha < 0.5.
Equivalence equivalence(const Estimate& difference, double margin, double alpha = kAlpha);

/// Chance that two one-sided tests at `alpha` find methods equivalent that do not differ at all, exact for normal
/// values: the sum over all sample deviations that they may meet (Phillips 1990).
double equivalence_power(double margin, double standard_error, double degrees_of_freedom, double alpha = kAlpha);

/// The smallest number of pairs with which equals are found equivalent with the chance `power`, when differences of
/// pairs scatter with the standard deviation `sd`. Throws std::invalid_argument unless margin > 0, sd >= 0 and
/// 0 < power < 1, or when more than a million pairs would be needed.
std::size_t sample_needed(double sd, double margin, double power = kPower, double alpha = kAlpha);

/// The smallest sample whose mean has an interval of at most this half-width, t_{(1+level)/2}(n-1) sd / sqrt(n), when
/// values scatter with the sample deviation `sd`. Absent beyond a million. Throws std::invalid_argument unless sd >= 0
/// and half_width >= 0.
std::optional<std::size_t> sample_for_half_width(double sd, double half_width, double level = kLevel);

enum class Side { above, below };  ///< of a bound

enum class Decision {
  confirmed,            ///< the number lies on the claimed side
  refuted,              ///< it lies on the other
  not_distinguishable,  ///< neither is shown; that it is twice the margin away is excluded
  underpowered,         ///< neither; the sample is too small to say even that
};

/// "confirmed", "refuted", "not distinguishable", "underpowered".
std::string words(Decision decision);

/// Tests the claim that a number lies on one side of a bound, of which `estimate` is a sample. With the one-sided
/// confidence bounds low, high = value -+ t_{1-alpha}(nu) s, nu its degrees of freedom and s its standard error, and
/// for Side::above (Side::below is its mirror image), in this order:
///   confirmed            low > bound: the test that it is at most `bound` rejects;
///   refuted              high < bound: the test that it is at least `bound` rejects;
///   not distinguishable  the two-sided interval at the level 1 - alpha lies within bound +- 2 margin;
///   underpowered         otherwise, and without an interval.
/// Error rates, exact for normal values: what is not so is confirmed with a chance of alpha on the bound and of less
/// beyond it, what is so is refuted as seldom, and a number that is 2 margins or more away is called not
/// distinguishable with a chance of alpha / 2 at most. Of a log ratio, bound and margin are logarithms. Throws
/// std::invalid_argument unless the margin is positive and 0 < alpha < 0.5.
Decision test_bound(const Estimate& estimate, Side side, double bound, double margin, double alpha = kAlpha);

/// Chance that a one-sided test at `alpha` of n values sees that their mean is `distance` beyond the bound: the
/// non-central t distribution. Throws std::invalid_argument unless distance >= 0, sd >= 0 and n >= 2.
double bound_power(double distance, double sd, std::size_t n, double alpha = kAlpha);

/// The smallest sample with which test_bound() decides, with the chance `power`, where the truth is `distance` from the
/// bound and values scatter with the standard deviation `sd`: it sees the side, or that there is nothing to see within
/// 2 margins. Absent beyond a million. Throws std::invalid_argument as sample_needed() does.
std::optional<std::size_t> sample_to_decide(double sd, double distance, double margin, double power = kPower,
                                            double alpha = kAlpha);

}  // namespace seapile::present
