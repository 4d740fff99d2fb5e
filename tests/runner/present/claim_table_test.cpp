#include "runner/present/claim_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "runner/present/check_table.h"

namespace seapile::present {
namespace {

using store::Cell;
using testing::HasSubstr;
using testing::Not;

/// The faster pile meets more resistance, of one tip.
Claimed faster(const std::string& tip, const std::vector<std::pair<double, double>>& pairs) {
  Claimed claim;
  claim.number = 12;
  claim.text = "q_c grows with the speed";
  claim.metric = "q_c";
  claim.unit = "-";
  claim.compared = Compared::ratio;
  claim.bound = 1;
  claim.margin = 0.05;
  claim.common = {{"pile.tip", tip}};
  claim.of = {{"pile.speed", "0.4 m/s"}};
  claim.over = {{"pile.speed", "0.06 m/s"}};
  for (const auto& [of, over] : pairs) claim.packings.emplace_back(of, over);
  return claim;
}

Claimed mean_above(double bound, const std::vector<double>& values) {
  Claimed claim = faster("flat", {});
  claim.number.reset();
  claim.place = 2;
  claim.text = "q_c is large";
  claim.compared = Compared::value;
  claim.unit = "Pa";
  claim.bound = bound;
  claim.margin = 500;
  claim.over = claim.of = {};
  for (const double one : values) claim.packings.emplace_back(one, std::nullopt);
  return claim;
}

const std::vector<std::pair<double, double>> kTenPerCent = {{11, 10}, {22.4, 20}, {5.4, 5}};

TEST(ClaimText, HasARowForEachPairOfCasesAndEachClaimOnceBelow) {
  EXPECT_EQ(
      claim_text(
          {faster("flat", kTenPerCent), faster("conical", kTenPerCent), mean_above(30000, {41000, 41500, 42000})}),
      "claims\n"
      "\n"
      "claim  pile.tip  of             over            n  estimate                unit  bound        margin  verdict\n"
      "-----  --------  -------------  --------------  -  ----------------------  ----  -----------  ------  "
      "---------\n"
      "12     flat      speed 0.4 m/s  speed 0.06 m/s  3  1.100 (1.051 to 1.151)  -     at least 1     0.05  "
      "confirmed\n"
      "12     conical   speed 0.4 m/s  speed 0.06 m/s  3  1.100 (1.051 to 1.151)  -     at least 1     0.05  "
      "confirmed\n"
      "(2)    flat      -              -               3  41.5 ± 1.2              kPa   at least 30     0.5  "
      "confirmed\n"
      "\n"
      "claim 12: q_c grows with the speed (ratio of q_c)\n"
      "claim (2): q_c is large (q_c)\n");
}

TEST(ClaimText, ShowsAnExpectationWhereThereIsOneAndNothingWithoutClaims) {
  EXPECT_EQ(claim_text({}), "");
  EXPECT_EQ(claim_remark({}), "");
  Claimed expected = faster("flat", kTenPerCent);
  expected.expect = "refuted";
  EXPECT_THAT(claim_text({expected}), HasSubstr("confirmed  refuted\n"));
  EXPECT_THAT(claim_text({faster("flat", kTenPerCent)}), Not(HasSubstr("expected")));
}

TEST(ClaimText, CountsThePackingsThatAreThere) {
  Claimed missing = faster("flat", kTenPerCent);
  missing.packings.emplace_back(std::nullopt, 3);
  EXPECT_THAT(claim_text({missing}), HasSubstr("3 of 4"));
}

TEST(ClaimRemark, SaysWhatWasNotExpected) {
  Claimed claim = faster("flat", kTenPerCent);
  EXPECT_THAT(claim_remark({claim}), Not(HasSubstr("FAILED")));
  claim.expect = "refuted";
  EXPECT_THAT(claim_remark({claim}),
              HasSubstr("FAILED  claim 12, pile.tip=flat, pile.speed=0.4 m/s over pile.speed=0.06 m/s: confirmed, "
                        "expected refuted (q_c grows with the speed)\n"));
}

TEST(ClaimRemark, SaysWhatAnUnderpoweredClaimTakes) {
  EXPECT_THAT(claim_remark({mean_above(10, {8, 14, 12})}), Not(HasSubstr("underpowered"))) << "the margin is 500";
  Claimed few = mean_above(10, {8, 14, 12});
  few.margin = 1;
  EXPECT_THAT(claim_remark({few}), testing::ContainsRegex("underpowered  claim \\(2\\), pile.tip=flat: about 3[0-9] "
                                                          "packings decide, with a chance of 80 %\n"));
  EXPECT_THAT(claim_remark({mean_above(10, {8})}),
              HasSubstr("one packing says nothing of the scatter; `--seeds N` repeats every case"));
}

TEST(ClaimRemark, SaysWhatIsMissingAndWhatVerdictsRestOn) {
  Claimed missing = faster("flat", kTenPerCent);
  missing.packings.emplace_back(std::nullopt, 3);
  EXPECT_THAT(claim_remark({missing}), HasSubstr("0.06 m/s: 1 of 4 packings have no completed result\n"));
  EXPECT_THAT(claim_remark({missing}), HasSubstr("one-sided at 5 % over packings"));
  Claimed single = mean_above(10, {8});
  single.deterministic = true;
  EXPECT_EQ(claim_remark({single}), "") << "a verdict of a single value rests on nothing else";
}

TEST(WithClaims, AddsRowsAndColumnsWithEveryDigit) {
  Claimed few = mean_above(10, {8, 14, 12});
  few.margin = 1;
  few.expect = "confirmed";
  const store::Table table = with_claims(check_table({}), {faster("flat", kTenPerCent), few});
  ASSERT_EQ(table.rows.size(), 2u);
  const auto cell = [&](std::size_t row, const char* name) {
    const auto column = std::ranges::find(table.columns, name) - table.columns.begin();
    return table.rows.at(row).at(static_cast<std::size_t>(column));
  };
  EXPECT_EQ(cell(0, "against"), Cell{"claim"});
  EXPECT_EQ(cell(0, "number"), Cell{12.0});
  EXPECT_EQ(cell(0, "cases"), Cell{"pile.tip=flat"});
  EXPECT_EQ(cell(0, "of"), Cell{"pile.speed=0.4 m/s"});
  EXPECT_EQ(cell(0, "over"), Cell{"pile.speed=0.06 m/s"});
  EXPECT_EQ(cell(0, "as"), Cell{"ratio"});
  EXPECT_EQ(cell(0, "at_least"), Cell{1.0});
  EXPECT_EQ(cell(0, "at_most"), Cell{});
  EXPECT_EQ(cell(0, "margin"), Cell{0.05});
  EXPECT_EQ(cell(0, "verdict"), Cell{"confirmed"});
  EXPECT_EQ(cell(0, "needed"), Cell{});
  EXPECT_EQ(cell(0, "reason"), Cell{"q_c grows with the speed"});
  EXPECT_EQ(cell(1, "number"), Cell{});
  EXPECT_EQ(cell(1, "expect"), Cell{"confirmed"});
  EXPECT_TRUE(std::holds_alternative<double>(cell(1, "needed")));
}

TEST(WithClaims, LeavesATableWithoutClaimsAsItIs) {
  EXPECT_EQ(with_claims(check_table({}), {}).columns, check_table({}).columns);
}

}  // namespace
}  // namespace seapile::present
