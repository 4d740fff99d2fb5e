#include "runner/present/flow_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "runner/store/store_error.h"
#include "tests/runner/present/flow_of_run.h"

namespace seapile::present {
namespace {

using base::Vec2;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr View kAll = {-1.2, 2.2, -0.2, 1.2};

FlowPanel panel_of(FlowFigureKind kind, const FlowOfRun& run, const std::optional<View>& view = kAll) {
  return flow_figure(kind, {run}, view).panels.at(0);
}

TEST(FlowFigure, EveryEdgeOfTheMeshIsDrawnOnce) {
  const FlowPanel panel = panel_of(FlowFigureKind::mesh, straight_jet());
  // 6 by 2 squares: 3 rows of 6 and 7 columns of 2 sides, and a diagonal in each.
  EXPECT_EQ(panel.edges.size() + panel.boundary.size() + panel.surface.size(), 18u + 14u + 12u);
  EXPECT_EQ(panel.boundary.size() + panel.surface.size(), 2u * 6u + 2u * 2u);
  std::set<std::array<double, 4>> seen;
  for (const auto* list : {&panel.edges, &panel.boundary, &panel.surface}) {
    for (const DrawnEdge& e : *list) {
      EXPECT_TRUE(seen.insert({e.from.x, e.from.y, e.to.x, e.to.y}).second);
      EXPECT_FALSE(seen.contains({e.to.x, e.to.y, e.from.x, e.from.y}));
    }
  }
  EXPECT_EQ(panel.vertices, 21u);
  EXPECT_EQ(panel.triangles, 24u);
  EXPECT_THAT(panel.faces, IsEmpty());
  EXPECT_THAT(panel.arrows, IsEmpty());
}

TEST(FlowFigure, TheFreeSurfaceBeginsAtTheLipAndTheWallIsBoundary) {
  for (const FlowFigureKind kind : {FlowFigureKind::mesh, FlowFigureKind::velocity}) {
    const FlowPanel panel = panel_of(kind, straight_jet());
    ASSERT_EQ(panel.surface.size(), 4u);
    for (const DrawnEdge& edge : panel.surface) {
      EXPECT_GE(edge.from.x, 0);
      EXPECT_EQ(edge.from.y, 1);
      EXPECT_EQ(edge.to.y, 1);
    }
    EXPECT_EQ(panel.boundary.size(), 12u);
    EXPECT_EQ(panel.die.left, -1);
    EXPECT_EQ(panel.die.right, 0);
    EXPECT_EQ(panel.die.bottom, 1);
  }
  FlowOfRun closed = straight_jet();
  closed.frame.surface.clear();
  EXPECT_EQ(panel_of(FlowFigureKind::mesh, closed).boundary.size(), 16u);
}

TEST(FlowFigure, OnlyWhatReachesIntoTheWindowIsDrawn) {
  const View view{0.1, 0.4, 0.1, 0.4};  // inside one square
  const FlowPanel mesh = panel_of(FlowFigureKind::mesh, straight_jet(), view);
  ASSERT_EQ(mesh.edges.size(), 1u) << "its diagonal";
  EXPECT_EQ(mesh.edges[0].from, (Vec2{0, 0}));
  EXPECT_EQ(mesh.edges[0].to, (Vec2{0.5, 0.5}));
  EXPECT_THAT(mesh.boundary, IsEmpty());
  EXPECT_THAT(mesh.surface, IsEmpty());
  EXPECT_EQ(panel_of(FlowFigureKind::velocity, straight_jet(), view).faces.size(), 2u);
}

TEST(FlowFigure, ColoursAreOverTheLargestSpeedOfAllPanels) {
  FlowOfRun slow = straight_jet();
  set_velocity(slow, [](Vec2 p) { return Vec2{0.3 * p.y, 0.4 * p.y}; });
  EXPECT_DOUBLE_EQ(flow_figure(FlowFigureKind::velocity, {slow}, kAll).full, 0.5);
  const FlowFigure both = flow_figure(FlowFigureKind::velocity, {slow, straight_jet()}, kAll);
  EXPECT_DOUBLE_EQ(both.full, 2);
  ASSERT_EQ(both.panels.at(0).faces.size(), 24u);
  for (const DrawnTriangle& face : both.panels[0].faces) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(face.value[k], 0.5 * face.corner[k].y);
  }
  EXPECT_EQ(flow_figure(FlowFigureKind::velocity, {straight_jet()}, View{0.1, 0.4, 0.1, 0.4}).full, 1.5)
      << "what is beside the window is not measured";
}

TEST(FlowFigure, ArrowsAreTheVelocityAtThePointsOfARegularGridInTheFluid) {
  FlowOfRun run = straight_jet();
  set_velocity(run, [](Vec2 p) { return Vec2{1 + 0.5 * p.x, 0.25 * p.y - 0.1 * p.x}; });
  const FlowFigure figure = flow_figure(FlowFigureKind::velocity, {run}, kAll);
  EXPECT_DOUBLE_EQ(figure.spacing, 0.2);
  EXPECT_LT(figure.length, figure.spacing) << "arrows would run into each other";
  const auto& arrows = figure.panels.at(0).arrows;
  EXPECT_EQ(arrows.size(), 15u * 5u) << "every point of the grid that lies in the fluid, and no other";
  for (const DrawnVelocity& arrow : arrows) {
    const Vec2 p = 0.5 * (arrow.tail + arrow.head), v{1 + 0.5 * p.x, 0.25 * p.y - 0.1 * p.x};
    for (const double at : {p.x, p.y}) {
      EXPECT_NEAR(std::remainder(at - figure.spacing / 2, figure.spacing), 0, 1e-12);
    }
    const Vec2 way = (figure.full / figure.length) * (arrow.head - arrow.tail);
    EXPECT_NEAR(way.x, v.x, 1e-9);
    EXPECT_NEAR(way.y, v.y, 1e-9);
    EXPECT_NEAR(arrow.ratio, norm(v) / figure.full, 1e-12);
  }
}

TEST(FlowFigure, NoArrowIsCutOffByTheWindow) {
  const View view{-0.53, 0.47, 0.05, 0.95};
  const FlowFigure figure = flow_figure(FlowFigureKind::velocity, {straight_jet()}, view);
  EXPECT_GT(figure.panels.at(0).arrows.size(), 100u);
  for (const DrawnVelocity& arrow : figure.panels[0].arrows) {
    for (const Vec2 end : {arrow.tail, arrow.head}) {
      EXPECT_TRUE(end.x >= view.left && end.x <= view.right && end.y >= view.bottom && end.y <= view.top);
    }
  }
}

TEST(FlowFigure, NoArrowLeavesTheFluid) {
  FlowOfRun run = straight_jet();
  set_velocity(run, [](Vec2) { return Vec2{0, 1}; });
  // Arrows of 0.18 H: those whose middles are 0.04 H below the surface would reach into the air.
  auto& position = std::get<std::vector<double>>(run.frame.vertices[0].values);
  for (std::size_t k = 1; k < position.size(); k += 2) position[k] *= 0.94;
  const auto arrows = flow_figure(FlowFigureKind::velocity, {run}, kAll).panels.at(0).arrows;
  EXPECT_EQ(arrows.size(), 15u * 4u);
  for (const DrawnVelocity& arrow : arrows) EXPECT_LT(arrow.head.y, 0.94);
}

TEST(FlowFigure, FluidAtRestHasNoArrows) {
  FlowOfRun run = straight_jet();
  set_velocity(run, [](Vec2) { return Vec2{}; });
  const FlowFigure figure = flow_figure(FlowFigureKind::velocity, {run}, {});
  EXPECT_EQ(figure.full, 0);
  EXPECT_THAT(figure.panels.at(0).arrows, IsEmpty());
}

TEST(FlowFigure, WhatIsNoNumberIsLeftOut) {
  FlowOfRun run = straight_jet();
  std::get<std::vector<double>>(run.frame.vertices[1].values)[0] =
      std::nan("");  // the lower left corner, of 2 triangles
  const FlowFigure figure = flow_figure(FlowFigureKind::velocity, {run}, kAll);
  EXPECT_EQ(figure.panels.at(0).faces.size(), 22u);
  EXPECT_EQ(figure.full, 2);
}

TEST(FlowFigure, TheDefaultWindowIsAroundTheLipAndEndsAtTheFluid) {
  const View small = default_view(straight_jet());
  EXPECT_NEAR(small.left, -1.1, 1e-12);
  EXPECT_NEAR(small.right, 2.1, 1e-12);
  EXPECT_NEAR(small.bottom, -0.1, 1e-12);
  EXPECT_NEAR(small.top, 1.2, 1e-12);
  FlowOfRun longer = straight_jet();
  for (double& place : std::get<std::vector<double>>(longer.frame.vertices[0].values)) place *= 5;
  EXPECT_EQ(default_view(longer).left, -2);
  EXPECT_EQ(default_view(longer).right, 4);
  for (const FlowPanel& panel : flow_figure(FlowFigureKind::mesh, {straight_jet(), longer}, {}).panels) {
    EXPECT_EQ(panel.view.right, 4) << "one for all panels";
    EXPECT_NEAR(panel.view.top, 5.2, 1e-12);
  }
}

TEST(FlowFigure, WhatCannotBeSeenIsSaid) {
  EXPECT_THAT(
      [] {
        flow_figure(FlowFigureKind::mesh, {straight_jet()}, View{5, 6, 0, 1});
      },
      testing::ThrowsMessage<std::invalid_argument>(HasSubstr("x from -1 to 2 H")));
}

TEST(FlowFigure, AFrameThatDoesNotFitTogetherIsDamage) {
  FlowOfRun run = straight_jet();
  std::get<std::vector<std::int64_t>>(run.frame.triangles[0].values)[4] = 21;
  EXPECT_THROW(flow_figure(FlowFigureKind::mesh, {run}, {}), store::StoreError);
  run = straight_jet();
  run.frame.vertices.pop_back();
  EXPECT_THROW(flow_figure(FlowFigureKind::velocity, {run}, {}), store::StoreError);
  EXPECT_NO_THROW(flow_figure(FlowFigureKind::mesh, {run}, {})) << "the mesh needs no velocities";
}

}  // namespace
}  // namespace seapile::present
