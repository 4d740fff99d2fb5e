#include "runner/present/quality_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "runner/present/quality_drawing.h"
#include "runner/store/store_error.h"
#include "tests/runner/present/flow_of_run.h"
#include "tests/support/picture.h"

namespace seapile::present {
namespace {

using base::Vec2;
using testing::HasSubstr;

QualityPanel panel_of(const FlowOfRun& run) { return quality_figure({run}).panels.at(0); }

/// The basin's squares as rectangles, so many times as wide as high: all triangles are alike.
FlowOfRun stretched(Vec2 (*place)(Vec2)) {
  FlowOfRun run = small_basin();
  move(run, place);
  return run;
}

// Half squares: q = 4 sqrt(3) (1/2)/(1 + 1 + 2) = 0.866, and 45 degrees, which begin a bin.
TEST(QualityFigure, HalfSquaresAreInTheirBins) {
  const QualityPanel panel = panel_of(small_basin());
  EXPECT_EQ(panel.triangles, 24u);
  for (std::size_t k = 0; k < kShapeBins; ++k) EXPECT_NEAR(panel.shape[k], k == 17 ? 1 : 0, 1e-12) << k;
  for (std::size_t k = 0; k < kAngleBins; ++k) EXPECT_NEAR(panel.angle[k], k == 9 ? 1 : 0, 1e-12) << k;
  EXPECT_NEAR(panel.lowest_shape, std::sqrt(3) / 2, 1e-12);
  EXPECT_NEAR(panel.smallest_angle, std::numbers::pi / 4, 1e-12);
  EXPECT_EQ(panel.below_half, 0);
  EXPECT_EQ(panel.small_angles, 0);
  EXPECT_EQ(panel.title, "basin.viscosity=0.1 Pa s, t = 2.5 s");
}

// Rounding leaves some of their angles a hair below 45 degrees.
TEST(QualityFigure, TurningAMeshMovesNoTriangleIntoAnotherBin) {
  const QualityPanel panel = panel_of(stretched([](Vec2 p) {
    return Vec2{std::cos(0.3) * p.x - std::sin(0.3) * p.y, std::sin(0.3) * p.x + std::cos(0.3) * p.y};
  }));
  EXPECT_NEAR(panel.angle[9], 1, 1e-12);
  EXPECT_NEAR(panel.shape[17], 1, 1e-12);
}

// Half rectangles of 4 by 1: q = 4 sqrt(3) 2/(16 + 1 + 17) = 0.408, atan(1/4) = 14.04 degrees.
TEST(QualityFigure, HalfRectanglesAreInLowerBinsAndAreCounted) {
  const QualityPanel panel = panel_of(stretched([](Vec2 p) { return Vec2{4 * p.x, p.y}; }));
  EXPECT_NEAR(panel.shape[8], 1, 1e-12);
  EXPECT_NEAR(panel.angle[2], 1, 1e-12);
  EXPECT_EQ(panel.below_half, 1);
  EXPECT_EQ(panel.small_angles, 1);
}

TEST(QualityFigure, EveryTriangleIsInOneBinOfEach) {
  const QualityFigure figure = quality_figure({stretched([](Vec2 p) {
                                                 return Vec2{p.x + 0.4 * p.y * p.y, p.y * (1 + 0.5 * std::abs(p.x))};
                                               }),
                                               small_basin()});
  ASSERT_EQ(figure.panels.size(), 2u);
  for (const QualityPanel& panel : figure.panels) {
    EXPECT_NEAR(std::accumulate(panel.shape.begin(), panel.shape.end(), 0.0), 1, 1e-12);
    EXPECT_NEAR(std::accumulate(panel.angle.begin(), panel.angle.end(), 0.0), 1, 1e-12);
  }
  EXPECT_NEAR(figure.full, 1, 1e-12) << "one scale for all";
}

// A triangle that turned over has q < 0: it counts as the worst.
TEST(QualityFigure, ATurnedTriangleIsInTheLowestBin) {
  const QualityPanel panel = panel_of(stretched([](Vec2 p) { return Vec2{-p.x, p.y}; }));
  EXPECT_NEAR(panel.shape[0], 1, 1e-12);
  EXPECT_NEAR(panel.angle[0], 1, 1e-12);
  EXPECT_LT(panel.lowest_shape, 0);
}

TEST(QualityFigure, AFrameWithoutTrianglesIsDamage) {
  FlowOfRun run = small_basin();
  std::get<std::vector<std::int64_t>>(run.frame.triangles[0].values).clear();
  EXPECT_THROW(quality_figure({run}), store::StoreError);
}

TEST(QualityFigure, MarksTheBadTrianglesWhereTheyAre) {
  EXPECT_TRUE(panel_of(small_basin()).bad.empty());
  // The left half stretched downwards: its triangles alone are bad, 12 of 24.
  const QualityPanel panel = panel_of(stretched([](Vec2 p) { return Vec2{p.x < 0 ? 8 * p.x : p.x, p.y}; }));
  EXPECT_EQ(panel.bad.size(), 12u);
  for (const auto& corners : panel.bad) {
    for (const Vec2 corner : corners) EXPECT_LE(corner.x, 1e-12);
  }
  EXPECT_EQ(panel.mesh.triangles, 24u);
  EXPECT_GT(panel.mesh.edges.size(), 24u);
}

TEST(QualityFigure, AWindowCutsTheMeshAndNotTheHistograms) {
  const View view{0.1, 0.4, 0.1, 0.4};
  const QualityFigure figure = quality_figure({small_basin()}, view);
  EXPECT_LT(figure.panels.at(0).mesh.edges.size(), 6u);
  EXPECT_NEAR(figure.panels[0].shape[17], 1, 1e-12);
  EXPECT_EQ(figure.panels[0].triangles, 24u);
  EXPECT_THROW(quality_figure({small_basin()}, View{7, 8, 0, 1}), std::invalid_argument);
}

TEST(QualityPicture, StandsSideBySideAndSaysHowManyAreBad) {
  const FlowOfRun bad = stretched([](Vec2 p) { return Vec2{4 * p.x, p.y}; });
  const QualityFigure figure = quality_figure({small_basin(), bad});
  const std::string svg = picture_of(figure, PictureFormat::svg);
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  for (const char* text : {"q &lt; 0.5: 0 %", "q &lt; 0.5: 100 %", "below 30°: 100 %", "24 triangles", "lowest 0.408"})
    EXPECT_THAT(svg, HasSubstr(text));
  const Picture two = picture_from_png(picture_of(figure, PictureFormat::png));
  const Picture four = picture_from_png(picture_of(quality_figure({bad, bad, bad, bad}), PictureFormat::png));
  const Picture one = picture_from_png(picture_of(quality_figure({bad}), PictureFormat::png));
  EXPECT_EQ(one.height, four.height);
  EXPECT_GT(four.width, 1.8 * two.width);
  // What is below a limit is red, and only that.
  const auto reds = [](const Picture& picture) {
    return std::ranges::count_if(
        picture.pixels, [](std::uint32_t p) { return (p >> 16 & 255) > 200 && (p >> 8 & 255) < 70 && (p & 255) < 40; });
  };
  EXPECT_GT(reds(four), 3 * reds(two) / 2);
  const Picture good = picture_from_png(picture_of(quality_figure({small_basin()}), PictureFormat::png));
  EXPECT_LT(reds(good), 2000) << "the keys alone";
}

TEST(QualityPicture, NothingIsCutOffAtTheSheetsEdge) {
  FlowOfRun run = small_basin();
  for (int i = 0; i < 60; ++i) run.title += ", basin.depth=0.5 m";
  for (const std::size_t count : {1u, 6u}) {
    const Picture picture =
        picture_from_png(picture_of(quality_figure(std::vector<FlowOfRun>(count, run)), PictureFormat::png));
    for (int x = 0; x < picture.width; ++x) {
      for (const int y : {0, 8, picture.height - 8, picture.height - 1}) EXPECT_EQ(picture.ink(x, y), 0) << x;
    }
    for (int y = 0; y < picture.height; ++y) {
      for (const int x : {0, 8, picture.width - 8, picture.width - 1}) EXPECT_EQ(picture.ink(x, y), 0) << y;
    }
  }
}

}  // namespace
}  // namespace seapile::present
