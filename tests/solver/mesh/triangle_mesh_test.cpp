// What check(), boundary_of() and chain() accept, and every fault that they name.
#include "solver/mesh/triangle_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "solver/mesh/rectangle.h"

namespace seapile::mesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TriangleMesh grid(int columns, int rows) { return rectangle(even(0, columns, columns), even(0, rows, rows)); }

/// The boundary of a mesh's triangles, all with one tag.
void retag(TriangleMesh& mesh) {
  mesh.boundary = boundary_of(mesh.triangle, mesh.position, [](base::Vec2, base::Vec2) { return 0; });
}

/// The words of the std::logic_error that `act` throws; empty when it throws none.
template <class Act>
std::string objection(Act&& act) {
  try {
    act();
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return {};
}
std::string objection_to(const TriangleMesh& mesh) {
  return objection([&] { check(mesh); });
}

TEST(TriangleMesh, AGridIsAMesh) {
  for (const int columns : {1, 2, 5})
    for (const int rows : {1, 3}) EXPECT_EQ(objection_to(grid(columns, rows)), "");
}

TEST(TriangleMesh, TheBoundaryRunsAroundTheDomainWithItToTheLeft) {
  const TriangleMesh mesh = grid(4, 3);
  ASSERT_EQ(mesh.boundary.size(), 14u);
  double doubled = 0;
  std::multiset<std::int32_t> left, entered;
  for (const BoundaryEdge& e : mesh.boundary) {
    const base::Vec2 a = mesh.position[e.from], b = mesh.position[e.to];
    doubled += a.x * b.y - b.x * a.y;
    left.insert(e.from);
    entered.insert(e.to);
    // The edge is one of its triangle, in the sense in which the triangle turns.
    const auto& corner = mesh.triangle[e.triangle];
    const auto at = std::ranges::find(corner, e.from) - corner.begin();
    ASSERT_LT(at, 3);
    EXPECT_EQ(corner[(at + 1) % 3], e.to);
  }
  EXPECT_EQ(doubled, 2 * 4 * 3);  // Counterclockwise around the area; small integers, so exactly.
  EXPECT_EQ(left, entered);
  EXPECT_EQ(std::set(left.begin(), left.end()).size(), left.size());
}

TEST(TriangleMesh, ATagIsAskedForWithThePlacesOfBothEnds) {
  const TriangleMesh mesh = grid(3, 2);
  const auto edges =
      boundary_of(mesh.triangle, mesh.position, [](base::Vec2 from, base::Vec2 to) { return from.x < to.x ? 7 : 8; });
  int rising = 0;
  for (const BoundaryEdge& e : edges) rising += e.tag == 7;
  EXPECT_EQ(rising, 3);  // Only the bottom is walked from left to right.
}

TEST(Check, NamesAFlippedTriangle) {
  TriangleMesh mesh = grid(2, 2);
  std::swap(mesh.triangle[5][0], mesh.triangle[5][1]);
  EXPECT_THAT(objection_to(mesh), HasSubstr("triangle 5 does not turn counterclockwise"));
}

TEST(Check, NamesATriangleWithoutArea) {
  TriangleMesh mesh = grid(2, 2);
  mesh.position[4] = mesh.position[0];
  EXPECT_THAT(objection_to(mesh), HasSubstr("does not turn counterclockwise"));
}

TEST(Check, NamesAPlaceThatIsNoNumber) {
  TriangleMesh mesh = grid(2, 2);
  mesh.position[4].x = std::nan("");
  EXPECT_THAT(objection_to(mesh), HasSubstr("does not turn counterclockwise"));
}

TEST(Check, NamesAVertexThatNoTriangleUses) {
  TriangleMesh mesh = grid(2, 2);
  mesh.position.push_back({0.5, 0.25});
  EXPECT_THAT(objection_to(mesh), HasSubstr("vertex 9 belongs to no triangle"));
}

TEST(Check, NamesATriangleWithAVertexThatIsNotThere) {
  for (const std::int32_t vertex : {-1, 9}) {
    TriangleMesh mesh = grid(2, 2);
    mesh.triangle[3][1] = vertex;
    EXPECT_THAT(objection_to(mesh), HasSubstr("triangle 3 has a vertex that is not there"));
  }
}

TEST(Check, RefusesABoundaryThatIsNotThatOfTheTriangles) {
  const auto with = [](auto&& change) {
    TriangleMesh mesh = grid(2, 2);
    change(mesh.boundary);
    return objection_to(mesh);
  };
  EXPECT_THAT(with([](auto& edges) { edges.pop_back(); }), HasSubstr("its boundary is not that"));
  EXPECT_THAT(with([](auto& edges) { edges.push_back(edges[0]); }), HasSubstr("its boundary is not that"));
  EXPECT_THAT(with([](auto& edges) { edges[1] = edges[0]; }), HasSubstr("its boundary is not that"));
  EXPECT_THAT(with([](auto& edges) { std::swap(edges[0].from, edges[0].to); }), HasSubstr("its boundary is not that"));
  EXPECT_THAT(with([](auto& edges) { edges[0].triangle += 1; }), HasSubstr("its boundary is not that"));
  EXPECT_EQ(with([](auto& edges) { std::ranges::reverse(edges); }), "");
}

TEST(Check, RefusesAnEdgeOfThreeTriangles) {
  TriangleMesh mesh;
  mesh.position = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0.2, -1}};
  mesh.triangle = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}};
  EXPECT_THAT(objection([&] { retag(mesh); }),
              HasSubstr("the edge between vertices 0 and 1 has more than two triangles"));
}

// Two triangles on the same side of their common edge lie over each other.
TEST(Check, RefusesTrianglesThatAreFoldedOverAnEdge) {
  TriangleMesh mesh;
  mesh.position = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  mesh.triangle = {{0, 1, 2}, {0, 1, 3}};
  EXPECT_THAT(objection([&] { retag(mesh), check(mesh); }),
              HasSubstr("the triangles at the edge between vertices 0 and 1 lie over each other"));
}

TEST(Chain, IsASideFromItsFirstVertexToItsLast) {
  const TriangleMesh mesh = grid(3, 2);
  EXPECT_THAT(chain(mesh, kBottom), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(chain(mesh, kRight), ElementsAre(3, 7, 11));
  EXPECT_THAT(chain(mesh, kTop), ElementsAre(11, 10, 9, 8));
  EXPECT_THAT(chain(mesh, kLeft), ElementsAre(8, 4, 0));
  EXPECT_THAT(chain(mesh, 17), ElementsAre());
}

TEST(Chain, RefusesAClosedBoundary) {
  TriangleMesh mesh = grid(3, 2);
  retag(mesh);
  EXPECT_THAT(objection([&] { chain(mesh, 0); }), HasSubstr("closed"));
}

TEST(Chain, RefusesABoundaryInPieces) {
  TriangleMesh mesh = grid(3, 2);
  for (BoundaryEdge& e : mesh.boundary)
    if (e.tag == kTop) e.tag = kBottom;
  EXPECT_THAT(objection([&] { chain(mesh, kBottom); }), HasSubstr("in pieces"));
}

// An open piece and a closed one: as many edges as vertices, though no vertex is left twice.
TEST(Chain, RefusesAnOpenPieceBesideAClosedOne) {
  TriangleMesh mesh;
  mesh.position = {{0, 0}, {1, 0}, {0, 1}, {5, 0}, {6, 0}, {5, 1}};
  mesh.triangle = {{0, 1, 2}, {3, 4, 5}};
  mesh.boundary = boundary_of(mesh.triangle, mesh.position, [](base::Vec2 from, base::Vec2) { return from.x == 1; });
  for (BoundaryEdge& e : mesh.boundary)
    if (e.from >= 3) e.tag = 1;
  EXPECT_THAT(objection([&] { chain(mesh, 1); }), HasSubstr("in pieces"));
}

// Two triangles that touch in a vertex only: two edges leave it.
TEST(Chain, RefusesABoundaryThatForks) {
  TriangleMesh mesh;
  mesh.position = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  mesh.triangle = {{0, 1, 2}, {0, 3, 4}};
  retag(mesh);
  EXPECT_THAT(objection([&] { chain(mesh, 0); }), HasSubstr("forks"));
}

}  // namespace
}  // namespace seapile::mesh
