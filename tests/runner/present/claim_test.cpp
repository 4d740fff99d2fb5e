#include "runner/present/claim.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace seapile::present {
namespace {

using testing::HasSubstr;
using Pairs = std::vector<std::pair<std::optional<double>, std::optional<double>>>;

/// The ratio of two sides is more than 1, with a margin of 5 %.
Claimed ratio(const Pairs& packings) {
  Claimed claim;
  claim.text = "grows";
  claim.metric = "q_c";
  claim.unit = "-";
  claim.compared = Compared::ratio;
  claim.bound = 1;
  claim.margin = 0.05;
  claim.packings = packings;
  return claim;
}

/// The mean is more than 10 Pa, with a margin of 1 Pa.
Claimed value(const std::vector<double>& values) {
  Claimed claim = ratio({});
  claim.compared = Compared::value;
  claim.unit = "Pa";
  claim.bound = 10;
  claim.margin = 1;
  for (const double one : values) claim.packings.emplace_back(one, std::nullopt);
  return claim;
}

std::string verdict(const Claimed& claim) { return words(judge(claim)); }

TEST(Claim, ARatioIsOfPairsSoThatWhatPackingsHaveInCommonCancels) {
  // Both sides scatter by a factor of two, their ratios 1.10, 1.12 and 1.08 hardly at all.
  const ClaimVerdict found = judge(ratio({{11, 10}, {22.4, 20}, {5.4, 5}}));
  EXPECT_EQ(found.decision, Decision::confirmed);
  EXPECT_NEAR(found.estimate.mean, std::cbrt(1.10 * 1.12 * 1.08), 1e-12);
  // By hand: logarithms 0.0953102, 0.1133287, 0.0769610, mean 0.0952000, standard deviation 0.0181841;
  // t_0.975(2) = 4.302653 gives 0.0951999 -+ 0.0451720.
  EXPECT_NEAR(found.estimate.low, std::exp(0.0952000 - 0.0451720), 1e-5);
  EXPECT_NEAR(found.estimate.high, std::exp(0.0952000 + 0.0451720), 1e-5);
}

TEST(Claim, IsConfirmedByTheOneSidedBoundAlsoWhereTheTwoSidedIntervalHoldsTheBound) {
  // Logarithms 0.02, 0.06, 0.10: mean 0.06, standard error 0.0230940; t_0.95(2) = 2.919986 reaches 0.067434 and
  // t_0.95 of 0.0200 less suffices.
  const auto of = [](double shift) {
    return ratio({{std::exp(0.02 + shift), 1}, {std::exp(0.06 + shift), 1}, {std::exp(0.10 + shift), 1}});
  };
  EXPECT_EQ(verdict(of(0.0074)), "underpowered");
  EXPECT_EQ(verdict(of(0.0075)), "confirmed");
  EXPECT_LT(judge(of(0.0075)).estimate.low, 1);
  EXPECT_EQ(verdict(of(-0.1275)), "refuted");
  EXPECT_EQ(verdict(of(-0.1274)), "underpowered");
}

TEST(Claim, AtMostIsTheOtherSide) {
  Claimed claim = ratio({{11, 10}, {22.4, 20}, {5.4, 5}});
  claim.side = Side::below;
  EXPECT_EQ(verdict(claim), "refuted");
  claim.bound = 1.2;
  EXPECT_EQ(verdict(claim), "confirmed");
}

TEST(Claim, TheMarginOfARatioIsAFactorToEitherSide) {
  // Logarithms -0.02, 0, 0.02: the interval reaches 0.0496836, two margins 2 ln(1 + margin).
  Claimed claim = ratio({{std::exp(-0.02), 1}, {1, 1}, {std::exp(0.02), 1}});
  claim.margin = std::expm1(0.02485);
  EXPECT_EQ(verdict(claim), "not distinguishable");
  claim.margin = std::expm1(0.02483);
  EXPECT_EQ(verdict(claim), "underpowered");
}

TEST(Claim, ADifferenceIsInTheMetricsUnit) {
  Claimed claim = ratio({{11, 10}, {21.2, 20}, {5.9, 5}});
  claim.compared = Compared::difference;
  claim.bound = 0.5;
  EXPECT_EQ(verdict(claim), "confirmed");
  EXPECT_NEAR(judge(claim).estimate.mean, (1 + 1.2 + 0.9) / 3, 1e-12);
  claim.bound = 1.5;
  EXPECT_EQ(verdict(claim), "refuted");
}

TEST(Claim, OfOneCaseTheMeanIsTestedAndDoesNotDecideByItself) {
  EXPECT_EQ(verdict(value({11, 12, 13})), "confirmed");
  EXPECT_EQ(verdict(value({8, 14, 12})), "underpowered") << "the mean is 11.3";
  EXPECT_EQ(verdict(value({7, 8, 7.5})), "refuted");
  EXPECT_EQ(verdict(value({9.9, 10.1, 10})), "not distinguishable");
}

TEST(Claim, WhereTheValueDecidesTheBoundBelongsToTheClaim) {
  Claimed claim = value({10});
  claim.deterministic = true;
  EXPECT_EQ(verdict(claim), "confirmed");
  claim.packings[0].first = std::nextafter(10.0, 9.0);
  EXPECT_EQ(verdict(claim), "refuted");
  claim.side = Side::below;
  EXPECT_EQ(verdict(claim), "confirmed");
  Claimed two = ratio({{0.3, 0.1}});
  two.deterministic = true;
  two.bound = 0.3 / 0.1;
  EXPECT_EQ(verdict(two), "confirmed") << "the quotient itself, not by way of its logarithm";
}

TEST(Claim, OnePackingIsUnderpoweredAndTellsNotWhatIsNeeded) {
  const ClaimVerdict found = judge(ratio({{100, 1}}));
  EXPECT_EQ(found.decision, Decision::underpowered);
  EXPECT_EQ(found.needed, std::nullopt);
  EXPECT_EQ(found.estimate.mean, 100);
}

TEST(Claim, AnUnderpoweredOneTellsHowManyPackingsDecide) {
  const ClaimVerdict found = judge(value({8, 14, 12}));
  // Standard deviation 3.055, distance 1.333: by the normal approximation ((1.645 + 0.842) 3.055 / 1.333)^2 = 32.5,
  // and about 2 margins less the distance ((1.96 + 1.28) 3.055 / 0.667)^2 = 220.
  EXPECT_NEAR(static_cast<double>(found.needed.value()), 33.9, 2);
  EXPECT_FALSE(judge(value({11, 12, 13})).needed.has_value());
}

TEST(Claim, APackingWithoutAResultIsMissingWhateverTheOthersSay) {
  const ClaimVerdict found = judge(ratio({{11, 10}, {22.4, 20}, {std::nullopt, 5}, {5.4, 5}, {5.4, std::nullopt}}));
  EXPECT_FALSE(found.decision.has_value());
  EXPECT_EQ(words(found), "missing");
  EXPECT_EQ(found.trouble, "2 of 5 packings have no completed result");
  EXPECT_EQ(found.estimate.n, 3u);
  EXPECT_EQ(verdict(ratio({{std::nullopt, std::nullopt}})), "missing");
}

TEST(Claim, WhatHasNoRatioAndWhatIsNoNumberIsMissing) {
  EXPECT_EQ(judge(ratio({{11, 10}, {0, 20}})).trouble, "a value is 0, which has no ratio");
  EXPECT_EQ(judge(ratio({{11, 10}, {1, -20}})).trouble, "a value is -20, which has no ratio");
  EXPECT_EQ(verdict(ratio({{11, 10}, {1, -20}})), "missing");
  EXPECT_THAT(judge(value({std::nan(""), 1})).trouble, HasSubstr("nan"));
  EXPECT_EQ(verdict(value({-3, -4, -3.5})), "refuted");
}

TEST(Standing, WithoutAnExpectationOnlyWhatIsMissingIsUndecided) {
  for (const auto& claim : {value({11, 12, 13}), value({7, 8, 7.5}), value({8, 14, 12}), value({9.9, 10.1, 10})})
    EXPECT_EQ(standing(claim, judge(claim)), Standing::fine) << verdict(claim);
  const Claimed missing = ratio({{std::nullopt, 1}});
  EXPECT_EQ(standing(missing, judge(missing)), Standing::undecided);
}

TEST(Standing, AnExpectationIsContradictedByEveryOtherDecision) {
  const auto expecting = [](Claimed claim, const std::string& expect) {
    claim.expect = expect;
    return standing(claim, judge(claim));
  };
  const Claimed confirmed = value({11, 12, 13}), refuted = value({7, 8, 7.5}), close = value({9.9, 10.1, 10}),
                few = value({8, 14, 12});
  EXPECT_EQ(expecting(confirmed, "confirmed"), Standing::fine);
  EXPECT_EQ(expecting(refuted, "refuted"), Standing::fine);
  EXPECT_EQ(expecting(close, "not distinguishable"), Standing::fine);
  EXPECT_EQ(expecting(confirmed, "refuted"), Standing::contrary);
  EXPECT_EQ(expecting(refuted, "confirmed"), Standing::contrary);
  EXPECT_EQ(expecting(close, "confirmed"), Standing::contrary);
  EXPECT_EQ(expecting(confirmed, "not distinguishable"), Standing::contrary);
  for (const char* any : {"confirmed", "refuted", "not distinguishable"})
    EXPECT_EQ(expecting(few, any), Standing::undecided);
}

}  // namespace
}  // namespace seapile::present
