#include "solver/coupling/deposit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "solver/coupling/porosity.h"
#include "solver/grains/packing.h"
#include "tests/solver/coupling/meshes.h"

namespace seapile::coupling {
namespace {

using base::uniform;
using base::Vec2;
using grains::Disc;
using mesh::TriangleMesh;

double area_of(const Disc& d) { return std::numbers::pi * d.radius * d.radius; }

/// Discs of 11 to 19 mm with centres in a rectangle.
std::vector<Disc> scattered(int count, Vec2 low, Vec2 high, double least = 0.011, double most = 0.019) {
  std::vector<Disc> discs;
  for (int i = 0; i < count; ++i)
    discs.push_back(
        {uniform(low.x, high.x, 2, 0, i), uniform(low.y, high.y, 2, 1, i), uniform(least, most, 2, 2, i), 0});
  return discs;
}

Deposit fresh(const TriangleMesh& mesh, std::span<const Disc> discs, Kernel kernel = Kernel::disc) {
  Location location(mesh);
  return deposit(mesh, location, discs, kernel);
}

/// One disc's row, (vertices).
std::vector<double> row(const Deposit& d, std::size_t grain, std::size_t vertices) {
  std::vector<double> volume(vertices);
  for (std::int32_t k = d.first[grain]; k < d.first[grain + 1]; ++k) volume[d.vertex[k]] = d.volume[k];
  return volume;
}
std::vector<double> row_of(const TriangleMesh& mesh, const Disc& disc, Kernel kernel = Kernel::disc) {
  return row(fresh(mesh, std::span(&disc, 1), kernel), 0, mesh.vertices());
}

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

double worst(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t j = 0; j < a.size(); ++j) most = std::max(most, std::abs(a[j] - b[j]));
  return most;
}

void expect_equal(const Deposit& a, const Deposit& b) {
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.vertex, b.vertex);
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_EQ(a.immersed, b.immersed);
}

/// Water around a pile that stands in from above, 0.3 m wide.
TriangleMesh notched() {
  return part_of(shaken(1.1, 1), [](Vec2 p) { return std::abs(p.x - 0.55) > 0.15 || p.y < 0.5; });
}

/// Flat triangles, 3 mm high, with a corner over the middle of their long edges.
TriangleMesh flat() {
  TriangleMesh mesh = shaken(0.6, 0.6);
  for (Vec2& p : mesh.position) p = {p.x + 0.5 * p.y, 0.03 * p.y};
  return mesh;
}

TEST(Deposit, AreaAndCentreOfADiscInsideAreKept) {
  const TriangleMesh mesh = shaken(1, 1);
  for (const double r : {1e-6, 1e-3, 0.015, 0.1}) {
    const auto discs = scattered(3000, {r, r}, {1 - r, 1 - r}, r * 0.7, r);
    for (const Kernel kernel : {Kernel::disc, Kernel::hat}) {
      const Deposit d = fresh(mesh, discs, kernel);
      for (std::size_t i = 0; i < discs.size(); ++i) {
        double area = 0;
        Vec2 first;
        for (std::int32_t k = d.first[i]; k < d.first[i + 1]; ++k) {
          EXPECT_GE(d.volume[k], 0);
          EXPECT_EQ(std::count(d.vertex.begin() + d.first[i], d.vertex.begin() + k, d.vertex[k]), 0);
          area += d.volume[k];
          first = first + d.volume[k] * (mesh.position[d.vertex[k]] - Vec2{discs[i].x, discs[i].y});
        }
        const double all = area_of(discs[i]), rounding = r < 1e-4 ? 1e-11 : 1e-13;  // of places, over r
        ASSERT_NEAR(area / all, 1, r < 1e-4 ? 1e-10 : 1e-13) << r;
        ASSERT_NEAR(first.x / all, 0, rounding) << r;
        ASSERT_NEAR(first.y / all, 0, rounding) << r;
      }
    }
  }
}

TEST(Deposit, IsTheIntegralOfTheLinearFunctions) {
  const TriangleMesh square = shaken(0.6, 0.6), pile = notched(), thin = flat();
  struct Case {
    const TriangleMesh& mesh;
    Vec2 low, high;
    double least, most;
  };
  for (const auto& [mesh, low, high, least, most] :
       {Case{square, {-0.01, -0.01}, {0.61, 0.61}, 0.011, 0.019}, Case{square, {0, 0}, {0.6, 0.6}, 0.03, 0.3},
        Case{pile, {0.35, 0.4}, {0.75, 1.05}, 0.011, 0.1}, Case{thin, {0, 0}, {0.8, 0.018}, 0.001, 0.019}}) {
    const auto discs = scattered(60, low, high, least, most);
    const Deposit d = fresh(mesh, discs);
    for (std::size_t i = 0; i < discs.size(); ++i)
      EXPECT_LT(worst(row(d, i, mesh.vertices()), twin(mesh, discs[i])), 3e-6 * area_of(discs[i])) << i;
  }
}

TEST(Deposit, OnARefinedMeshIsTheSame) {
  // The linear functions of a mesh are sums of those of its refinement. There a disc holds many vertices and is summed
  // triangle by triangle, here it is mostly in one triangle, crosses a few edges or holds one vertex.
  auto scene = [](const TriangleMesh& coarse, std::vector<Disc> discs) {
    const Refined once = refined(coarse), twice = refined(once.mesh), thrice = refined(twice.mesh);
    const Deposit here = fresh(coarse, discs), there = fresh(thrice.mesh, discs);
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const auto fine = row(there, i, thrice.mesh.vertices());
      const auto gathered = once.gathered(
          twice.gathered(thrice.gathered(fine, twice.mesh.vertices()), once.mesh.vertices()), coarse.vertices());
      ASSERT_LT(worst(row(here, i, coarse.vertices()), gathered), 2e-14 * area_of(discs[i])) << i;
    }
  };
  scene(notched(), scattered(3000, {0.02, 0.02}, {1.08, 0.98}));
  scene(notched(), scattered(500, {0.02, 0.02}, {1.08, 0.98}, 0.03, 0.1));
  scene(flat(), scattered(500, {0, 0}, {0.9, 0.018}, 0.001, 0.019));
  for (const int triangles : {4, 7, 8, 9, 11, 12, 20})
    scene(fan(triangles), scattered(200, {0.49, 0.49}, {0.51, 0.51}));
}

TEST(Deposit, OnlyWhatLiesInTheMeshCounts) {
  const TriangleMesh mesh = shaken(0.5, 0.5);
  const auto discs = scattered(2000, {-0.02, -0.02}, {0.52, 0.52});
  const Deposit d = fresh(mesh, discs);
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const auto& [x, y, r, unused] = discs[i];
    EXPECT_NEAR(sum(row(d, i, mesh.vertices())), grains::disc_area_in_rectangle(r, -x, 0.5 - x, -y, 0.5 - y),
                1e-13 * area_of(discs[i]));
  }
}

TEST(Deposit, ADiscAgainstAWallIsCutOffThere) {
  // Overlaps of contacts, and deeper ones that are summed triangle by triangle.
  const TriangleMesh mesh = notched();
  const Refined once = refined(mesh), twice = refined(once.mesh), thrice = refined(twice.mesh);
  std::vector<Disc> discs;
  for (const double overlap : {1e-12, 1e-9, 1e-7, 1e-5, 1e-3, 9.9e-3, 1.1e-2, 0.1, 0.5})
    for (int i = 0; i < 40; ++i) {
      const double r = uniform(0.011, 0.019, 7, 0, i), to_wall = (1 - overlap) * r;
      discs.push_back({to_wall, uniform(0.1, 0.9, 7, 1, i), r, 0});
      discs.push_back({uniform(0.1, 1, 7, 2, i), to_wall, r, 0});
    }
  const Deposit here = fresh(mesh, discs), there = fresh(thrice.mesh, discs);
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const auto gathered =
        once.gathered(twice.gathered(thrice.gathered(row(there, i, thrice.mesh.vertices()), twice.mesh.vertices()),
                                     once.mesh.vertices()),
                      mesh.vertices());
    ASSERT_LT(worst(row(here, i, mesh.vertices()), gathered), 2e-14 * area_of(discs[i])) << i;
  }
}

TEST(Deposit, AFloatingDiscHasItsShareUnderWater) {
  const TriangleMesh mesh = shaken(0.5, 0.5);
  const double r = 0.017;
  for (const double h : {-1.1, -0.9, -0.3, 0.0, 0.4, 0.99, 1.0, 1.1})  // of the surface above the centre
    for (const double x : {0.2, 0.2345, 0.25}) {
      const auto volume = row_of(mesh, {x, 0.5 - h * r, r, 0});
      EXPECT_NEAR(sum(volume), grains::disc_area_below(r, h * r), 1e-13 * r * r) << h;
      if (h == 0) {
        EXPECT_NEAR(sum(volume), std::numbers::pi * r * r / 2, 1e-13 * r * r);
      }
    }
}

TEST(Deposit, AwkwardPlacesAreNone) {
  // Squares of 0.1 with diagonals from lower left to upper right.
  const TriangleMesh mesh = shaken(0.5, 0.5, 0);
  const double diagonal = std::numbers::sqrt2 / 2;
  for (const Disc& d : {
           Disc{0.2, 0.2, 0.02, 0},            // the centre on a vertex
           Disc{0.2, 0.25, 0.02, 0},           // the centre on an edge
           Disc{0.25, 0.25, 0.02, 0},          // and on a diagonal
           Disc{0.22, 0.2, 0.02, 0},           // a vertex on the circle, the centre on an edge
           Disc{0.212, 0.216, 0.02, 0},        // a vertex on the circle (3-4-5)
           Disc{0.25, 0.22, 0.02, 0},          // an edge that touches
           Disc{0.2, 0.2, 0.1, 0},             // four vertices on the circle
           Disc{0.2, 0.2, 0.1 * diagonal, 0},  // diagonals that touch
           Disc{0.25, 0.25, 0.35, 0},          // larger than the mesh
           Disc{0.25, 0.25, 5, 0},             // far larger
           Disc{0.25, 0.5, 0.02, 0},           // the centre on the surface
           Disc{0.2, 0.5, 0.02, 0},            // at one of its vertices
           Disc{0.5, 0.5, 0.02, 0},            // in a corner
           Disc{0.25, 0.52, 0.02, 0},          // touches from outside
           Disc{0.51, 0.51, 0.02, 0},          // the corner only
           Disc{0.2 + 1e-17, 0.2, 0.02, 0},    // less than a rounding away
           Disc{0.2, std::nextafter(0.2, 1), 0.02, 0},
       }) {
    const auto volume = row_of(mesh, d);
    EXPECT_LT(worst(volume, twin(mesh, d)), 3e-6 * area_of(d)) << d.x << " " << d.y << " " << d.radius;
    EXPECT_NEAR(sum(volume), grains::disc_area_in_rectangle(d.radius, -d.x, 0.5 - d.x, -d.y, 0.5 - d.y),
                1e-13 * area_of(d));
  }
}

TEST(Deposit, WhatIsNowhereDepositsNothing) {
  const TriangleMesh mesh = shaken(0.5, 0.5);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  const std::vector<Disc> discs = {{0.25, 0.6, 0.02, 0}, {-1e9, 1e9, 1, 0}, {nan, 0.2, 0.02, 0}, {0.2, infinite, 1, 0}};
  for (const Kernel kernel : {Kernel::disc, Kernel::hat})
    EXPECT_EQ(sum(solid_volume(fresh(mesh, discs, kernel), mesh.vertices())), 0);
  EXPECT_EQ(fresh(mesh, {}).first, std::vector<std::int32_t>{0});
}

TEST(Deposit, ADiscReachesAcrossASlit) {
  // A slit of 5 mm from the top: what lies beyond it hangs together with the rest only far away.
  std::vector<double> x = mesh::even(0, 0.2, 2);
  for (const double right : mesh::even(0.205, 0.405, 2)) x.push_back(right);
  const TriangleMesh slit =
      part_of(mesh::rectangle(x, mesh::even(0, 0.4, 4)), [](Vec2 p) { return p.x < 0.2 || p.x > 0.205 || p.y < 0.1; });
  for (const double centre : {0.19, 0.2, 0.2025, 0.21}) {
    const Disc d{centre, 0.25, 0.02, 0};
    const auto volume = row_of(slit, d);
    EXPECT_NEAR(sum(volume),
                grains::disc_area_in_rectangle(0.02, -1, 0.2 - centre, -1, 1) +
                    grains::disc_area_in_rectangle(0.02, 0.205 - centre, 1, -1, 1),
                1e-13 * area_of(d));
    EXPECT_LT(worst(volume, twin(slit, d)), 3e-6 * area_of(d));
  }
}

/// The largest second difference over dt^2 of any V_ij, while a disc of r = 15 mm follows a path s -> place.
template <class Path>
double unrest(const TriangleMesh& mesh, Kernel kernel, const Path& path, double s0, double s1, double dt) {
  Location location(mesh);
  const auto at = [&](double s) {
    const Vec2 p = path(s);
    const Disc d{p.x, p.y, 0.015, 0};
    return row(deposit(mesh, location, std::span(&d, 1), kernel), 0, mesh.vertices());
  };
  double most = 0;
  for (double s = s0; s < s1; s += (s1 - s0) / 4000) {
    const auto before = at(s - dt), now = at(s), after = at(s + dt);
    for (std::size_t j = 0; j < now.size(); ++j)
      most = std::max(most, std::abs(after[j] - 2 * now[j] + before[j]) / (dt * dt));
  }
  return most;
}

TEST(Deposit, HasNoKinkWhereADiscCrossesAnEdgeOrAVertex) {
  // Along a path with |path'| = 1, V'' is at most the sum over the edges in the disc of kink times length: here, with
  // heights of 0.07 m and more, 2/0.07 times some radii. The literature's kernel has V' jump by pi r^2 kink.
  const TriangleMesh mesh = shaken(0.5, 0.5, 0);
  const auto across = [](double s) { return Vec2{0.2 + s, 0.263}; };
  const auto through = [](double s) { return Vec2{0.2 + 0.8 * s, 0.2 + 0.6 * s}; };
  const auto past = [](double s) { return Vec2{0.2 + s, 0.2 + 0.015 * 0.9}; };
  const auto round = [](double s) {
    return Vec2{0.3 + 0.006 * std::cos(s / 0.006), 0.3 + 0.006 * std::sin(s / 0.006)};
  };
  const auto expect_smooth = [&](const auto& path, const char* name) {
    const double coarse = unrest(mesh, Kernel::disc, path, -0.04, 0.04, 1e-5),
                 fine = unrest(mesh, Kernel::disc, path, -0.04, 0.04, 1e-6);
    EXPECT_LT(coarse, 6 * 0.015 * 2 / 0.07) << name;
    EXPECT_NEAR(fine / coarse, 1, 0.05) << name;
    const double kicked = unrest(mesh, Kernel::hat, path, -0.04, 0.04, 8e-5),
                 more = unrest(mesh, Kernel::hat, path, -0.04, 0.04, 4e-5);
    EXPECT_GT(more / kicked, 1.6) << name;
    EXPECT_GT(kicked, 20 * coarse) << name;
  };
  expect_smooth(across, "across an edge");
  expect_smooth(through, "through a vertex");
  expect_smooth(past, "past a vertex");
  expect_smooth(round, "round a vertex");
}

TEST(Deposit, TheHatIsTheLinearFunctionAtTheCentre) {
  const TriangleMesh mesh = shaken(0.5, 0.5, 0);
  const auto volume = row_of(mesh, {0.23, 0.21, 0.02, 0}, Kernel::hat);  // below the diagonal of its square
  const double all = std::numbers::pi * 0.02 * 0.02;
  EXPECT_NEAR(volume[2 + 2 * 6], 0.7 * all, 1e-15);
  EXPECT_NEAR(volume[3 + 2 * 6], 0.2 * all, 1e-15);
  EXPECT_NEAR(volume[3 + 3 * 6], 0.1 * all, 1e-15);
  EXPECT_NEAR(sum(volume), all, 1e-15);
  EXPECT_NEAR(sum(row_of(mesh, {0.23, 0.499, 0.02, 0}, Kernel::hat)), all, 1e-15);
  EXPECT_EQ(sum(row_of(mesh, {0.23, 0.501, 0.02, 0}, Kernel::hat)), 0);
}

TEST(Deposit, DependsOnMeshAndDiscAlone) {
  TriangleMesh mesh = notched();
  auto discs = scattered(3000, {-0.01, -0.01}, {1.11, 1.01});
  for (int i = 0; i < 300; ++i) {  // many on vertices and edges
    const auto& [a, b, c] = mesh.triangle[i % mesh.triangles()];
    const Vec2 p = 0.5 * (mesh.position[a] + mesh.position[i % 2 == 0 ? a : b]);
    discs[i].x = p.x;
    discs[i].y = p.y;
  }
  for (const Kernel kernel : {Kernel::disc, Kernel::hat}) {
    const Deposit once = fresh(mesh, discs, kernel);

    Location location(mesh);  // remembers from places elsewhere, and from another shape of the mesh
    TriangleMesh other = mesh;
    for (Vec2& p : other.position) p.y *= 0.9;
    deposit(other, location, scattered(3000, {1.11, 0.5}, {-0.3, -0.2}), kernel);
    expect_equal(deposit(mesh, location, discs, kernel), once);
    expect_equal(deposit(mesh, location, discs, kernel), once);
    for (std::size_t i = 0; i < discs.size(); ++i) location.last[i] = static_cast<std::int32_t>(i % mesh.triangles());
    expect_equal(deposit(mesh, location, discs, kernel), once);

    location.spare = {fresh(mesh, std::span(discs).first(500), kernel), once};  // for their memory alone
    for (Deposit& spare : location.spare) std::ranges::fill(spare.volume, 7.0);
    expect_equal(deposit(mesh, location, discs, kernel), once);
    expect_equal(deposit(mesh, location, discs, kernel), once);
    EXPECT_TRUE(location.spare.empty());

    TriangleMesh near = mesh;  // so little that triangles are looked for where they were
    for (Vec2& p : near.position) p = {p.x + 0.006 * std::sin(20 * p.y), p.y + 0.006 * std::cos(20 * p.x)};
    Location kept(near);
    expect_equal(deposit(mesh, kept, discs, kernel), once);
    EXPECT_EQ(kept.position, near.position);

    for (const auto set : {base::InstructionSet::generic, base::InstructionSet::avx2, base::InstructionSet::avx512})
      if (base::available(set)) {
        expect_equal(deposit(mesh, location, discs, kernel, nullptr, set), once);
      }

    for (const int threads : {1, 2, 3}) {
      base::Crew crew(threads);
      Location cold(mesh);
      expect_equal(deposit(mesh, cold, discs, kernel, &crew), once);
    }

    std::vector<Disc> backwards(discs.rbegin(), discs.rend());
    const Deposit turned = fresh(mesh, backwards, kernel);
    for (std::size_t i = 0; i < discs.size(); ++i)
      ASSERT_EQ(row(once, i, mesh.vertices()), row(turned, discs.size() - 1 - i, mesh.vertices()));
  }
}

TEST(Deposit, ALocationOfAnotherMeshIsRefused) {
  Location location(shaken(0.5, 0.5));
  EXPECT_THROW(deposit(shaken(0.5, 0.6), location, {}), std::logic_error);
  EXPECT_THROW(deposit(mesh::rectangle(mesh::even(0, 1, 25), mesh::even(0, 1, 1)), location, {}), std::logic_error);
}

TEST(Porosity, VertexVolumesShareTheMesh) {
  const TriangleMesh mesh = shaken(0.5, 0.7);
  EXPECT_NEAR(sum(vertex_volume(mesh)), 0.35, 1e-15);
  // 6 of 12 half squares' thirds.
  EXPECT_NEAR(vertex_volume(shaken(0.5, 0.5, 0))[2 + 2 * 6], 0.01, 1e-16);
}

TEST(Porosity, OfAHexagonalPackingIsItsClosedForm) {
  // One disc of 30 mm for each sqrt(3)/2 a^2. A hat of 0.1 m is some spacings wide and smooths their rows: what is
  // left of them at a vertex is some thousandths with discs, and about as much with hats at centres.
  const double a = 0.031, r = 0.015;
  const TriangleMesh mesh = shaken(1, 1, 0.01);
  std::vector<Disc> discs;
  for (int j = -2; j * a * std::sqrt(0.75) < 1.05; ++j)
    for (int i = -2; i * a < 1.05; ++i) discs.push_back({(i + 0.5 * (j & 1)) * a, j * a * std::sqrt(0.75), r, 0});
  const double exact = 1 - 2 * std::numbers::pi * r * r / (std::numbers::sqrt3 * a * a);
  const auto volume = vertex_volume(mesh);
  const Porosity p = porosity(solid_volume(fresh(mesh, discs), mesh.vertices()), volume, 0.01);
  double water = 0, deviation = 0;
  std::size_t inner = 0;
  for (std::size_t j = 0; j < mesh.vertices(); ++j) {
    water += p.phi[j] * volume[j];
    const Vec2 x = mesh.position[j];
    if (x.x < 0.05 || x.x > 0.95 || x.y < 0.05 || x.y > 0.95) continue;
    EXPECT_NEAR(p.phi[j], exact, 0.02);
    deviation += (p.phi[j] - exact) * (p.phi[j] - exact);
    ++inner;
  }
  EXPECT_LT(std::sqrt(deviation / static_cast<double>(inner)), 0.006);
  EXPECT_NEAR(water, exact, 0.003);  // the square has an edge of 32 spacings
  EXPECT_EQ(p.clipped, 0);
}

TEST(Porosity, WhatIsClippedIsTold) {
  const std::vector<double> solid = {0, 0.5, 0.95, 1.2}, volume = {1, 1, 1, 1};
  const Porosity p = porosity(solid, volume, 0.1);
  EXPECT_EQ(p.phi, (std::vector<double>{1, 0.5, 0.1, 0.1}));
  EXPECT_NEAR(p.clipped, 0.05 + 0.3, 1e-15);
}

}  // namespace
}  // namespace seapile::coupling
