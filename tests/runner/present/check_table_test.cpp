#include "runner/present/check_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace seapile::present {
namespace {

using store::Cell;
using testing::HasSubstr;
using testing::Not;

const std::string kId(64, 'a');

Comparison published(const std::string& tip, const std::vector<double>& values) {
  return {Against::published,
          "q_c",
          "Pa",
          std::vector<std::string>(values.size(), kId),
          {{"pile.tip", tip}},
          values,
          30000,
          1500,
          "Somebody (2024)",
          "read off a figure"};
}

Comparison accepted(double value) {
  return {Against::accepted,        "q_c",      "Pa", {kId}, {{"pile.tip", "flat"}}, {value}, 30000, 0.03,
          "run 0001 with grains=3", "looked at"};
}

TEST(CheckText, DigitsFollowTheToleranceAndTheSourceStandsBelow) {
  EXPECT_EQ(check_text({published("flat", {30512.3456}), published("conical", {31000, 31100, 31200})}),
            "metric  case        pile.tip  n  value       unit  reference  difference  tolerance  verdict  source\n"
            "------  ----------  --------  -  ----------  ----  ---------  ----------  ---------  -------  ------\n"
            "q_c     aaaaaaaaaa  flat      1        30.5  kPa        30.0         0.5        1.5  ok            1\n"
            "q_c     -           conical   3  31.1 ± 0.2  kPa        30.0         1.1        1.5  ok            1\n"
            "\n"
            "source 1: Somebody (2024)\n");
}

TEST(CheckText, DriftIsATableOfItsOwnWithTheDigitsThatItNeeds) {
  const std::string shown = check_text({published("flat", {30000.05}), accepted(30000.05)});
  EXPECT_THAT(shown, HasSubstr("\ndrift\n\nmetric"));
  EXPECT_THAT(shown, HasSubstr("30.000050  kPa   30.000000    0.000050   0.000030  FAILED\n"));
}

TEST(CheckText, WhatIsNotThereIsADash) {
  Comparison missing = published("flat", {});
  missing.case_ids = {kId, kId};
  Comparison open = accepted(30512.3456);
  open.reference.reset();
  open.tolerance = 0;
  const std::string shown = check_text({missing, open});
  EXPECT_THAT(shown, HasSubstr("0 of 2      -  kPa        30.0           -        1.5  missing"));
  EXPECT_THAT(shown, HasSubstr("30.5123  kPa"));
  EXPECT_THAT(shown, HasSubstr("-           -          -  not accepted yet"));
}

TEST(CheckText, AValueFarBelowItsToleranceStillShowsDigits) {
  Comparison far = published("flat", {33});
  far.reference = 5e6;
  far.tolerance = 1e6;
  EXPECT_THAT(check_text({far}), HasSubstr("0.0000  MPa      5.0000     -5.0000     1.0000  FAILED"));
  far.values = {33752};
  EXPECT_THAT(check_text({far}), HasSubstr("0.034  MPa       5.000      -4.966      1.000  FAILED"));
}

Comparison bounded(double value) {
  Comparison comparison = published("flat", {value});
  comparison.against = Against::bounds;
  comparison.metric = "drift";
  comparison.unit = "-";
  comparison.reference.reset();
  comparison.tolerance = 0;
  comparison.source = comparison.reason = "";
  comparison.at_most = 1e-10;
  return comparison;
}

TEST(CheckText, BoundsAreATableOfTheirOwn) {
  const std::string shown = check_text({published("flat", {30000}), bounded(3e-13)});
  EXPECT_THAT(shown, HasSubstr("source 1: Somebody (2024)\n\nbounds\n\nmetric"));
  EXPECT_THAT(shown, HasSubstr("3e-13  -            -    1e-10  ok"));
  EXPECT_THAT(shown, Not(HasSubstr("source 2")));
  EXPECT_TRUE(check_text({bounded(3e-13)}).starts_with("bounds\n"));
}

TEST(CheckTable, HasTheBoundsInColumnsOfTheirOwn) {
  const store::Table table = check_table({bounded(3e-13), published("flat", {30000})});
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(table.columns, name) - table.columns.begin());
  };
  EXPECT_EQ(table.rows[0][column("against")], Cell{"bounds"});
  EXPECT_EQ(table.rows[0][column("at_most")], Cell{1e-10});
  EXPECT_EQ(table.rows[0][column("at_least")], Cell{});
  EXPECT_EQ(table.rows[0][column("reference")], Cell{});
  EXPECT_EQ(table.rows[0][column("verdict")], Cell{"ok"});
  EXPECT_EQ(table.rows[1][column("at_most")], Cell{});
}

TEST(CheckRemark, SaysByWhichBoundAValueIsTooLarge) {
  EXPECT_EQ(check_remark({bounded(3e-10)}, false), "FAILED  drift, pile.tip=flat: 3e-10, at most 1e-10\n");
  EXPECT_EQ(check_remark({bounded(std::nan(""))}, false), "FAILED  drift, pile.tip=flat: is no number\n");
  EXPECT_EQ(check_remark({bounded(1e-10)}, false), "");
}

TEST(CheckText, EachSourceIsNamedOnce) {
  Comparison other = published("flat", {30000});
  other.source = "Nobody (2023)";
  const std::string shown = check_text({published("flat", {30000}), other, published("conical", {30000})});
  EXPECT_THAT(shown, HasSubstr("source 1: Somebody (2024)\nsource 2: Nobody (2023)\n"));
  EXPECT_THAT(shown, Not(HasSubstr("source 3")));
}

TEST(CheckRemark, ALineForEachFailureWithTheReasonOrTheNote) {
  const std::string lines =
      check_remark({published("flat", {40000}), published("conical", {30000}), accepted(30001)}, true);
  EXPECT_THAT(lines, HasSubstr("FAILED  q_c, pile.tip=flat: 10.0 kPa away, tolerance 1.5 kPa (read off a figure)\n"));
  EXPECT_THAT(lines, HasSubstr("FAILED  q_c, pile.tip=flat: 0.001000 kPa away, tolerance 0.000030 kPa; accepted of run "
                               "0001 with grains=3 (looked at)\n"));
  EXPECT_THAT(lines, Not(HasSubstr("conical")));
}

TEST(CheckRemark, SaysHowFarTheNumbersCarry) {
  EXPECT_THAT(check_remark({published("flat", {30000})}, true), HasSubstr("one packing: no interval"));
  EXPECT_EQ(check_remark({published("jet", {30000})}, false), "");
  EXPECT_THAT(check_remark({published("flat", {30000, 30001})}, true), HasSubstr("± is the 95 % interval"));
  EXPECT_THAT(check_remark({published("flat", {20000, 40000})}, true), HasSubstr("underpowered: half of the interval"));
  Comparison missing = published("flat", {});
  missing.case_ids = {kId};
  EXPECT_THAT(check_remark({missing}, true), HasSubstr("missing: a case has no completed result"));
}

TEST(CheckTable, HasEveryDigitInTheMetricsOwnUnit) {
  const store::Table table = check_table({published("flat", {31000, 31100, 31200}), accepted(30000.05)});
  EXPECT_EQ(table.columns, (std::vector<std::string>{"against", "metric", "case", "pile.tip", "n", "value", "low",
                                                     "high", "unit", "reference", "difference", "tolerance", "at_least",
                                                     "at_most", "verdict", "source", "reason"}));
  const auto& mean = table.rows.at(0);
  EXPECT_EQ(mean[0], Cell{"published"});
  EXPECT_EQ(mean[2], Cell{});
  EXPECT_EQ(mean[4], Cell{3.0});
  EXPECT_EQ(mean[5], Cell{31100.0});
  EXPECT_NEAR(std::get<double>(mean[7]) - std::get<double>(mean[6]), 2 * 4.302653 * 100 / std::sqrt(3.0), 1e-3);
  EXPECT_EQ(mean[8], Cell{"Pa"});
  EXPECT_EQ(mean[10], Cell{1100.0});
  EXPECT_EQ(mean[14], Cell{"ok"});
  EXPECT_EQ(mean[16], Cell{"read off a figure"});
  const auto& drift = table.rows.at(1);
  EXPECT_EQ(drift[0], Cell{"accepted"});
  EXPECT_EQ(drift[2], Cell{"aaaaaaaaaa"});
  EXPECT_EQ(drift[6], Cell{});
  EXPECT_EQ(drift[14], Cell{"FAILED"});
}

}  // namespace
}  // namespace seapile::present
