#include "runner/present/replicates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace seapile::present {
namespace {

using store::Cell;
using store::ColumnKind;
using store::Table;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kDone = "completed";

/// A query's answer: two tips, three packings of one and two of the other, in the order of a study.
Table answer() {
  Table table;
  table.columns = {"case", "run", "kind", "outcome", "pile.tip", "speed", "bed.seed", "q_c", "pile.depth"};
  table.units = {"", "", "", "", "", "", "", "Pa", "m"};
  table.kinds = {ColumnKind::identity, ColumnKind::identity, ColumnKind::identity,
                 ColumnKind::outcome,  ColumnKind::label,    ColumnKind::label,
                 ColumnKind::label,    ColumnKind::metric,   ColumnKind::parameter};
  const auto add = [&](const std::string& tip, const std::string& seed, double q, double depth) {
    table.rows.push_back({tip + seed, "0001", "drive", kDone, tip, "0.4 m/s", seed, q, depth});
  };
  add("flat", "1", 10, 1.2);
  add("flat", "2", 12, 1.2);
  add("flat", "3", 17, 1.2);
  add("conical", "1", 5, 1.2);
  add("conical", "2", 7, 1.0);
  return table;
}

double number(const Cell& cell) { return std::get<double>(cell); }

TEST(Group, PackingsOfACaseBecomeOneRowWithTheirNumberAndInterval) {
  const Grouped found = group_query(answer());
  EXPECT_EQ(found.table.columns,
            (std::vector<std::string>{"pile.tip", "speed", "n", "q_c.mean", "q_c.low", "q_c.high", "pile.depth"}));
  EXPECT_EQ(found.table.units, (std::vector<std::string>{"", "m/s", "", "Pa", "Pa", "Pa", "m"}));
  EXPECT_EQ(found.means, std::vector<std::size_t>{3});
  ASSERT_EQ(found.table.rows.size(), 2u);
  const auto& flat = found.table.rows[0];
  EXPECT_EQ(flat[0], Cell{std::string("flat")});
  EXPECT_EQ(flat[1], Cell{0.4});
  EXPECT_EQ(flat[2], Cell{3.0});
  EXPECT_EQ(flat[3], Cell{13.0});
  // Mean 13, sample variance (9 + 1 + 16) / 2 = 13, t_0.975(2) = 4.302653.
  EXPECT_NEAR(number(flat[5]) - 13, 4.302653 * std::sqrt(13.0 / 3), 1e-5);
  EXPECT_NEAR(13 - number(flat[4]), 4.302653 * std::sqrt(13.0 / 3), 1e-5);
  EXPECT_EQ(found.least, 2u);
  EXPECT_EQ(found.most, 3u);
}

TEST(Group, WhatPackingsDoNotAgreeInIsLeftOpen) {
  const Grouped found = group_query(answer());
  EXPECT_EQ(found.table.rows[0][6], Cell{1.2});
  EXPECT_EQ(found.table.rows[1][6], Cell{});
}

TEST(Group, ARunThatIsNotCompletedIsLeftOutAndMentioned) {
  Table each = answer();
  each.rows[2][3] = std::string("diverged");
  const Grouped found = group_query(each);
  EXPECT_EQ(found.table.rows[0][2], Cell{2.0});
  EXPECT_EQ(found.table.rows[0][3], Cell{11.0});
  EXPECT_THAT(remark(found, Format::csv), HasSubstr("1 run is not completed and left out"));
}

TEST(Group, ACaseWithoutACompletedRunKeepsItsRow) {
  Table each = answer();
  for (auto& row : each.rows) row[3] = std::string("diverged");
  const Grouped found = group_query(each);
  ASSERT_EQ(found.table.rows.size(), 2u);
  EXPECT_EQ(found.table.rows[0][2], Cell{0.0});
  EXPECT_EQ(found.table.rows[0][3], Cell{});
}

TEST(Group, ANumberThatOnePackingLacksHasNoMean) {
  Table each = answer();
  each.rows[1][7] = Cell{};
  const Grouped found = group_query(each);
  EXPECT_EQ(found.table.rows[0][2], Cell{3.0});
  EXPECT_EQ(found.table.rows[0][3], Cell{});
  EXPECT_EQ(found.table.rows[1][3], Cell{6.0});
}

TEST(Group, OnePackingHasAValueAndNoInterval) {
  Table each = answer();
  each.rows.resize(1);
  const Grouped found = group_query(each);
  EXPECT_EQ(found.table.rows[0][3], Cell{10.0});
  EXPECT_EQ(found.table.rows[0][4], Cell{});
  EXPECT_EQ(found.table.rows[0][5], Cell{});
  EXPECT_THAT(remark(found, Format::table), HasSubstr("one packing: no interval"));
}

TEST(Group, ATotalIsSummed) {
  const Table each{{"tip", "CPU"}, {"", "s"}, {{std::string("flat"), 1.5}, {std::string("flat"), 2.0}}};
  const Grouped found = group(each, {Role::key, Role::total});
  EXPECT_EQ(found.table.rows[0], (std::vector<Cell>{std::string("flat"), 2.0, 3.5}));
}

TEST(Remark, TellsWhatTheIntervalIsAndWhichRowsHaveNone) {
  Table each = answer();
  EXPECT_THAT(remark(group_query(each), Format::table), HasSubstr("95 % interval"));
  EXPECT_THAT(remark(group_query(each, 0.9), Format::table), HasSubstr("90 % interval"));
  EXPECT_THAT(remark(group_query(each), Format::csv), IsEmpty());
  EXPECT_THAT(remark(group_query(each), Format::table), Not(HasSubstr("one packing")));
  each.rows.resize(4);
  EXPECT_THAT(remark(group_query(each), Format::table), HasSubstr("n = 1 is one packing: no interval"));
  each.rows.push_back({"x", "0001", "drive", "diverged", "round", "0.4 m/s", "1", {}, 1.2});
  EXPECT_THAT(remark(group_query(each), Format::table), HasSubstr("n = 1 is one packing: no interval"));
}

TEST(HasReplicates, WhereTheSeedIsALabelNotWhereItIsAParameter) {
  Table each = answer();
  EXPECT_TRUE(has_replicates(each));
  each.kinds[6] = ColumnKind::parameter;
  EXPECT_FALSE(has_replicates(each));
}

TEST(TextOfMeans, ShowsMeanAndHalfWidthWithTheDigitsThatTheHalfWidthAllows) {
  const Table table{{"q_c.mean", "q_c.low", "q_c.high"},
                    {"Pa", "Pa", "Pa"},
                    {{44312.0, 43112.0, 45512.0}, {102000.0, 91700.0, 112300.0}, {7000.0, {}, {}}, {{}, {}, {}}}};
  const std::string text = present::text(table, Format::table, {0});
  EXPECT_THAT(text, HasSubstr(" 44.3 ±  1.2\n"));
  EXPECT_THAT(text, HasSubstr("102.0 ± 10.3\n"));
  EXPECT_THAT(text, HasSubstr(" 7.0\n"));
  EXPECT_THAT(text, HasSubstr(" -\n"));
  EXPECT_THAT(text, HasSubstr(" q_c\n"));
  EXPECT_THAT(text, HasSubstr(" kPa\n"));
}

TEST(TextOfMeans, AnUnevenIntervalShowsItsEnds) {
  const Table table{{"ratio.mean", "ratio.low", "ratio.high"}, {"", "", ""}, {{1.52, 1.41, 1.65}}};
  EXPECT_THAT(present::text(table, Format::table, {0}), HasSubstr("1.52 (1.41 to 1.65)\n"));
}

TEST(ReadQuantities, AColumnOfOneUnitBecomesNumbersAndAnyOtherStays) {
  Table table{{"a", "b"}, {"", ""}, {{"0.06 m/s", "1 m"}, {"0.4 m/s", "flat"}, {{}, {}}}};
  read_quantities(table, 0);
  read_quantities(table, 1);
  EXPECT_EQ(table.units, (std::vector<std::string>{"m/s", ""}));
  EXPECT_EQ(table.rows[1][0], Cell{0.4});
  EXPECT_EQ(table.rows[0][1], Cell{std::string("1 m")});
}

}  // namespace
}  // namespace seapile::present
