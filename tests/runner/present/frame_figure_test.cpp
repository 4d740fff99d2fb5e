#include "runner/present/frame_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runner/store/store_error.h"
#include "tests/runner/present/flow_of_run.h"
#include "tests/runner/present/frame_of_run.h"

namespace seapile::present {
namespace {

using base::Vec2;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr View kAround = {-1, 1, 0, 2};

/// Touching grains in a row along y, from x = -1.8 m on, 0.1 m apart; ids 10, 20, ...
FrameOfRun run_with_row(double y, int count = 37) {
  FrameOfRun run = empty_run();
  for (int i = 0; i < count; ++i) add_grain(run, 10 * (i + 1), {-1.8 + 0.1 * i, y}, 0.05);
  return run;
}

TEST(FrameFigure, EveryGrainOfTheWindowIsDrawnOnceAndNoOther) {
  FrameOfRun run = empty_run();
  std::int64_t id = 0;
  for (int i = -19; i <= 19; ++i) {
    for (int j = 1; j <= 19; ++j) add_grain(run, id++, {0.1 * i, 0.1 * j}, 0.049);
  }
  const View view{-0.52, 0.53, 0.46, 1.04};  // cuts the columns at -0.5, but not those at -0.6; the rows at 0.5 and 1.0
  for (const FigureKind kind : {FigureKind::bed, FigureKind::forces, FigureKind::velocity}) {
    const FrameFigure figure = frame_figure(kind, {run}, view);
    const auto& grains = figure.panels.at(0).grains;
    ASSERT_EQ(grains.size(), 11u * 6u);
    std::size_t k = 0;
    for (int i = -5; i <= 5; ++i) {
      for (int j = 5; j <= 10; ++j, ++k) {
        EXPECT_NEAR(grains[k].centre.x, 0.1 * i, 1e-12);
        EXPECT_NEAR(grains[k].centre.y, 0.1 * j, 1e-12);
        EXPECT_EQ(grains[k].radius, 0.049);
      }
    }
  }
}

TEST(FrameFigure, AGrainThatReachesIntoTheWindowIsSeenAndOneBeyondItsCornerIsNot) {
  FrameOfRun run = empty_run();
  add_grain(run, 1, {1.04, 1}, 0.05);     // over the edge
  add_grain(run, 2, {1.04, 2.04}, 0.05);  // near the corner, by both coordinates, but beyond it
  add_grain(run, 3, {1.03, 2.03}, 0.05);  // over the corner
  const auto grains = frame_figure(FigureKind::bed, {run}, kAround).panels.at(0).grains;
  ASSERT_EQ(grains.size(), 2u);
  EXPECT_EQ(grains[0].centre.y, 1);
  EXPECT_EQ(grains[1].centre.y, 2.03);
}

TEST(FrameFigure, ALayerIsWhereTheGrainLayBeforeTheDrive) {
  FrameOfRun run = empty_run();
  add_grain(run, 1, {0, 0.65}, 0.05, {}, {0.3, -0.40});  // came from 1.05 m
  add_grain(run, 2, {0, 0.95}, 0.05, {}, {0.3, 0.32});   // came from 0.63 m
  const FrameFigure figure = frame_figure(FigureKind::bed, {run}, {});
  EXPECT_DOUBLE_EQ(figure.scale.layer, 0.1);
  EXPECT_EQ(figure.panels.at(0).grains.at(0).layer, 10);
  EXPECT_EQ(figure.panels.at(0).grains.at(1).layer, 6);
}

TEST(FrameFigure, LinesAreAsWideAsTheirForcesAreLargeInAllPanels) {
  FrameOfRun weak = run_with_row(1), strong = run_with_row(1);
  for (int i = 8; i < 20; ++i) {
    add_contact(weak, 10 * i, 10 * (i + 1), {}, 7.0 * i);
    add_contact(strong, 10 * i, 10 * (i + 1), {}, 100.0 * i);
  }
  const FrameFigure figure = frame_figure(FigureKind::forces, {weak, strong}, kAround);
  EXPECT_DOUBLE_EQ(figure.scale.full, 1900);
  EXPECT_GT(figure.scale.length, 0);
  EXPECT_LT(figure.scale.length, 0.1) << "wider than a grain";
  for (const FramePanel& panel : figure.panels) {
    EXPECT_EQ(panel.forces.size(), 12u);
    for (const DrawnForce& line : panel.forces) {
      EXPECT_NEAR(line.width / figure.scale.length, line.force / 1900, 1e-12);
    }
  }
}

TEST(FrameFigure, AForceBesideTheWindowIsNeitherDrawnNorMeasured) {
  FrameOfRun run = run_with_row(1);
  add_contact(run, 170, 180, {}, 10);
  add_contact(run, 10, 20, {}, 1000);  // at x = -1.8 m
  const FrameFigure figure = frame_figure(FigureKind::forces, {run}, kAround);
  EXPECT_EQ(figure.panels.at(0).forces.size(), 1u);
  EXPECT_EQ(figure.scale.full, 10);
}

TEST(FrameFigure, ALineJoinsTheCentresOfTheTwoIdsOrEndsAtThePointOfContact) {
  FrameOfRun run = run_with_row(1);
  add_contact(run, 180, 190, {9, 9}, 5);
  for (const std::int64_t body : {-1, -2, -3, -4, -5}) {
    add_contact(run, 180, body, {0.5, 0.1 * static_cast<double>(-body)}, 5);
  }
  add_contact(run, 180, 200, {}, 0);  // no longer pressing
  const auto lines = frame_figure(FigureKind::forces, {run}, kAround).panels.at(0).forces;
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_NEAR(lines[0].from.x, -1.8 + 0.1 * 17, 1e-12);
  EXPECT_NEAR(lines[0].to.x, -1.8 + 0.1 * 18, 1e-12);
  EXPECT_NEAR(lines[0].to.y, 1, 1e-12);
  for (int k = 1; k <= 5; ++k) EXPECT_EQ(lines[static_cast<std::size_t>(k)].to, (Vec2{0.5, 0.1 * k}));
}

TEST(FrameFigure, AContactOfAGrainThatIsNotThereIsDamage) {
  FrameOfRun run = run_with_row(1);
  add_contact(run, 15, 20, {}, 5);
  EXPECT_THROW(frame_figure(FigureKind::forces, {run}, kAround), store::StoreError);
}

TEST(FrameFigure, EllipsesHaveTheStressesForSemiAxesOnOneScale) {
  FrameOfRun a = empty_run(), b = empty_run();
  set_stress(a, 20, 10, 40e3, 10e3, 0.5);
  set_stress(a, 0, 10, 500e3, 10e3, 0.5);  // beside the window
  set_stress(b, 22, 11, 80e3, -4e3, -1.0);
  const FrameFigure figure = frame_figure(FigureKind::stress, {a, b}, kAround);
  EXPECT_EQ(figure.scale.full, 80e3);
  ASSERT_EQ(figure.panels.at(0).stresses.size(), 1u);
  ASSERT_EQ(figure.panels.at(1).stresses.size(), 1u);
  const DrawnStress &first = figure.panels[0].stresses[0], &second = figure.panels[1].stresses[0];
  EXPECT_NEAR(first.centre.x, 0.05, 1e-12);
  EXPECT_NEAR(first.centre.y, 1.05, 1e-12);
  EXPECT_EQ(first.direction, 0.5);
  EXPECT_DOUBLE_EQ(first.semi_major, figure.scale.length / 2);
  EXPECT_DOUBLE_EQ(first.semi_minor, figure.scale.length / 8);
  EXPECT_NEAR(second.centre.x, 0.25, 1e-12);
  EXPECT_NEAR(second.centre.y, 1.15, 1e-12);
  EXPECT_DOUBLE_EQ(second.semi_major, figure.scale.length);
  EXPECT_DOUBLE_EQ(second.semi_minor, figure.scale.length / 20) << "tension has a length too";
}

TEST(FrameFigure, ArrowsAreVelocitiesOverTheSpeedOfTheirOwnPile) {
  FrameOfRun slow = empty_run(), fast = empty_run();
  fast.scene.pile->driving = pile::SinusoidalDriving{0.4, 0.1};
  add_grain(slow, 1, {0.2, 1}, 0.05, {0.03, -0.04});
  add_grain(fast, 1, {0.2, 1}, 0.05, {0.03, -0.04});
  const FrameFigure figure = frame_figure(FigureKind::velocity, {slow, fast}, kAround);
  const DrawnVelocity &a = figure.panels.at(0).velocities.at(0), &b = figure.panels.at(1).velocities.at(0);
  EXPECT_EQ(a.tail, (Vec2{0.2, 1}));
  EXPECT_NEAR(a.ratio, 0.5, 1e-12);
  EXPECT_NEAR(b.ratio, 0.125, 1e-12);
  EXPECT_NEAR(a.head.x - a.tail.x, 0.3 * figure.scale.length, 1e-12);
  EXPECT_NEAR(a.head.y - a.tail.y, -0.4 * figure.scale.length, 1e-12);
  EXPECT_NEAR(norm(b.head - b.tail), 0.125 * figure.scale.length, 1e-12);
}

TEST(FrameFigure, ThePilesTipIsAtTheDepthBelowTheSurface) {
  FrameOfRun flat = empty_run(), conical = empty_run();
  conical.scene.pile->tip = pile::ConicalTip{std::numbers::pi / 2};
  const FrameFigure figure = frame_figure(FigureKind::bed, {flat, conical}, {});
  const auto &a = figure.panels.at(0).pile, &b = figure.panels.at(1).pile;
  ASSERT_EQ(a.size(), 4u);
  EXPECT_EQ(a[1], (Vec2{-0.1, 1.5}));
  EXPECT_EQ(a[2], (Vec2{0.1, 1.5}));
  ASSERT_EQ(b.size(), 5u);
  EXPECT_NEAR(b[1].y, 1.6, 1e-12);
  EXPECT_NEAR(b[2].x, 0, 1e-12);
  EXPECT_NEAR(b[2].y, 1.5, 1e-12);
  for (const auto& outline : {a, b}) EXPECT_GT(outline.front().y, figure.panels[0].view.top) << "no end is seen";
}

TEST(DefaultView, OfTheTipHasItAtAThirdFromTheTop) {
  const View view = default_view(FigureKind::forces, empty_run());
  EXPECT_DOUBLE_EQ(view.left, -0.6);
  EXPECT_DOUBLE_EQ(view.right, 0.6);
  EXPECT_DOUBLE_EQ(view.height(), 1.2);
  EXPECT_DOUBLE_EQ((view.top - 1.5) / view.height(), 1.0 / 3);
}

TEST(DefaultView, EndsAtTheBox) {
  FrameOfRun run = empty_run();
  run.scene.bed.domain.width = 0.8;
  run.frame.depth = 1.6;
  const View view = default_view(FigureKind::stress, run);
  EXPECT_NEAR(view.left, -0.4, 0.03);
  EXPECT_NEAR(view.right, 0.4, 0.03);
  EXPECT_NEAR(view.bottom, 0, 0.03);
  EXPECT_LT(view.bottom, 0) << "the base is seen";
}

TEST(DefaultView, OfTheBedHoldsWallsBaseAndEveryGrain) {
  FrameOfRun run = empty_run();
  add_grain(run, 1, {0, 2.5}, 0.1);
  const View view = default_view(FigureKind::bed, run);
  EXPECT_LT(view.left, -2);
  EXPECT_GT(view.right, 2);
  EXPECT_LT(view.bottom, 0);
  EXPECT_GT(view.top, 2.6);
}

TEST(DefaultView, OfTwoBedsIsOneForBoth) {
  FrameOfRun narrow = empty_run(), wide = empty_run();
  wide.scene.bed.domain.width = 6;
  const FrameFigure figure = frame_figure(FigureKind::bed, {narrow, wide}, {});
  EXPECT_EQ(figure.panels.at(0).view.left, figure.panels.at(1).view.left);
  EXPECT_LT(figure.panels.at(0).view.left, -3);
  EXPECT_EQ(figure.panels.at(0).box.left, -2);
}

TEST(FrameFigure, TheInitialConfigurationSaysHowLargeEverythingIs) {
  FrameOfRun run = run_with_row(1);
  add_grain(run, 1000, {0, 0.5}, 0.0123);
  const FrameFigure dry = frame_figure(FigureKind::initial, {run}, {});
  EXPECT_EQ(dry.panels.at(0).sizes.at(0),
            "Box 4 m by 4 m; bed 2.00 m high, 38 grains of radii 12.3 to 50 mm; pile 0.2 m wide.");
  EXPECT_EQ(dry.panels[0].sizes.size(), 1u);
  EXPECT_THAT(dry.panels[0].water, IsEmpty());
  EXPECT_EQ(dry.panels[0].grains.size(), 38u);
  run.scene.fluid.emplace().depth = 3;
  run.fluid = small_basin().frame;
  const FrameFigure wet = frame_figure(FigureKind::initial, {run}, {});
  EXPECT_THAT(wet.panels.at(0).sizes,
              testing::ElementsAre(dry.panels[0].sizes[0], "Fluid 3 m deep; mesh of 21 vertices and 24 triangles."));
  EXPECT_EQ(wet.panels[0].water.size(), 6u);
}

TEST(FrameFigure, WhatCannotBeSeenIsSaid) {
  FrameOfRun run = empty_run();
  try {
    frame_figure(FigureKind::bed, {run}, View{5, 6, 0, 1});
    ADD_FAILURE() << "nothing was said";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("x from -2 to 2 m"));
  }
  run.scene.pile->driving = pile::ConstantDriving{0};
  EXPECT_THROW(frame_figure(FigureKind::velocity, {run}, {}), std::invalid_argument);
  run.frame.grains.pop_back();
  EXPECT_THROW(frame_figure(FigureKind::bed, {run}, {}), store::StoreError);
}

TEST(FrameFigure, AFrameWithoutContactsOrStressIsAFigureToo) {
  const FrameOfRun run = run_with_row(1);
  EXPECT_THAT(frame_figure(FigureKind::forces, {run}, {}).panels.at(0).forces, IsEmpty());
  EXPECT_THAT(frame_figure(FigureKind::stress, {run}, {}).panels.at(0).stresses, IsEmpty());
}

}  // namespace
}  // namespace seapile::present
