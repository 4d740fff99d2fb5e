// Frames of basins as figures: in metres, with their time, and with their pile where it is then.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runner/present/flow_drawing.h"
#include "tests/runner/present/flow_of_run.h"
#include "tests/support/picture.h"

namespace seapile::present {
namespace {

using base::Vec2;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

FlowOfRun with_pile() {
  FlowOfRun run = small_basin();
  basin::BasinPileSpec& pile = run.scene.basin->pile.emplace();
  pile.radius = 0.25;
  pile.start = 0.6;
  pile.tip = pile::ConicalTip{std::numbers::pi / 2};
  pile.driving = pile::ConstantDriving{0.08};
  return run;
}

TEST(BasinFigure, IsSeenAsAWholeWithALittleAround) {
  const View view = default_view(small_basin());  // 3 m by 1 m, and 3 % of 3 m
  for (const auto& [edge, expected] : {std::pair(view.left, -1.59), std::pair(view.right, 1.59),
                                       std::pair(view.bottom, -0.09), std::pair(view.top, 1.09)})
    EXPECT_NEAR(edge, expected, 1e-12);
}

TEST(BasinFigure, EveryPanelHasItsTimeAndTheWholeTopIsSurface) {
  FlowOfRun later = small_basin();
  later.frame.time = 5;
  const FlowFigure figure = flow_figure(FlowFigureKind::mesh, {small_basin(), later}, {});
  EXPECT_TRUE(figure.basins);
  ASSERT_EQ(figure.panels.size(), 2u);
  EXPECT_EQ(figure.panels[0].title, "basin.viscosity=0.1 Pa s, t = 2.5 s");
  EXPECT_EQ(figure.panels[1].title, "basin.viscosity=0.1 Pa s, t = 5 s");
  EXPECT_EQ(figure.panels[0].surface.size(), 6u);
  EXPECT_EQ(figure.panels[0].die.top, figure.panels[0].die.bottom) << "no die";
  EXPECT_THAT(figure.panels[0].pile, IsEmpty());
}

TEST(BasinFigure, ThePileStandsWhereItIsAtTheTimeOfTheFrame) {
  const FlowPanel panel = flow_figure(FlowFigureKind::mesh, {with_pile()}, {}).panels.at(0);
  // 0.6 m deep at the start, and 2.5 s at 0.08 m/s; a right angle: the shoulder is as high above the tip as R.
  ASSERT_EQ(panel.pile.size(), 5u);
  EXPECT_NEAR(panel.pile[2].y, 1 - 0.6 - 0.2, 1e-12);
  EXPECT_EQ(panel.pile[2].x, 0);
  EXPECT_NEAR(panel.pile[1].x, -0.25, 1e-12);
  EXPECT_NEAR(panel.pile[1].y, 0.45, 1e-12);
  EXPECT_GT(panel.pile[0].y, panel.view.top) << "it reaches out of the picture";
}

TEST(BasinFigure, AJetAndABasinAreNotPutTogether) {
  EXPECT_THROW(flow_figure(FlowFigureKind::mesh, {straight_jet(), small_basin()}, {}), std::invalid_argument);
  EXPECT_THROW(flow_figure(FlowFigureKind::mesh, {small_basin(), straight_jet()}, {}), std::invalid_argument);
}

TEST(BasinFigure, AWindowBesideTheWaterIsSaidInMetres) {
  EXPECT_THAT(
      [] {
        flow_figure(FlowFigureKind::mesh, {small_basin()}, View{5, 6, 0, 1});
      },
      testing::ThrowsMessage<std::invalid_argument>(HasSubstr("x from -1.5 to 1.5 m and y from 0 to 1 m")));
}

TEST(BasinPicture, SpeaksOfMetresAndNotOfADie) {
  for (const FlowFigureKind kind : {FlowFigureKind::mesh, FlowFigureKind::velocity}) {
    const std::string svg = picture_of(flow_figure(kind, {small_basin(), with_pile()}, {}), PictureFormat::svg);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    EXPECT_THAT(svg, HasSubstr("t = 2.5 s"));
    EXPECT_THAT(svg, HasSubstr("x is 0 in the middle of the basin."));
    EXPECT_THAT(svg, Not(HasSubstr("the die")));
  }
}

TEST(BasinPicture, HasThePileInItsPlace) {
  const auto dark = [](const FlowOfRun& run) {
    const Picture picture =
        picture_from_png(picture_of(flow_figure(FlowFigureKind::mesh, {run}, {}), PictureFormat::png));
    double sum = 0;
    for (int x = 0; x < picture.width; ++x) {
      for (int y = 0; y < picture.height; ++y) sum += picture.ink(x, y);
    }
    return sum;
  };
  FlowOfRun deeper = with_pile();
  deeper.frame.time = 3.5;
  EXPECT_GT(dark(with_pile()), dark(small_basin()) + 1000);
  EXPECT_GT(dark(deeper), dark(with_pile()) + 100) << "more of it is to be seen";
}

}  // namespace
}  // namespace seapile::present
