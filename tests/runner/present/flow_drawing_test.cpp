// What is on the paper of a figure of the water: files are read back, and ink is measured.
#include "runner/present/flow_drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runner/present/flow_marks.h"
#include "tests/runner/present/flow_of_run.h"
#include "tests/support/picture.h"

namespace seapile::present {
namespace {

using base::Vec2;
using testing::HasSubstr;
using testing::Not;

constexpr FlowFigureKind kKinds[] = {FlowFigureKind::mesh, FlowFigureKind::velocity};
constexpr View kAll = {-1, 2, 0, 1};

/// What a drawing function leaves on the jet's rectangle, 300 units wide and 100 high.
Picture drawn(const auto& draw) {
  Canvas canvas(PictureFormat::png, 300, 100);
  const Mapping map{kAll, 0, 0, 100};
  draw(canvas.context(), map);
  return picture_from_png(canvas.finish(""));
}

/// The pixel at a place of the jet.
std::uint32_t at(const Picture& picture, Vec2 p) {
  return picture.at(static_cast<int>((p.x + 1) * 100 * kPixelsPerUnit),
                    static_cast<int>((1 - p.y) * 100 * kPixelsPerUnit));
}

/// The largest difference of red, green or blue, each from 0 to 1.
double difference(std::uint32_t pixel, const Colour& colour) {
  const auto part = [&](int shift) { return static_cast<double>(pixel >> shift & 255) / 255; };
  return std::max({std::abs(part(16) - colour.red), std::abs(part(8) - colour.green), std::abs(part(0) - colour.blue)});
}

double ink(const Picture& picture) {
  double sum = 0;
  for (int x = 0; x < picture.width; ++x) {
    for (int y = 0; y < picture.height; ++y) sum += picture.ink(x, y);
  }
  return sum;
}

/// Colour of the whole jet for speeds that are linear in the plane.
Picture speeds_of(Vec2 (*velocity)(Vec2), double& full) {
  FlowOfRun run = straight_jet();
  set_velocity(run, velocity);
  const FlowFigure figure = flow_figure(FlowFigureKind::velocity, {run}, kAll);
  full = figure.full;
  return drawn(
      [&](cairo_t* c, const Mapping& map) { draw_values(c, map, figure.panels.at(0).faces, figure.low, figure.full); });
}

TEST(SpeedOnPaper, HasAtEveryPlaceTheColourOfTheSpeedThere) {
  double full = 0;
  for (const auto velocity : {+[](Vec2 p) {
                                return Vec2{0.2 + 0.3 * p.y + 0.1 * p.x, 0};
                              },
                              +[](Vec2 p) {
                                return Vec2{0, 1 - p.y};
                              },
                              +[](Vec2) {
                                return Vec2{0.6, 0.8};
                              }}) {
    const Picture picture = speeds_of(velocity, full);
    for (double x = -0.97; x < 2; x += 0.061) {
      for (double y = 0.02; y < 0.99; y += 0.061) {
        // Two shades: bands have a width, and pixels too.
        EXPECT_LT(difference(at(picture, {x, y}), colour_of(norm(velocity({x, y})) / full)), 0.06) << x << " " << y;
      }
    }
  }
}

TEST(SpeedOnPaper, HasNoHairsBetweenTrianglesOrBands) {
  double full = 0;
  const Picture even = speeds_of([](Vec2) { return Vec2{1, 0}; }, full);
  for (const std::uint32_t pixel : even.pixels) EXPECT_LT(difference(pixel, colour_of(1)), 0.03);
  // Speeds that grow to the right, their bands oblique to the pixels: none is lighter than its neighbour on the left.
  const Picture ramp = speeds_of([](Vec2 p) { return Vec2{1 + p.x + 0.37 * p.y, 0}; }, full);
  for (int y = 2; y < ramp.height - 2; ++y) {
    for (int x = 3; x < ramp.width - 2; ++x) {
      const auto green = [&](int column) { return static_cast<int>(ramp.at(column, y) >> 8 & 255); };
      EXPECT_LE(green(x), green(x - 1) + 2) << x << " " << y;
    }
  }
}

TEST(EdgesOnPaper, LieWhereTheMeshHasThem) {
  const FlowPanel panel = flow_figure(FlowFigureKind::mesh, {straight_jet()}, kAll).panels.at(0);
  const Picture picture =
      drawn([&](cairo_t* c, const Mapping& map) { draw_edges(c, map, panel.edges, EdgeLook::inner); });
  for (const Vec2 on : {Vec2{0, 0.3}, Vec2{0.25, 0.5}, Vec2{0.3, 0.3}, Vec2{1.2, 0.7}})
    EXPECT_NE(at(picture, on), 0xFFFFFFu) << on.x << " " << on.y;
  for (const Vec2 beside : {Vec2{0.1, 0.3}, Vec2{0.4, 0.2}, Vec2{1.3, 0.9}})
    EXPECT_EQ(at(picture, beside), 0xFFFFFFu) << beside.x << " " << beside.y;
}

TEST(FlowPicture, IsAWholeFileOfEitherFormatWithItsTexts) {
  for (const FlowFigureKind kind : kKinds) {
    FlowOfRun second = straight_jet();
    second.title = "jet.reynolds=36";
    const FlowFigure figure = flow_figure(kind, {straight_jet(), second}, {});
    const Picture picture = picture_from_png(picture_of(figure, PictureFormat::png));
    EXPECT_EQ(picture.at(0, 0), 0xFFFFFFu);
    const Picture one = picture_from_png(picture_of(flow_figure(kind, {second}, {}), PictureFormat::png));
    EXPECT_GT(picture.height, 1.5 * one.height) << "one below the other";
    EXPECT_EQ(picture.width, one.width);
    const std::string svg = picture_of(figure, PictureFormat::svg);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    EXPECT_THAT(svg, HasSubstr("jet.reynolds=24"));
    EXPECT_THAT(svg, HasSubstr("jet.reynolds=36"));
    EXPECT_THAT(svg, HasSubstr("H: the die's radius or half gap"));
  }
  EXPECT_THAT(picture_of(flow_figure(FlowFigureKind::mesh, {straight_jet()}, {}), PictureFormat::svg),
              HasSubstr("21 vertices and 24 triangles"));
}

TEST(FlowPicture, APanelIsClearOfTheOneBelowIt) {
  for (const FlowFigureKind kind : kKinds) {
    const auto picture_with = [&](const std::vector<FlowOfRun>& runs) {
      return picture_from_png(picture_of(flow_figure(kind, runs, {}), PictureFormat::png));
    };
    const Picture one = picture_with({straight_jet()}), two = picture_with({straight_jet(), straight_jet()});
    const int below = 100;  // pixels: what is said below the panels
    for (int y = 0; y < one.height - below; ++y) {
      for (int x = 0; x < one.width; ++x) ASSERT_EQ(one.at(x, y), two.at(x, y)) << x << " " << y;
    }
  }
}

TEST(FlowPicture, WhatIsAboutAsHighAsWideStandsSideBySideWithOneLegend) {
  for (const FlowFigureKind kind : kKinds) {
    const View square{0, 1, 0, 1};
    const auto picture_with = [&](const std::vector<FlowOfRun>& runs) {
      return picture_from_png(picture_of(flow_figure(kind, runs, square), PictureFormat::png));
    };
    const Picture one = picture_with({straight_jet()}), two = picture_with({straight_jet(), straight_jet()}),
                  four = picture_with(std::vector<FlowOfRun>(4, straight_jet()));
    EXPECT_EQ(two.height, one.height);
    EXPECT_GT(two.width, 1.6 * one.width);
    EXPECT_EQ(four.width, two.width) << "two rows";
    EXPECT_GT(four.height, 1.8 * two.height);
    if (kind == FlowFigureKind::mesh) continue;
    // Beside the second row there is no legend.
    double beside = 0;
    for (int y = four.height / 2 + 60; y < four.height - 100; ++y) {
      for (int x = four.width - 100; x < four.width; ++x) beside += four.ink(x, y);
    }
    EXPECT_EQ(beside, 0);
  }
}

TEST(FlowPicture, IsTheSameForTheSameFigure) {
  for (const FlowFigureKind kind : kKinds) {
    const FlowFigure figure = flow_figure(kind, {straight_jet()}, {});
    for (const PictureFormat format : {PictureFormat::svg, PictureFormat::png}) {
      EXPECT_TRUE(picture_of(figure, format) == picture_of(figure, format));
    }
  }
}

TEST(FlowPicture, ShowsTheSubjectAndTheFreeSurfaceInItsColour) {
  for (const FlowFigureKind kind : kKinds) {
    FlowFigure figure = flow_figure(kind, {straight_jet()}, {});
    const auto reds = [&] {
      const Picture picture = picture_from_png(picture_of(figure, PictureFormat::png));
      return std::ranges::count_if(picture.pixels, [](std::uint32_t p) {
        return difference(p, {0.84, 0.2, 0.05}) < 0.1;
      });
    };
    const auto with = reds();
    const double inked = ink(picture_from_png(picture_of(figure, PictureFormat::png)));
    FlowPanel& panel = figure.panels.at(0);
    panel.surface.clear();
    EXPECT_GT(with, reds() + 500);
    panel.edges.clear();
    panel.faces.clear();
    panel.arrows.clear();
    EXPECT_GT(inked, ink(picture_from_png(picture_of(figure, PictureFormat::png))) + 500);
  }
}

TEST(FlowPicture, NothingIsCutOffAtTheSheetsEdge) {
  for (const View view : {kAll, View{-1, 2, 0.9, 1.05}, View{0.9, 1, -0.5, 2}}) {
    for (const FlowFigureKind kind : kKinds) {
      FlowOfRun run = straight_jet();
      for (int i = 0; i < 60; ++i) run.title += ", jet.capillary=0.5";
      run.title += " <b>";
      const FlowFigure figure = flow_figure(kind, {run, run}, view);
      const Picture picture = picture_from_png(picture_of(figure, PictureFormat::png));
      EXPECT_LT(picture.width, 2000);
      EXPECT_LT(picture.height, 2500);
      for (int x = 0; x < picture.width; ++x) {
        for (const int y : {0, 8, picture.height - 8, picture.height - 1}) EXPECT_EQ(picture.ink(x, y), 0) << x;
      }
      for (int y = 0; y < picture.height; ++y) {
        for (const int x : {0, 8, picture.width - 8, picture.width - 1}) EXPECT_EQ(picture.ink(x, y), 0) << y;
      }
      EXPECT_THAT(picture_of(figure, PictureFormat::svg), Not(HasSubstr("<b>")));
    }
  }
}

}  // namespace
}  // namespace seapile::present
