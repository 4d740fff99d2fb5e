// Frames of basins as figures: in metres, with their time, and with their pile where it is then.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runner/present/flow_drawing.h"
#include "runner/store/store_error.h"
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

/// In a box of grains 0.7 m high, the tip 0.3 m deep in them, pressures that rise to the right from -1 Pa to 2 Pa, and
/// porosities from 0.4 at the bottom to 1.
FlowOfRun saturated_bed() {
  FlowOfRun run = small_basin();
  run.title = "fluid.density=1300 kg/m3";
  run.scene.basin.reset();
  run.scene.fluid.emplace();
  run.scene.pile.emplace();
  run.scene.pile->radius = 0.25;
  run.scene.pile->tip = pile::FlatTip{};
  run.pile = PileInBed{0.7, 0.3};
  const auto& position = std::get<std::vector<double>>(run.frame.vertices[0].values);
  std::vector<double> pressure, porosity;
  for (std::size_t k = 0; k < position.size(); k += 2) {
    pressure.push_back(position[k] + 0.5);
    porosity.push_back(0.4 + 0.6 * position[k + 1]);
  }
  run.frame.vertices.push_back({{"vertices/pressure", "Pa", "", 1, simulation::Entity::vertex}, pressure});
  run.frame.vertices.push_back({{"vertices/porosity", "-", "", 1, simulation::Entity::vertex}, porosity});
  return run;
}

TEST(SaturatedFigure, ThePileStandsAtItsDepthBelowTheBedsSurface) {
  const FlowFigure figure = flow_figure(FlowFigureKind::mesh, {saturated_bed()}, {});
  EXPECT_TRUE(figure.beds);
  EXPECT_EQ(figure.panels.at(0).title, "fluid.density=1300 kg/m3, d = 0.300 m");
  double lowest = 1;
  for (const Vec2 p : figure.panels[0].pile) lowest = std::min(lowest, p.y);
  EXPECT_NEAR(lowest, 0.4, 1e-12);
}

TEST(SaturatedFigure, PressuresSpanTheirOwnRangeAndPorositiesTheWholeOne) {
  const FlowFigure pressure = flow_figure(FlowFigureKind::pressure, {saturated_bed()}, {});
  EXPECT_DOUBLE_EQ(pressure.low, -1);
  EXPECT_DOUBLE_EQ(pressure.full, 2);
  EXPECT_EQ(pressure.panels.at(0).faces.size(), 24u);
  EXPECT_THAT(pressure.panels[0].arrows, IsEmpty());
  for (const DrawnTriangle& face : pressure.panels[0].faces) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(face.value[k], face.corner[k].x + 0.5);
  }
  const FlowFigure porosity = flow_figure(FlowFigureKind::porosity, {saturated_bed()}, {});
  EXPECT_EQ(porosity.low, 0);
  EXPECT_EQ(porosity.full, 1);
  EXPECT_THROW(flow_figure(FlowFigureKind::porosity, {small_basin()}, {}), store::StoreError) << "it holds none";
}

TEST(SaturatedFigure, SaysWhatItsColoursAre) {
  const auto svg = [](FlowFigureKind kind, const FlowOfRun& run) {
    return picture_of(flow_figure(kind, {run}, {}), PictureFormat::svg);
  };
  EXPECT_THAT(svg(FlowFigureKind::pressure, saturated_bed()), HasSubstr("pressure without the hydrostatic one"));
  EXPECT_THAT(svg(FlowFigureKind::porosity, saturated_bed()), HasSubstr("in the middle of the box."));
  FlowOfRun even = saturated_bed();
  for (double& p : std::get<std::vector<double>>(even.frame.vertices[2].values)) p = 3;
  EXPECT_TRUE(svg(FlowFigureKind::pressure, even).ends_with("</svg>\n")) << "a pressure that is the same everywhere";
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
