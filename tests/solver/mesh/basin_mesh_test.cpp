// Meshes of basins, mirror images of themselves.
#include "solver/mesh/basin_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>

#include "solver/mesh/quality.h"

namespace seapile::mesh {
namespace {

constexpr double kWidth = 5, kLevel = 2.4, kRadius = 0.125, kSize = 0.112;
const auto kEven = [](base::Vec2) { return kSize; };

/// A pile whose lowest point lies `depth` under a level with waves of some height; depth 0: no pile.
BasinOutline outline(double depth, bool conical, double waves = 0) {
  BasinOutline outline{kWidth, {}, {}};
  const double first = depth > 0 ? kRadius : 0;
  const int count = static_cast<int>(std::lround((kWidth / 2 - first) / kSize));
  for (int i = 0; i <= count; ++i) {
    const double x = i == count ? kWidth / 2 : first + (kWidth / 2 - first) * i / count;
    outline.top.push_back({x, kLevel + waves * std::cos(5 * x)});
  }
  const double apex = kLevel - depth;
  if (depth > 0) outline.pile = {{0, apex}, {kRadius, conical ? apex + kRadius * std::sqrt(3) : apex}};
  return outline;
}

std::vector<base::Vec2> places(const TriangleMesh& mesh, std::int32_t tag) {
  std::vector<base::Vec2> places;
  for (const BoundaryEdge& e : mesh.boundary)
    if (e.tag == tag) places.insert(places.end(), {mesh.position[e.from], mesh.position[e.to]});
  std::ranges::sort(places, [](base::Vec2 a, base::Vec2 b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

TEST(BasinMesh, IsAMirrorImageOfItselfBitForBit) {
  for (const double depth : {0.0, 1.3}) {
    const TriangleMesh mesh = basin_mesh(outline(depth, true, 0.05), kEven);
    std::map<std::pair<double, double>, std::int32_t> vertex_at;
    for (std::size_t v = 0; v < mesh.vertices(); ++v)
      vertex_at[{mesh.position[v].x, mesh.position[v].y}] = static_cast<std::int32_t>(v);
    ASSERT_EQ(vertex_at.size(), mesh.vertices());  // Those of the axis are there once.
    std::vector<std::int32_t> image;
    for (const base::Vec2 p : mesh.position) image.push_back(vertex_at.at({-p.x, p.y}));
    const auto sorted = [](std::array<std::int32_t, 3> t) {
      std::ranges::sort(t);
      return t;
    };
    std::vector<std::array<std::int32_t, 3>> triangles, images;
    for (const auto& [a, b, c] : mesh.triangle) {
      triangles.push_back(sorted({a, b, c}));
      images.push_back(sorted({image[a], image[b], image[c]}));
    }
    std::ranges::sort(triangles);
    std::ranges::sort(images);
    EXPECT_EQ(triangles, images);
  }
}

TEST(BasinMesh, HasExactlyTheGivenVerticesOnItsSurface) {
  for (const double depth : {0.0, 1.3}) {
    const BasinOutline given = outline(depth, true, 0.05);
    std::vector<base::Vec2> both;
    for (const base::Vec2 p : given.top) both.insert(both.begin(), {-p.x, p.y});
    for (const base::Vec2 p : given.top)
      if (p.x > 0) both.push_back(p);
    EXPECT_EQ(places(basin_mesh(given, kEven), kBasinTop), both);
    EXPECT_EQ(places(basin_mesh(given, [](base::Vec2) { return 0.09; }), kBasinTop), both);
  }
}

TEST(BasinMesh, HasItsSidesExactlyInTheirPlacesAndTagged) {
  const BasinOutline given = outline(1.3, true);
  const TriangleMesh mesh = basin_mesh(given, kEven);
  check(mesh);
  for (const base::Vec2 p : places(mesh, kBasinBottom)) EXPECT_EQ(p.y, 0);
  for (const base::Vec2 p : places(mesh, kBasinRight)) EXPECT_EQ(p.x, kWidth / 2);
  for (const base::Vec2 p : places(mesh, kBasinLeft)) EXPECT_EQ(p.x, -kWidth / 2);
  for (const base::Vec2 p : places(mesh, kPileSleeve)) EXPECT_EQ(std::abs(p.x), kRadius);
  const double apex = given.pile[0].y, shoulder = given.pile[1].y;
  for (const base::Vec2 p : places(mesh, kPileTip)) {
    EXPECT_NEAR(p.y, apex + std::sqrt(3) * std::abs(p.x), 1e-15);
  }
  std::map<std::int32_t, double> length;
  for (const BoundaryEdge& e : mesh.boundary) length[e.tag] += norm(mesh.position[e.to] - mesh.position[e.from]);
  EXPECT_EQ(length.size(), 6u);
  EXPECT_NEAR(length[kBasinBottom], kWidth, 1e-13);
  EXPECT_NEAR(length[kBasinTop], kWidth - 2 * kRadius, 1e-13);
  EXPECT_NEAR(length[kBasinRight], kLevel, 1e-13);
  EXPECT_NEAR(length[kBasinLeft], kLevel, 1e-13);
  EXPECT_NEAR(length[kPileTip], 4 * kRadius, 1e-13);
  EXPECT_NEAR(length[kPileSleeve], 2 * (kLevel - shoulder), 1e-13);
  EXPECT_EQ(mesh.position[chain(mesh, kPileTip).front()], (base::Vec2{kRadius, shoulder}));
  EXPECT_EQ(mesh.position[chain(mesh, kPileTip).back()], (base::Vec2{-kRadius, shoulder}));
}

TEST(BasinMesh, WithoutAPileHasNoTipAndAClosedSurface) {
  const TriangleMesh mesh = basin_mesh(outline(0, false, 0.05), kEven);
  check(mesh);
  EXPECT_TRUE(places(mesh, kPileTip).empty());
  EXPECT_TRUE(places(mesh, kPileSleeve).empty());
  EXPECT_EQ(chain(mesh, kBasinTop).size(), 2 * outline(0, false).top.size() - 1);
}

TEST(BasinMesh, HasTheShapeAskedForFromTheSurfaceToTheBottom) {
  double lowest = 1;
  for (const double depth : {0.3, 0.4, 0.9, 1.4, 2.0, 2.2})
    for (const bool conical : {true, false}) {
      const TriangleMesh mesh = basin_mesh(outline(depth, conical, 0.03), kEven);
      EXPECT_GE(summary_of(quality_of(mesh)).lowest_shape, 0.7) << depth;
      lowest = std::min(lowest, summary_of(quality_of(mesh)).lowest_shape);
    }
  std::printf("lowest shape quality %.3f\n", lowest);
}

// Where water is shallower than the size, edges are shorter than it.
TEST(BasinMesh, HasTheShapeAskedForInNarrowGaps) {
  for (const double gap : {0.015, 0.03, 0.06}) {
    const TriangleMesh mesh = basin_mesh(outline(kLevel - gap, false), kEven);
    EXPECT_GE(summary_of(quality_of(mesh)).lowest_shape, 0.7) << gap;
  }
  for (const double sleeve : {0.05, 0.08}) {
    const TriangleMesh mesh = basin_mesh(outline(sleeve, false), kEven);
    EXPECT_GE(summary_of(quality_of(mesh)).lowest_shape, 0.7) << sleeve;
  }
}

TEST(BasinMesh, HasTheShapeAskedForWhereSizeAndSurfaceDiffer) {
  for (const double size : {0.05, 0.18}) {
    const TriangleMesh mesh = basin_mesh(outline(1.1, true, 0.03), [&](base::Vec2) { return size; });
    EXPECT_GE(summary_of(quality_of(mesh)).lowest_shape, 0.7) << size;
  }
}

TEST(BasinMesh, GrowsFromThePileAsTheSizeSays) {
  BasinOutline given = outline(1.3, false);
  const auto size = [](base::Vec2 p) {
    return std::min(0.2, 0.05 + 0.15 * std::hypot(std::max(0.0, p.x - kRadius), std::max(0.0, kLevel - 1.3 - p.y)));
  };
  given.top = {{kRadius, kLevel}};
  while (given.top.back().x < kWidth / 2)
    given.top.push_back({std::min(kWidth / 2, given.top.back().x + size(given.top.back())), kLevel});
  given.top.erase(given.top.end() - 2);  // The last piece but one would be followed by what is left.
  const TriangleMesh mesh = basin_mesh(given, size);
  double ratio = 0;
  for (const auto& t : mesh.triangle) {
    const base::Vec2 a = mesh.position[t[0]], b = mesh.position[t[1]];
    ratio += norm(b - a) / size({std::abs(0.5 * (a.x + b.x)), 0.5 * (a.y + b.y)});
  }
  EXPECT_NEAR(ratio / static_cast<double>(mesh.triangles()), 1, 0.25);
  EXPECT_LT(places(mesh, kPileSleeve).size(), 2 * 1.3 / 0.04);
  EXPECT_GT(places(mesh, kPileSleeve).size(), 2 * 1.3 / 0.06);
}

TEST(BasinMesh, GivesTheSameBitsAgain) {
  const TriangleMesh first = basin_mesh(outline(0.4, false), kEven);
  basin_mesh(outline(2, true), kEven);
  const TriangleMesh second = basin_mesh(outline(0.4, false), kEven);
  ASSERT_EQ(first.vertices(), second.vertices());
  EXPECT_EQ(std::memcmp(first.position.data(), second.position.data(), first.vertices() * sizeof(base::Vec2)), 0);
  EXPECT_EQ(first.triangle, second.triangle);
}

TEST(BasinMesh, SaysHowGoodTheBestWasWhenNoneIsGoodEnough) {
  try {
    basin_mesh(outline(1, true), kEven, 0.99);
    ADD_FAILURE() << "was meshed";
  } catch (const NoMesh& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("the best has a shape quality of 0.8"));
  }
}

TEST(BasinMesh, HasGmshsWordsWhenThereIsNone) {
  BasinOutline crossing = outline(1, true);
  crossing.top[5].y = -0.1;
  try {
    basin_mesh(crossing, kEven);
    ADD_FAILURE() << "was meshed";
  } catch (const NoMesh& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("Gmsh could not mesh the domain: "));
  }
}

TEST(BasinMesh, RefusesAnOutlineThatIsNone) {
  const auto refused = [](auto change) {
    BasinOutline given = outline(1, true);
    change(given);
    EXPECT_THROW(basin_mesh(given, kEven), std::logic_error);
  };
  refused([](BasinOutline& o) { o.top.pop_back(); });                // Does not reach the wall.
  refused([](BasinOutline& o) { o.top.erase(o.top.begin()); });      // Nor the pile.
  refused([](BasinOutline& o) { o.pile.clear(); });                  // Nor the middle.
  refused([](BasinOutline& o) { o.pile.erase(o.pile.begin()); });    // A pile that does not begin in the middle.
  refused([](BasinOutline& o) { std::swap(o.top[3], o.top[4]); });   // Folded.
  refused([](BasinOutline& o) { o.pile.back().y = kLevel + 0.1; });  // A shoulder above the water.
  refused([](BasinOutline& o) { o.pile.front().y = -0.1; });         // A tip below the bottom.
}

}  // namespace
}  // namespace seapile::mesh
