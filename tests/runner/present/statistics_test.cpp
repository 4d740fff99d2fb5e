#include "runner/present/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "solver/base/random.h"

namespace seapile::present {
namespace {

using Values = std::vector<double>;

/// The extra hours of sleep of ten patients under two drugs (Cushny and Peebles 1905), the example of Student, "The
/// probable error of a mean", Biometrika 6 (1908), and R's data set "sleep", whose t.test() is quoted below.
const Values kFirstDrug = {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
const Values kSecondDrug = {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};

/// Normal values, each a function of its place alone (Box and Muller 1958).
Values normal_values(std::size_t count, double mean, double sd, std::uint32_t stream, std::uint64_t sample) {
  Values values;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t at = 2 * (1000 * sample + i);
    const double radius = std::sqrt(-2 * std::log(1 - base::uniform(7, stream, at)));
    values.push_back(mean + sd * radius * std::cos(2 * std::numbers::pi * base::uniform(7, stream, at + 1)));
  }
  return values;
}

/// Share of 4000 samples for which `holds`.
double share(auto holds) {
  int count = 0;
  for (std::uint64_t sample = 0; sample < 4000; ++sample) count += holds(sample) ? 1 : 0;
  return count / 4000.0;
}

TEST(StudentQuantile, IsAsTabulated) {
  // Table 12 of Pearson and Hartley, Biometrika Tables for Statisticians I, 1966, as in every textbook.
  const struct {
    double probability, degrees, value;
  } table[] = {{0.975, 1, 12.706}, {0.975, 2, 4.303},  {0.975, 4, 2.776}, {0.975, 7, 2.365},
               {0.975, 10, 2.228}, {0.975, 30, 2.042}, {0.95, 4, 2.132},  {0.95, 7, 1.895},
               {0.95, 9, 1.833},   {0.995, 7, 3.499},  {0.995, 9, 3.250}, {0.975, 120, 1.980}};
  for (const auto& [probability, degrees, value] : table) {
    EXPECT_NEAR(student_quantile(probability, degrees), value, 5e-4) << probability << " " << degrees;
    EXPECT_DOUBLE_EQ(student_quantile(1 - probability, degrees), -student_quantile(probability, degrees));
  }
  // With one degree of freedom it is Cauchy's, with two it is algebraic.
  EXPECT_NEAR(student_quantile(0.9, 1), std::tan(std::numbers::pi * 0.4), 1e-12);
  EXPECT_NEAR(student_quantile(0.9, 2), 0.8 * std::sqrt(2 / (1 - 0.64)), 1e-12);
}

TEST(MeanInterval, OfAWorkedExample) {
  // 1 2 3 4 5: the mean is 3, the sample's standard deviation sqrt(2.5), t_0.975(4) = 2.776445.
  const Interval found = mean_interval(Values{1, 2, 3, 4, 5});
  EXPECT_EQ(found.n, 5u);
  EXPECT_DOUBLE_EQ(found.mean, 3);
  EXPECT_NEAR(found.high - found.mean, 2.776445 * std::sqrt(2.5 / 5), 1e-6);
  EXPECT_NEAR(found.mean - found.low, found.high - found.mean, 1e-12);
}

TEST(MeanInterval, OneValueHasNoneAndNoneHasNoMean) {
  const Interval one = mean_interval(Values{42});
  EXPECT_EQ(one.n, 1u);
  EXPECT_EQ(one.mean, 42);
  EXPECT_TRUE(std::isnan(one.low) && std::isnan(one.high));
  EXPECT_TRUE(std::isnan(mean_interval(Values{}).mean));
}

TEST(MeanInterval, OfEqualValuesHasNoWidth) {
  const Interval found = mean_interval(Values(8, 0.4));
  EXPECT_EQ(found.mean, 0.4);
  EXPECT_EQ(found.low, 0.4);
  EXPECT_EQ(found.high, 0.4);
}

TEST(MeanInterval, CoversTheTrueMeanInNineteenOfTwentySamples) {
  for (const std::size_t n : {2u, 3u, 5u, 8u}) {
    const double covered = share([&](std::uint64_t sample) {
      const Interval found = mean_interval(normal_values(n, 44.3, 1.7, static_cast<std::uint32_t>(n), sample));
      return found.low < 44.3 && 44.3 < found.high;
    });
    EXPECT_GT(covered, 0.94) << n;
    EXPECT_LT(covered, 0.96) << n;
  }
}

TEST(MeanInterval, IsWiderAtAHigherLevelAndKeepsItsDigitsFarFromZero) {
  EXPECT_GT(mean_interval(kFirstDrug, 0.99).high, mean_interval(kFirstDrug, 0.95).high);
  Values far;
  for (const double value : {0.0, 1.0, 2.0}) far.push_back(1e9 + value);
  EXPECT_NEAR(mean_interval(far).high - 1e9 - 1, student_quantile(0.975, 2) / std::sqrt(3), 1e-6);
}

TEST(PairedDifference, OfStudentsExample) {
  // R: t.test(extra ~ group, data = sleep, paired = TRUE): t = -4.0621, df = 9, 95 %: -2.4598858 -0.7001142.
  const Estimate difference = paired_difference(kFirstDrug, kSecondDrug);
  EXPECT_NEAR(difference.value, 1.58, 1e-12);
  EXPECT_EQ(difference.degrees_of_freedom, 9);
  EXPECT_NEAR(difference.value / difference.standard_error, 4.0621, 5e-5);
  EXPECT_NEAR(interval(difference).low, 0.7001142, 5e-8);
  EXPECT_NEAR(interval(difference).high, 2.4598858, 5e-8);
}

TEST(WelchDifference, OfStudentsExample) {
  // R: t.test(extra ~ group, data = sleep): t = -1.8608, df = 17.776, 95 %: -3.3654832 0.2054832.
  const Estimate difference = welch_difference(kFirstDrug, kSecondDrug);
  EXPECT_NEAR(difference.value, 1.58, 1e-12);
  EXPECT_NEAR(difference.value / difference.standard_error, 1.8608, 5e-5);
  EXPECT_NEAR(difference.degrees_of_freedom, 17.776, 5e-4);
  EXPECT_NEAR(interval(difference).low, -0.2054832, 5e-8);
  EXPECT_NEAR(interval(difference).high, 3.3654832, 5e-8);
}

TEST(WelchDifference, CoversADifferenceOfGroupsOfUnequalSizeAndScatter) {
  const double covered = share([](std::uint64_t sample) {
    const Interval found =
        interval(welch_difference(normal_values(5, 10, 4, 11, sample), normal_values(9, 13, 1, 12, sample)));
    return found.low < 3 && 3 < found.high;
  });
  EXPECT_GT(covered, 0.94);
  EXPECT_LT(covered, 0.96);
}

TEST(PairedDifference, IsSharperThanTheGroupsWherePackingsHaveMuchInCommon) {
  const Values a = normal_values(8, 40, 3, 21, 0);
  Values b;
  const Values noise = normal_values(8, 1, 0.3, 22, 0);
  for (std::size_t i = 0; i < a.size(); ++i) b.push_back(a[i] + noise[i]);
  const Interval paired = interval(paired_difference(a, b)), apart = interval(welch_difference(a, b));
  EXPECT_LT(5 * (paired.high - paired.low), apart.high - apart.low);
  EXPECT_NEAR(paired.mean, apart.mean, 1e-12);
}

TEST(PairedRatio, IsTheGeometricMeanAndReadsTheSameTheOtherWayRound) {
  const Values a = {40, 44, 50, 38}, b = {60, 63, 77, 55};
  const Interval forth = paired_ratio(a, b), back = paired_ratio(b, a);
  EXPECT_NEAR(forth.mean, std::pow(60. * 63 * 77 * 55 / (40. * 44 * 50 * 38), 0.25), 1e-12);
  EXPECT_NEAR(forth.mean * back.mean, 1, 1e-12);
  EXPECT_NEAR(forth.low * back.high, 1, 1e-12);
  EXPECT_GT(paired_ratio(a, b, 0.99).high, forth.high);
  EXPECT_LT(forth.low, forth.mean);
  EXPECT_LT(forth.mean, forth.high);
}

TEST(PairedRatio, CoversTheTrueRatioOfPairsThatScatterTogether) {
  const double covered = share([](std::uint64_t sample) {
    const Values packing = normal_values(6, std::log(44), 0.1, 31, sample);
    const Values rest = normal_values(6, std::log(1.5), 0.03, 32, sample);
    Values a, b;
    for (std::size_t i = 0; i < packing.size(); ++i) {
      a.push_back(std::exp(packing[i]));
      b.push_back(std::exp(packing[i] + rest[i]));
    }
    const Interval found = paired_ratio(a, b);
    return found.low < 1.5 && 1.5 < found.high;
  });
  EXPECT_GT(covered, 0.94);
  EXPECT_LT(covered, 0.96);
}

TEST(PairedRatio, RefusesWhatHasNoRatio) {
  EXPECT_THROW(paired_ratio(Values{1, 2}, Values{1}), std::invalid_argument);
  EXPECT_THROW(paired_ratio(Values{1, 0}, Values{1, 1}), std::invalid_argument);
  EXPECT_THROW(paired_ratio(Values{1, 1}, Values{1, -1}), std::invalid_argument);
  EXPECT_THROW(paired_difference(Values{1, 2}, Values{1}), std::invalid_argument);
}

/// A difference with ten degrees of freedom: t_0.95 = 1.812, t_0.975 = 2.228.
Estimate difference(double value, double standard_error) { return {11, value, standard_error, 10}; }

TEST(Equivalence, FollowsTheIntervalAndTheMargin) {
  EXPECT_EQ(equivalence(difference(0, 1), 2).verdict, Verdict::equivalent);
  EXPECT_EQ(equivalence(difference(3, 1), 2).verdict, Verdict::different);
  EXPECT_EQ(equivalence(difference(-3, 1), 2).verdict, Verdict::different);
  EXPECT_EQ(equivalence(difference(1, 1), 2).verdict, Verdict::not_distinguishable);
  EXPECT_EQ(equivalence(difference(2, 1), 2).verdict, Verdict::underpowered);
  EXPECT_EQ(equivalence(difference(-2, 1), 2).verdict, Verdict::underpowered);
  EXPECT_EQ(equivalence(difference(0, 5), 2).verdict, Verdict::underpowered);
}

TEST(Equivalence, WithinTheMarginIsEquivalentEvenWhereTheDifferenceIsNotZero) {
  const Equivalence found = equivalence(difference(0.5, 0.1), 1);
  EXPECT_GT(found.difference.low, 0);
  EXPECT_EQ(found.verdict, Verdict::equivalent);
}

TEST(Equivalence, OnePairSaysNothing) {
  const Equivalence found = equivalence(mean_of(Values{0.0}), 1);
  EXPECT_EQ(found.verdict, Verdict::underpowered);
  EXPECT_TRUE(std::isinf(found.resolved_margin));
}

TEST(Equivalence, TheResolvedMarginIsTheSmallestThatIsCalledEquivalent) {
  for (const double value : {0.0, 0.7, -1.3}) {
    const double resolved = equivalence(difference(value, 0.4), 1).resolved_margin;
    EXPECT_NEAR(resolved, std::abs(value) + 1.812461 * 0.4, 1e-6);
    EXPECT_EQ(equivalence(difference(value, 0.4), resolved).verdict, Verdict::equivalent);
    EXPECT_NE(equivalence(difference(value, 0.4), resolved * (1 - 1e-9)).verdict, Verdict::equivalent);
  }
}

TEST(Equivalence, MethodsThatDifferByTheMarginAreCalledEquivalentOnceInTwenty) {
  const double called = share([](std::uint64_t sample) {
    return equivalence(mean_of(normal_values(8, 2, 1, 41, sample)), 2).verdict == Verdict::equivalent;
  });
  EXPECT_GT(called, 0.04);
  EXPECT_LT(called, 0.06);
}

TEST(Equivalence, RefusesMarginsAndRisksThatMeanNothing) {
  EXPECT_THROW(equivalence(difference(0, 1), 0), std::invalid_argument);
  EXPECT_THROW(equivalence(difference(0, 1), -1), std::invalid_argument);
  EXPECT_THROW(equivalence(difference(0, 1), 1, 0.5), std::invalid_argument);
  EXPECT_THROW(interval(difference(0, 1), 1), std::invalid_argument);
}

TEST(Equivalence, EveryVerdictHasItsWords) {
  EXPECT_EQ(words(Verdict::equivalent), "equivalent");
  EXPECT_EQ(words(Verdict::different), "different");
  EXPECT_EQ(words(Verdict::not_distinguishable), "not distinguishable");
  EXPECT_EQ(words(Verdict::underpowered), "underpowered");
}

TEST(EquivalencePower, GivesThePublishedSampleSizes) {
  // Two-period crossover, limits 80 to 125 %, ratio 1, power 80 %: Diletti, Hauschke and Steinijans, Int. J. Clin.
  // Pharmacol. 29 (1991), table 1; Hauschke, Steinijans and Pigeot, Bioequivalence Studies in Drug Development, 2007,
  // table 5.1. The standard error is s sqrt(2/n) with n - 2 degrees of freedom and s^2 = ln(1 + CV^2).
  const struct {
    double variation;
    int subjects;
  } table[] = {{0.10, 6}, {0.15, 10}, {0.20, 16}, {0.25, 24}, {0.30, 32}};
  for (const auto& [variation, subjects] : table) {
    const auto power = [s = std::sqrt(std::log1p(variation * variation))](int n) {
      return equivalence_power(std::log(1.25), s * std::sqrt(2.0 / n), n - 2);
    };
    EXPECT_GE(power(subjects), 0.8) << variation;
    EXPECT_LT(power(subjects - 2), 0.8) << variation;
  }
}

TEST(EquivalencePower, IsTheShareOfSamplesThatAreCalledEquivalent) {
  for (const std::size_t n : {3u, 5u, 12u}) {
    for (const double ratio : {0.3, 0.6, 1.2}) {
      const double called = share([&](std::uint64_t sample) {
        const Values values = normal_values(n, 0, ratio, static_cast<std::uint32_t>(60 + n), sample);
        return equivalence(mean_of(values), 1).verdict == Verdict::equivalent;
      });
      const auto count = static_cast<double>(n);
      // The standard error of such a share is at most 0.8 %.
      EXPECT_NEAR(equivalence_power(1, ratio / std::sqrt(count), count - 1), called, 0.03) << n << " " << ratio;
    }
  }
}

TEST(SampleNeeded, IsEnoughAndNoneLessIs) {
  for (const double ratio : {0.5, 1.0, 2.0}) {
    const std::size_t needed = sample_needed(ratio, 1);
    const auto power = [&](std::size_t n, std::uint32_t stream) {
      return share([&](std::uint64_t sample) {
        return equivalence(mean_of(normal_values(n, 0, ratio, stream, sample)), 1).verdict == Verdict::equivalent;
      });
    };
    // Of 4000 samples; the standard error of such a share is 0.6 %.
    EXPECT_GT(power(needed, 51), 0.8 - 0.018) << ratio;
    EXPECT_LT(power(needed - 1, 52), 0.8 + 0.018) << ratio;
    EXPECT_GE(equivalence_power(1, ratio / std::sqrt(static_cast<double>(needed)), static_cast<double>(needed) - 1),
              0.8);
    EXPECT_LT(equivalence_power(1, ratio / std::sqrt(static_cast<double>(needed - 1)), static_cast<double>(needed) - 2),
              0.8);
  }
}

TEST(SampleNeeded, OfManyPairsIsAsForTheNormalDistribution) {
  // (z_0.95 + z_0.9)^2 = 8.564 times (sd / margin)^2, as of Chow, Shao and Wang, Sample Size Calculations, 2008, 3.1.3.
  EXPECT_NEAR(static_cast<double>(sample_needed(10, 1)), 856.4, 2.5);
  EXPECT_EQ(sample_needed(0, 1), 2u);
  EXPECT_THROW(sample_needed(1e4, 1), std::invalid_argument);
  EXPECT_THROW(sample_needed(1, 0), std::invalid_argument);
}

}  // namespace
}  // namespace seapile::present
