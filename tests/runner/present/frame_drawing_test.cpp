// What is on the paper: files are read back, and ink is measured.
#include "runner/present/frame_drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "runner/present/frame_marks.h"
#include "runner/present/lettering.h"
#include "tests/runner/present/flow_of_run.h"
#include "tests/runner/present/frame_of_run.h"
#include "tests/support/picture.h"

namespace seapile::present {
namespace {

using base::Vec2;
using testing::HasSubstr;
using testing::Not;

constexpr FigureKind kKinds[] = {FigureKind::bed, FigureKind::forces, FigureKind::stress, FigureKind::velocity};

/// Some of everything, around the tip at (0, 1.5).
FrameOfRun full_run() {
  FrameOfRun run = empty_run();
  for (int i = -5; i <= 5; ++i) add_grain(run, i + 6, {0.1 * i, 1.3}, 0.05, {0.02 * i, -0.05});
  for (int i = 1; i <= 10; ++i) add_contact(run, i, i + 1, {}, 10.0 * i);
  for (int i = 16; i < 24; ++i) set_stress(run, i, 11, 1e3 * i, 400.0 * i, 0.1 * i);
  return run;
}

/// What a drawing function leaves on a square of 2 m that is 200 units wide.
Picture drawn(const auto& draw) {
  Canvas canvas(PictureFormat::png, 200, 200);
  const Mapping map{{-1, 1, -1, 1}, 0, 0, 100};
  draw(canvas.context(), map);
  return picture_from_png(canvas.finish(""));
}

/// Pixels of ink along a column of the picture.
double ink_of_column(const Picture& picture, int x) {
  double sum = 0;
  for (int y = 0; y < picture.height; ++y) sum += picture.ink(x, y);
  return sum;
}

double ink(const Picture& picture) {
  double sum = 0;
  for (int x = 0; x < picture.width; ++x) sum += ink_of_column(picture, x);
  return sum;
}

TEST(Paper, AnEllipseLiesAlongTheMajorStress) {
  for (const double direction : {-1.2, -0.5, 0.0, 0.5, 1.2}) {
    const DrawnStress stress{{0.2, 0.3}, 9e3, 3e3, direction, 0.45, 0.15};
    const Picture picture = drawn([&](cairo_t* c, const Mapping& map) { draw_stresses(c, map, {stress}, 9e3); });
    double mass = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    for (int j = 0; j < picture.height; ++j) {
      for (int i = 0; i < picture.width; ++i) {
        const double w = picture.ink(i, j) > 0.1, px = (i + 0.5) / 200 - 1, py = 1 - (j + 0.5) / 200;  // [m]
        mass += w, x += w * px, y += w * py, xx += w * px * px, yy += w * py * py, xy += w * px * py;
      }
    }
    x /= mass, y /= mass;
    EXPECT_NEAR(x, 0.2, 0.01);
    EXPECT_NEAR(y, 0.3, 0.01);
    // Second moments of an ellipse: a quarter of the squared semi-axes, along the axes.
    const double a = 0.25 * 0.45 * 0.45, b = 0.25 * 0.15 * 0.15, c = std::cos(direction), s = std::sin(direction);
    EXPECT_NEAR(xx / mass - x * x, a * c * c + b * s * s, 0.03 * a);
    EXPECT_NEAR(yy / mass - y * y, a * s * s + b * c * c, 0.03 * a);
    EXPECT_NEAR(xy / mass - x * y, (a - b) * c * s, 0.03 * a);
  }
}

TEST(Paper, LinesAreAsWideAsTheySay) {
  std::vector<double> inks;
  for (const double width : {0.02, 0.04, 0.08}) {
    const DrawnForce line{{-0.9, 0}, {0.9, 0}, 1, width};
    const Picture picture = drawn([&](cairo_t* c, const Mapping& map) { draw_forces(c, map, {line}); });
    inks.push_back(ink_of_column(picture, picture.width / 2));
  }
  // 200 pixels are a metre; what an ink of less than black weighs drops out of the ratios.
  EXPECT_NEAR(inks[1] / inks[0], 2, 0.02);
  EXPECT_NEAR(inks[2] / inks[0], 4, 0.04);
  EXPECT_GT(inks[0], 0.5 * 4);
  EXPECT_LT(inks[0], 4.2);
}

TEST(Paper, AGrainIsADiscOfItsSize) {
  for (const double radius : {0.05, 0.1, 0.3}) {
    const Picture picture = drawn([&](cairo_t* c, const Mapping& map) {
      draw_grains(c, map, {{{0.1, 0.2}, radius, 1}}, GrainLook::layered);
    });
    double inked = 0, x = 0, y = 0;
    for (int j = 0; j < picture.height; ++j) {
      for (int i = 0; i < picture.width; ++i) {
        const double w = picture.ink(i, j) > 0.2;
        inked += w, x += w * i, y += w * j;
      }
    }
    const double pixels = std::numbers::pi * radius * radius * 200 * 200;
    EXPECT_NEAR(inked / pixels, 1, 0.05);
    EXPECT_NEAR(x / inked, 1.1 * 200, 1);
    EXPECT_NEAR(y / inked, 0.8 * 200, 1);
  }
}

TEST(Paper, NeighbouringLayersDifferInTone) {
  const auto tone = [](long layer) {
    const Picture picture = drawn([&](cairo_t* c, const Mapping& map) {
      draw_grains(c, map, {{{0, 0}, 0.5, layer}}, GrainLook::layered);
    });
    return picture.at(200, 200);
  };
  EXPECT_NE(tone(3), tone(4));
  EXPECT_EQ(tone(3), tone(5));
  EXPECT_EQ(tone(-1), tone(1));
}

TEST(Paper, AnArrowPointsFromTailToHead) {
  const DrawnVelocity up{{0, -0.5}, {0, 0.5}, 1};
  const Picture picture = drawn([&](cairo_t* c, const Mapping& map) { draw_velocities(c, map, {up}); });
  double upper = 0, lower = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) (y < picture.height / 2 ? upper : lower) += picture.ink(x, y);
  }
  EXPECT_GT(upper, lower + 1) << "the head is above";
}

TEST(FramePicture, IsAWholeFileOfEitherFormat) {
  for (const FigureKind kind : kKinds) {
    const FrameFigure figure = frame_figure(kind, {full_run(), full_run()}, {});
    const Picture picture = picture_from_png(picture_of(figure, PictureFormat::png));
    EXPECT_GT(std::set(picture.pixels.begin(), picture.pixels.end()).size(), 20u);
    EXPECT_EQ(picture.at(0, 0), 0xFFFFFFu);
    const std::string svg = picture_of(figure, PictureFormat::svg);
    EXPECT_TRUE(svg.starts_with("<?xml"));
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    EXPECT_THAT(svg, HasSubstr("pile.tip=flat, d = 0.500 m"));
  }
}

TEST(FramePicture, IsTheSameForTheSameFigure) {
  for (const FigureKind kind : kKinds) {
    const FrameFigure figure = frame_figure(kind, {full_run()}, {});
    for (const PictureFormat format : {PictureFormat::svg, PictureFormat::png}) {
      EXPECT_TRUE(picture_of(figure, format) == picture_of(figure, format));
    }
  }
}

TEST(FramePicture, OfOneWindowKnowsNothingOfWhatIsBesideIt) {
  FrameOfRun more = full_run();
  add_grain(more, 100, {-1.5, 0.2}, 0.05, {9, 9});
  add_grain(more, 101, {-1.4, 0.2}, 0.05, {9, 9});
  add_contact(more, 100, 101, {}, 1e6);
  set_stress(more, 2, 2, 1e9, 1e9, 0);
  for (const FigureKind kind : kKinds) {
    const View view{-0.6, 0.6, 0.8, 2};
    EXPECT_TRUE(picture_of(frame_figure(kind, {full_run()}, view), PictureFormat::svg) ==
                picture_of(frame_figure(kind, {more}, view), PictureFormat::svg));
  }
}

TEST(FramePicture, EveryKindShowsWhatItIsAbout) {
  // Take the subject away, and there is less ink.
  FrameOfRun bare = empty_run();
  for (const FigureKind kind : kKinds) {
    const auto ink_with = [&](const FrameOfRun& run) {
      return ink(picture_from_png(picture_of(frame_figure(kind, {run}, {}), PictureFormat::png)));
    };
    EXPECT_GT(ink_with(full_run()), ink_with(bare) + 500);
  }
}

TEST(FramePicture, OfTheInitialConfigurationHasTheFluidUnderItsSurfaceAndNoneInThePile) {
  FrameOfRun run = full_run();
  run.fluid = small_basin().frame;  // from -1.5 m to 1.5 m, 1 m high
  FrameFigure figure = frame_figure(FigureKind::initial, {run}, View{-2, 2, 0, 2});
  figure.panels[0].grains.clear();
  const auto blues = [&](const FrameFigure& drawn) {
    const Picture picture = picture_from_png(picture_of(drawn, PictureFormat::png));
    return std::ranges::count_if(
        picture.pixels, [](std::uint32_t p) { return (p & 255) > 245 && (p >> 16 & 255) > 205 && (p >> 16 & 255) < 230; });
  };
  const double pixels = 2 * 640 / 4.0;  // per metre
  EXPECT_NEAR(static_cast<double>(blues(figure)) / (3 * 1 * pixels * pixels), 1, 0.03);
  const auto driven = [&](double depth) {
    run.frame.depth = depth;
    FrameFigure other = frame_figure(FigureKind::initial, {run}, View{-2, 2, 0, 2});
    other.panels[0].grains.clear();
    return blues(other);
  };
  EXPECT_NEAR(static_cast<double>(driven(1) - driven(1.5)) / (0.2 * 0.5 * pixels * pixels), 1, 0.1)
      << "a pile 0.2 m wide";
}

TEST(FramePicture, ALongOrBrokenTitleStaysInItsPlace) {
  FrameOfRun run = full_run();
  for (int i = 0; i < 60; ++i) run.title += ", bed.grains.friction=0.5";
  run.title += "\xff <b> & \xc3";
  const auto figure = frame_figure(FigureKind::bed, {run}, {});
  const Picture picture = picture_from_png(picture_of(figure, PictureFormat::png));
  for (int x = picture.width - 20; x < picture.width; ++x) EXPECT_EQ(ink_of_column(picture, x), 0) << x;
  const std::string svg = picture_of(figure, PictureFormat::svg);
  EXPECT_THAT(svg, Not(HasSubstr("<b>")));
  EXPECT_THAT(svg, Not(HasSubstr("\xff")));
}

TEST(FramePicture, AnUnevenWindowHasAnEdgeOfReadableLengthAndNoEnd) {
  for (const View view : {View{-2, 2, 1.4, 1.6}, View{-0.1, 0.1, 0, 3}}) {
    for (const FigureKind kind : kKinds) {
      const auto figure = frame_figure(kind, {full_run()}, view);
      const Picture picture = picture_from_png(picture_of(figure, PictureFormat::png));
      EXPECT_LT(picture.width, 2000);
      EXPECT_LT(picture.height, 1500);
    }
  }
}

TEST(PictureFormat, IsSaidByTheEndOfTheName) {
  EXPECT_EQ(picture_format("a/b.svg"), PictureFormat::svg);
  EXPECT_EQ(picture_format("b.png"), PictureFormat::png);
  for (const char* name : {"b.pdf", "b", "svg", ".svg", "b.SVG", "b.svg.gz"})
    EXPECT_FALSE(picture_format(name)) << name;
}

TEST(ColourMap, GetsDarkerAllTheWayInEvenSteps) {
  const auto lightness = [](double share) {
    const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
    const Colour c = colour_of(share);
    return 116 * std::cbrt(0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue)) - 16;  // L*
  };
  const double step = (lightness(0) - lightness(1)) / 50;
  EXPECT_GT(step, 1);
  for (int k = 0; k < 50; ++k) EXPECT_NEAR(lightness(k / 50.0) - lightness((k + 1) / 50.0), step, 0.35 * step) << k;
  EXPECT_EQ(colour_of(-3), colour_of(0));
  EXPECT_EQ(colour_of(7), colour_of(1));
  EXPECT_EQ(colour_of(std::nan("")).red, 0.5);
}

}  // namespace
}  // namespace seapile::present
