#include "runner/present/zone_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runner/present/table.h"
#include "runner/present/zone_drawing.h"
#include "runner/store/store_error.h"
#include "tests/runner/present/frame_of_run.h"
#include "tests/support/picture.h"

namespace seapile::present {
namespace {

using testing::HasSubstr;

/// What a cell has, by its centre.
using Field = double (*)(double x, double y);

constexpr std::size_t kPorosity = 0, kVertical = 1, kMajor = 2;

/// Cells of 0.1 m in a box of 4 m by 4 m. The vertical stress is twice, the major one three times as large as the
/// porosity, so that one taken for the other is seen.
void fill(simulation::Frame& frame, Field field) {
  const auto list = [&](std::size_t k) -> std::vector<double>& {
    return std::get<std::vector<double>>(frame.cells[k].values);
  };
  for (std::size_t k = 0; k < 1600; ++k) {
    const double value =
        field(-2 + 0.1 * (static_cast<double>(k % 40) + 0.5), 0.1 * (static_cast<double>(k / 40) + 0.5));
    list(0)[k] = value;
    list(1)[3 * k] = -7, list(1)[3 * k + 1] = 2 * value, list(1)[3 * k + 2] = -9;
    list(2)[2 * k] = 3 * value, list(2)[2 * k + 1] = -5;
  }
}

/// A flat pile of half-width 0.1 m, its tip at a height of 1.5 m, in a bed 2 m high.
ZoneOfRun zone_of(Field before, Field after) {
  FrameOfRun run = empty_run();
  ZoneOfRun zone{run.title, run.scene, run.surface, run.frame, run.frame};
  zone.before.depth = zone.before.asked = 0;
  fill(zone.before, before);
  fill(zone.after, after);
  return zone;
}

double none(double, double) { return 0; }

TEST(ZoneFigure, AMeanIsOverTheBandLeftAndRight) {
  // Left 1, right 3; what is outside the band is far off.
  const auto after = [](double x, double y) { return y < 1.3 || y > 1.7 ? 1e6 : x < 0 ? 1.0 : 3.0; };
  const ZoneFigure figure = zone_figure({zone_of(none, after)}, {});
  const ZonePanel& panel = figure.runs.at(0);
  EXPECT_NEAR(panel.band.bottom, 1.3, 1e-12);
  EXPECT_NEAR(panel.band.top, 1.7, 1e-12);
  ASSERT_EQ(panel.distance.size(), 20u);
  for (std::size_t k = 0; k < 20; ++k) {
    EXPECT_NEAR(panel.distance[k], 0.05 + 0.1 * static_cast<double>(k), 1e-12);
    EXPECT_NEAR(panel.curves[kPorosity].after[k], 2, 1e-12) << k;
    EXPECT_NEAR(panel.curves[kVertical].after[k], 4, 1e-12) << k;
    EXPECT_NEAR(panel.curves[kMajor].after[k], 6, 1e-12) << k;
    EXPECT_EQ(panel.curves[kPorosity].before[k], 0);
  }
}

TEST(ZoneFigure, CellsInThePileCountNeitherBeforeNorAfter) {
  // Within the pile's half-width of 0.1 m only what lies below the tip at 1.5 m is soil.
  const auto in_pile = [](double x, double y) { return std::abs(x) < 0.1 && y > 1.5 ? 1e6 : 1.0; };
  const ZoneFigure figure = zone_figure({zone_of(in_pile, in_pile)}, {});
  for (const ZoneCurve& curve : figure.runs.at(0).curves) EXPECT_EQ(curve.before[0], curve.after[0]);
  EXPECT_NEAR(figure.runs[0].curves[kPorosity].after[0], 1, 1e-12);
  // A band that lies above the tip begins beside the pile.
  const ZoneFigure beside = zone_figure({zone_of(in_pile, in_pile)}, View{0, 2, 1.6, 1.9});
  EXPECT_NEAR(beside.runs.at(0).distance.front(), 0.15, 1e-12);
}

TEST(ZoneFigure, AConeLeavesTheSoilBesideItsPoint) {
  ZoneOfRun run = zone_of(none, none);
  run.scene.pile->radius = 0.3;
  run.scene.pile->tip = pile::ConicalTip{};  // 30 degrees to each side: as wide as the pile 0.52 m above its point
  const auto first = [&](double bottom) {
    return zone_figure({run}, View{0, 2, bottom, bottom + 0.1}).runs.at(0).distance.front();
  };
  EXPECT_NEAR(first(1.4), 0.05, 1e-9) << "below the tip";
  EXPECT_NEAR(first(1.5), 0.15, 1e-9) << "0.06 m wide at the cells' top";
  EXPECT_NEAR(first(1.7), 0.25, 1e-9) << "0.17 m wide";
  EXPECT_NEAR(first(1.9), 0.35, 1e-9) << "0.29 m wide";
}

// A change that falls by half every 0.1 m reaches a share of 1/20 between 0.4 and 0.5 m behind its largest value.
TEST(ZoneFigure, TheReachIsWhereTheChangeStaysBelowItsShareOfTheLargest) {
  const auto after = [](double x, double) { return -std::exp2(-(std::abs(x) - 0.05) / 0.1); };
  const ZoneFigure figure = zone_figure({zone_of(none, after)}, {});
  const double between = (1.0 / 16 - 1.0 / 20) / (1.0 / 16 - 1.0 / 32);  // linear between the distances of cells
  for (const ZoneCurve& curve : figure.runs.at(0).curves) {
    ASSERT_TRUE(curve.reach);
    EXPECT_NEAR(*curve.reach, 0.45 + 0.1 * between, 1e-9);
  }
}

TEST(ZoneFigure, AChangeThatComesBackIsNotOver) {
  const auto after = [](double x, double) {
    return std::abs(x) < 0.2 ? 1.0 : std::abs(x) > 0.9 && std::abs(x) < 1 ? 0.5 : 0.0;
  };
  const auto reach = zone_figure({zone_of(none, after)}, {}).runs.at(0).curves[kPorosity].reach;
  ASSERT_TRUE(reach);
  EXPECT_NEAR(*reach, 0.95 + 0.1 * (0.5 - 0.05) / 0.5, 1e-9);
}

TEST(ZoneFigure, AChangeUpToTheWallOrNoneHasNoReach) {
  const auto everywhere = [](double x, double) { return 1 + std::abs(x); };
  for (const Field after : {Field(everywhere), Field(none)}) {
    const ZoneFigure figure = zone_figure({zone_of(none, after)}, {});
    for (const ZoneCurve& curve : figure.runs.at(0).curves) EXPECT_FALSE(curve.reach);
  }
}

TEST(ZoneFigure, TheBandEndsAtTheInitialSurfaceAndAtTheBase) {
  ZoneOfRun run = zone_of(none, none);
  run.after.depth = 0.1;
  EXPECT_NEAR(default_band(run).top, 2, 1e-12);
  EXPECT_NEAR(default_band(run).bottom, 1.7, 1e-12);
  run.after.depth = 1.95;
  EXPECT_EQ(default_band(run).bottom, 0);
}

TEST(ZoneFigure, ABandWithoutAWholeCellIsRefusedInASentence) {
  EXPECT_THROW(zone_figure({zone_of(none, none)}, View{0, 2, 1.31, 1.38}), std::invalid_argument);
  EXPECT_THROW(zone_figure({zone_of(none, none)}, View{3, 4, 1, 2}), std::invalid_argument);
  EXPECT_THROW(zone_figure({zone_of(none, none)}, View{0, 0.1, 1.5, 1.9}), std::invalid_argument) << "in the pile";
}

TEST(ZoneFigure, FramesOfDifferentCellsAreDamage) {
  ZoneOfRun run = zone_of(none, none);
  run.before.grid.nx = 20;
  EXPECT_THROW(zone_figure({run}, {}), store::StoreError);
}

TEST(ZoneTable, HasARowPerRunAndDistanceAndNoReachWhereThereIsNone) {
  const auto near = [](double x, double) { return std::abs(x) < 0.2 ? 1.0 : 0.0; };
  ZoneOfRun second = zone_of(none, none);
  second.title = "pile.tip=conical, no fluid";
  const store::Table table = zone_table(zone_figure({zone_of(none, near), second}, {}));
  ASSERT_EQ(table.rows.size(), 40u);
  for (const auto& row : table.rows) ASSERT_EQ(row.size(), table.columns.size());
  const std::string csv = text(table, Format::csv);
  EXPECT_THAT(csv, HasSubstr("run,depth[m],distance[m],porosity_before[-],porosity_after[-],porosity_reach[m],"
                             "stress_yy_before[Pa],stress_yy_after[Pa],stress_yy_reach[m],stress_major_before[Pa]"));
  EXPECT_TRUE(std::holds_alternative<double>(table.rows[0][5]));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(table.rows[20][5]));
  EXPECT_THAT(csv, HasSubstr("\"pile.tip=conical, no fluid\""));
}

TEST(ZonePicture, SaysHowFarAndIsWhole) {
  const auto near = [](double x, double) { return std::abs(x) < 0.2 ? 1.0 : 0.0; };
  ZoneOfRun second = zone_of(none, none);
  for (int i = 0; i < 60; ++i) second.title += ", bed.grains.friction=0.5";
  const ZoneFigure figure = zone_figure({zone_of(none, near), second}, {});
  const std::string svg = picture_of(figure, PictureFormat::svg);
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_TRUE(svg == picture_of(figure, PictureFormat::svg));
  EXPECT_THAT(svg, HasSubstr("porosity [-]: the change fades at 0.2"));
  EXPECT_THAT(svg, HasSubstr("m; no change."));
  const auto up_to_the_wall = [](double x, double) { return 1 + std::abs(x); };
  EXPECT_THAT(picture_of(zone_figure({zone_of(none, up_to_the_wall)}, {}), PictureFormat::svg),
              HasSubstr("the change fades at > 1.95 m"));
  const Picture picture = picture_from_png(picture_of(figure, PictureFormat::png));
  for (int y = 0; y < picture.height; ++y) {
    for (const int x : {0, 8, picture.width - 8, picture.width - 1}) EXPECT_EQ(picture.ink(x, y), 0) << y;
  }
  // Two runs, two colours: both are on the paper.
  const auto inked = [&](auto is) { return std::ranges::count_if(picture.pixels, is); };
  EXPECT_GT(inked([](std::uint32_t p) { return (p >> 16 & 255) < 10 && (p & 255) > 170; }), 300) << "blue";
  EXPECT_GT(inked([](std::uint32_t p) { return (p >> 16 & 255) > 205 && (p & 255) < 10; }), 300) << "red";
}

}  // namespace
}  // namespace seapile::present
