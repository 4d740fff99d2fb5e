#include "runner/present/trend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "runner/present/trend_figure.h"
#include "runner/store/run_folder.h"

namespace seapile::present {
namespace {

namespace fs = std::filesystem;
using store::Cell;
using store::ColumnKind;
using store::Table;
using testing::HasSubstr;
using testing::Not;

const std::string kPrepared = "bed.preparation.solid_fraction", kSpeed = "pile.driving.constant.speed";
const TrendQuestion kQuestion = {"q_c", "bed:solid_fraction", kSpeed};

/// The answer of a catalogue: two densities, two speeds, three packings each, whose q_c is 10 kPa times the seed, half
/// as much again at the higher speed but for 1 % times (seed - 2), and twice as much in the denser bed.
Table answer() {
  Table table;
  table.columns = {"case", "run",      "kind", "outcome", kPrepared, kSpeed, "bed.seed", "bed:solid_fraction",
                   "q_c",  "bed:case", kSpeed};
  table.units = {"", "", "", "", "", "", "", "-", "Pa", "", "m/s"};
  for (int i = 0; i < 3; ++i) table.kinds.push_back(ColumnKind::identity);
  table.kinds.push_back(ColumnKind::outcome);
  for (int i = 0; i < 3; ++i) table.kinds.push_back(ColumnKind::label);
  table.kinds.insert(table.kinds.end(),
                     {ColumnKind::metric, ColumnKind::metric, ColumnKind::fact, ColumnKind::parameter});
  for (const double density : {0.80, 0.82}) {
    for (const double speed : {0.4, 0.06}) {  // The smallest need not come first.
      for (const int seed : {1, 2, 3}) {
        const double loose = 1e4 * seed * (density > 0.81 ? 2 : 1);
        const double q = speed > 0.1 ? loose * (1.5 + 0.01 * (seed - 2)) : loose;
        const std::string bed = "bed" + std::to_string(seed) + (density > 0.81 ? "d" : "l");
        table.rows.push_back({"id", "0001", "drive", "completed", density > 0.81 ? "0.82" : "0.8",
                              speed > 0.1 ? "0.4 m/s" : "0.06 m/s", std::to_string(seed), density + 1e-3 * seed, q, bed,
                              speed});
      }
    }
  }
  return table;
}

std::string complaint(const Table& table, const TrendQuestion& question) {
  try {
    trend(table, question);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Trend, ACaseIsAPointWithTheIntervalsOfItsPackings) {
  const Trend found = trend(answer(), kQuestion);
  ASSERT_EQ(found.cases.size(), 4u);
  const TrendCase& slow = found.cases[1];
  EXPECT_EQ(slow.labels, (std::vector<Cell>{0.8, 0.06}));
  EXPECT_NEAR(slow.x.mean, 0.802, 1e-12);
  EXPECT_NEAR(slow.y.mean, 2e4, 1e-9);
  // Values 1, 2, 3: standard deviation 1, t_0.975(2) = 4.302653.
  EXPECT_NEAR(slow.x.high - slow.x.mean, 4.302653e-3 / std::sqrt(3), 1e-8);
  EXPECT_NEAR(slow.y.high - slow.y.mean, 4.302653e4 / std::sqrt(3), 1e-1);
  EXPECT_EQ(slow.runs.size(), 3u);
}

TEST(Trend, TheEffectOfAnAxisIsPairedOnTheSameBed) {
  const Trend found = trend(answer(), kQuestion);
  EXPECT_EQ(found.reference, "speed 0.06 m/s");
  EXPECT_FALSE(found.cases[1].ratio);  // the reference itself
  ASSERT_TRUE(found.cases[0].ratio);
  const Interval ratio = *found.cases[0].ratio;
  EXPECT_EQ(ratio.n, 3u);
  EXPECT_NEAR(ratio.mean, std::cbrt(1.49 * 1.5 * 1.51), 1e-12);
  // The packings differ threefold, their ratios by 1 %: unpaired, the interval would hold 1.
  EXPECT_GT(ratio.low, 1.47);
  EXPECT_LT(ratio.high, 1.53);
  EXPECT_NEAR(found.cases[0].ratios[0].second, 1.49, 1e-12);
}

TEST(Trend, TheOrderOfTheRunsDoesNotMatterToAPair) {
  Table shuffled = answer();
  std::swap(shuffled.rows[0], shuffled.rows[2]);
  std::swap(shuffled.rows[3], shuffled.rows[4]);
  const Interval before = *trend(answer(), kQuestion).cases[0].ratio,
                 after = *trend(shuffled, kQuestion).cases[0].ratio;
  EXPECT_NEAR(after.low, before.low, 1e-12);
  EXPECT_NEAR(after.high, before.high, 1e-12);
}

TEST(Trend, ARunWithoutAPartnerIsLeftOutOfThePairsAndMentioned) {
  Table each = answer();
  each.rows[4][3] = std::string("diverged");  // loose, slow, seed 2
  const Trend found = trend(each, kQuestion);
  EXPECT_EQ(found.cases[0].ratio->n, 2u);
  EXPECT_EQ(found.cases[0].y.n, 3u);
  EXPECT_EQ(found.cases[1].y.n, 2u);
  EXPECT_EQ(found.unpaired, 1u);
  EXPECT_EQ(found.left_out, 1u);
  const std::string remark = trend_remark(found, Format::csv);
  EXPECT_THAT(remark, HasSubstr("1 run is not completed and left out"));
  EXPECT_THAT(remark, HasSubstr("1 run has no partner at speed 0.06 m/s"));
}

TEST(Trend, AParameterAsAbscissaHasNoScatterOfItsOwn) {
  Table each = answer();
  each.kinds[7] = ColumnKind::parameter;
  const Trend found = trend(each, kQuestion);
  EXPECT_TRUE(std::isnan(found.cases[0].x.low));
  EXPECT_FALSE(std::isnan(found.cases[0].y.low));
}

TEST(Trend, TheTableHasBothIntervalsThePairsAndTheRatio) {
  const Grouped grouped = trend_table(trend(answer(), kQuestion));
  EXPECT_EQ(grouped.table.columns,
            (std::vector<std::string>{kPrepared, kSpeed, "n", "bed:solid_fraction.mean", "bed:solid_fraction.low",
                                      "bed:solid_fraction.high", "q_c.mean", "q_c.low", "q_c.high", "pairs",
                                      "ratio.mean", "ratio.low", "ratio.high"}));
  ASSERT_EQ(grouped.table.rows.size(), 4u);
  for (const auto& row : grouped.table.rows) EXPECT_EQ(row.size(), grouped.table.columns.size());
  EXPECT_EQ(grouped.table.units.size(), grouped.table.columns.size());
  EXPECT_EQ(grouped.table.rows[0][9], Cell{3.0});
  EXPECT_EQ(grouped.table.rows[1][10], Cell{});
  EXPECT_EQ(grouped.means, (std::vector<std::size_t>{3, 6, 10}));
}

TEST(Trend, LinesAreToldApartByTheAxesButNotByTheDensityAskedFor) {
  const Trend found = trend(answer(), kQuestion);
  EXPECT_EQ(found.cases[0].series, "speed 0.4 m/s");
  EXPECT_EQ(found.cases[2].series, found.cases[0].series);
  EXPECT_NE(found.cases[1].series, found.cases[0].series);
}

TEST(Trend, WhatCannotBeAnsweredIsSaid) {
  EXPECT_THAT(complaint(answer(), {"q_c", "bed:solid_fraction", "pile.depth"}),
              HasSubstr("pile.depth is no axis of the study; its axes are"));
  EXPECT_THAT(complaint(answer(), {"q_c", "bed:solid_fraction", "bed.seed"}), HasSubstr("is no axis"));
  Table apart = answer();
  for (std::size_t i = 0; i < apart.rows.size(); ++i) apart.rows[i][9] = "bed" + std::to_string(i);
  EXPECT_THAT(complaint(apart, kQuestion), HasSubstr("same bed"));
  Table negative = answer();
  negative.rows[0][8] = -1.0;
  EXPECT_THAT(complaint(negative, kQuestion), HasSubstr("it has no ratio"));
  Table text = answer();
  text.rows[0][7] = std::string("flat");
  EXPECT_THAT(complaint(text, kQuestion), HasSubstr("bed:solid_fraction is no number"));
  Table none = answer();
  for (auto& row : none.rows) row[3] = std::string("diverged");
  EXPECT_THAT(complaint(none, kQuestion), HasSubstr("no completed run"));
  Table parameter = answer();
  parameter.kinds[8] = ColumnKind::parameter;
  EXPECT_THAT(complaint(parameter, kQuestion), HasSubstr("q_c is no metric"));
}

struct TrendFigure : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("trend_test_" + std::to_string(::getpid()));
  TrendFigure() { fs::create_directories(folder); }
  ~TrendFigure() override { fs::remove_all(folder); }
  std::string drawn(const std::string& title, const Trend& trend) const {
    draw(title, trend, folder / "a.svg");
    std::ifstream in(folder / "a.svg");
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(TrendFigure, HasAPanelForTheTrendAndOneForTheEffect) {
  const std::string svg = drawn("How does density change it?", trend(answer(), kQuestion));
  for (const char* text : {"How does density change it?", "bed:solid_fraction", "q_c (kPa)", "speed 0.4 m/s",
                           "ratio to speed 0.06 m/s, on the same bed", "95 % interval", "</svg>"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << "something was left beside the picture";
}

TEST_F(TrendFigure, WithoutAnEffectThereIsOnePanel) {
  Table each = answer();
  each.columns.pop_back(), each.units.pop_back(), each.kinds.pop_back();
  for (auto& row : each.rows) row.pop_back();
  const Trend found = trend(each, {"q_c", "bed:solid_fraction", ""});
  EXPECT_THAT(gnuplot_script("", found), Not(HasSubstr("ratio")));
  EXPECT_THAT(drawn("", found), HasSubstr("</svg>"));
}

TEST_F(TrendFigure, BarsReachFromEndToEnd) {
  const Trend found = trend(answer(), kQuestion);
  const std::string script = gnuplot_script("", found);
  const Interval x = found.cases[0].x, y = found.cases[0].y;
  const auto shown = [](double value) {
    std::ostringstream out;
    out.precision(8);
    out << value;
    return out.str();
  };
  EXPECT_THAT(script, HasSubstr("\n" + shown(x.mean) + " " + shown(y.mean / 1000) + " " + shown(x.low) + " " +
                                shown(x.high) + " " + shown(y.low / 1000) + " " + shown(y.high / 1000) + "\n"));
}

TEST_F(TrendFigure, ALineGoesThroughItsCasesByRisingAbscissa) {
  Table each = answer();
  std::ranges::reverse(each.rows);  // the denser bed first
  const std::string script = gnuplot_script("", trend(each, kQuestion));
  for (const std::string block : {"$mean_left_0 << END\n", "$mean_left_1 << END\n", "$mean_right_1 << END\n"}) {
    const auto at = script.find(block);
    ASSERT_NE(at, std::string::npos) << block;
    std::istringstream lines(script.substr(at + block.size()));
    double first = 0, second = 0;
    std::string rest;
    lines >> first, std::getline(lines, rest), lines >> second;
    EXPECT_NEAR(first, 0.802, 1e-6) << block;
    EXPECT_NEAR(second, 0.822, 1e-6) << block;
  }
}

TEST_F(TrendFigure, NoTextIsRunAsACommand) {
  const std::string file = (folder / "harm").string();
  const std::string harm = "'; system(\"touch " + file + "\"); `touch " + file + "` $x @y \\ \"\nset output";
  Trend found = trend(answer(), kQuestion);
  found.question.of = found.reference = harm;
  for (TrendCase& one : found.cases) one.series = harm;
  drawn(harm, found);
  EXPECT_FALSE(fs::exists(file));
}

}  // namespace
}  // namespace seapile::present
