// Meshes that follow a surface and a pile.
#include "solver/mesh/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>

#include "solver/base/random.h"
#include "solver/mesh/generate.h"
#include "solver/mesh/rectangle.h"

namespace seapile::mesh {
namespace {

constexpr double kRadius = 0.125, kShoulder = 1.2, kApex = 0.9835, kDepth = 2;
constexpr Zones kZones{.reach = 0.8};

std::vector<std::int32_t> by_rising_x(const TriangleMesh& mesh, const std::vector<std::int32_t>& tags) {
  std::vector<std::int32_t> vertices;
  for (const std::int32_t tag : tags) {
    std::vector<std::int32_t> side = chain(mesh, tag);
    std::ranges::reverse(side);
    for (const std::int32_t vertex : side)
      if (vertices.empty() || vertices.back() != vertex) vertices.push_back(vertex);
  }
  return vertices;
}

struct Basin {
  TriangleMesh mesh;
  MovingBoundary boundary;

  bool under_pile(std::size_t v) const { return std::abs(mesh.position[v].x) <= kRadius; }
  bool on_sleeve(std::size_t v) const {
    const base::Vec2 p = mesh.position[v];
    return std::abs(p.x) == kRadius && p.y > kShoulder && p.y < kDepth;
  }
};

/// With a conical pile in its middle.
Basin with_pile() {
  const std::vector<Corner> corners = {{{-2.5, 0}, 0},
                                       {{2.5, 0}, 1},
                                       {{2.5, kDepth}, 2},
                                       {{kRadius, kDepth}, 3},
                                       {{kRadius, kShoulder}, 4},
                                       {{0, kApex}, 5},
                                       {{-kRadius, kShoulder}, 6},
                                       {{-kRadius, kDepth}, 7},
                                       {{-2.5, kDepth}, 8}};
  Basin basin{generate(corners, [](base::Vec2) { return 0.12; }), {}};
  basin.boundary = {by_rising_x(basin.mesh, {7, 2}), by_rising_x(basin.mesh, {5, 4}), 0};
  return basin;
}

/// Without, on a grid whose rows have the given heights.
Basin without_pile(std::span<const double> rows) {
  Basin basin{rectangle(even(-1, 1, 8), rows, Diagonals::mirrored), {}};
  basin.boundary = {by_rising_x(basin.mesh, {kTop}), {}, rows[0]};
  return basin;
}

std::vector<double> waves(const Basin& basin, std::uint32_t number) {
  std::vector<double> surface;
  for (std::size_t s = 0; s < basin.boundary.surface.size(); ++s)
    surface.push_back(base::uniform(-0.05, 0.05, number, 0, s));
  return surface;
}

/// The surface's displacement over x, straight across the pile.
double over(const Basin& basin, const std::vector<double>& surface, double x) {
  for (std::size_t s = 0;; ++s) {
    const double a = basin.mesh.position[basin.boundary.surface[s]].x;
    const double b = basin.mesh.position[basin.boundary.surface[s + 1]].x;
    if (x <= b) return ((b - x) * surface[s] + (x - a) * surface[s + 1]) / (b - a);
  }
}

const std::vector<MotionKind> kKinds = {Vertical{}, kZones, Elliptic{}, Elliptic{.stiffening = 1}};

TEST(Motion, IsExactOnSurfaceTipAndBottom) {
  const Basin basin = with_pile();
  const std::vector<double> surface = waves(basin, 1);
  for (const MotionKind& kind : kKinds) {
    const std::vector<double> dy = MeshMotion(basin.mesh, basin.boundary, kind).displacements(surface, -0.07);
    for (std::size_t s = 0; s < surface.size(); ++s) EXPECT_EQ(dy[basin.boundary.surface[s]], surface[s]);
    for (const std::int32_t vertex : basin.boundary.tip) EXPECT_EQ(dy[vertex], -0.07);
    for (const std::int32_t vertex : chain(basin.mesh, 0)) EXPECT_EQ(dy[vertex], 0);
    EXPECT_GE(basin.boundary.tip.size(), 5u);
  }
}

TEST(Motion, OfNothingIsNothing) {
  const Basin basin = with_pile();
  for (const MotionKind& kind : kKinds)
    for (const double dy : MeshMotion(basin.mesh, basin.boundary, kind)
                               .displacements(std::vector<double>(basin.boundary.surface.size(), 0), 0))
      EXPECT_EQ(dy, 0);
}

TEST(Motion, OfASumIsTheSumOfTheMotions) {
  const Basin basin = with_pile();
  const std::vector<double> first = waves(basin, 1), second = waves(basin, 2);
  std::vector<double> both = first;
  for (std::size_t s = 0; s < both.size(); ++s) both[s] += 2 * second[s];
  for (const MotionKind& kind : kKinds) {
    const MeshMotion motion(basin.mesh, basin.boundary, kind);
    const auto a = motion.displacements(first, 0.03), b = motion.displacements(second, -0.04),
               sum = motion.displacements(both, 0.03 - 2 * 0.04);
    for (std::size_t v = 0; v < sum.size(); ++v) EXPECT_NEAR(sum[v], a[v] + 2 * b[v], 1e-15);
  }
}

TEST(Motion, GivesTheSameBitsAgain) {
  const Basin basin = with_pile();
  const std::vector<double> surface = waves(basin, 3);
  for (const MotionKind& kind : kKinds) {
    const MeshMotion motion(basin.mesh, basin.boundary, kind);
    const auto first = motion.displacements(surface, 0.1);
    motion.displacements(waves(basin, 4), -0.2);
    const auto second = motion.displacements(surface, 0.1);
    const auto third = MeshMotion(basin.mesh, basin.boundary, kind).displacements(surface, 0.1);
    EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(double)), 0);
    EXPECT_EQ(std::memcmp(first.data(), third.data(), first.size() * sizeof(double)), 0);
  }
}

TEST(Motion, OnTheSleeveKeepsSharesOfTheHeight) {
  const Basin basin = with_pile();
  const std::vector<double> surface = waves(basin, 5);
  for (const MotionKind& kind : kKinds) {
    const std::vector<double> dy = MeshMotion(basin.mesh, basin.boundary, kind).displacements(surface, 0.2);
    int sleeve = 0;
    for (std::size_t v = 0; v < dy.size(); ++v) {
      if (!basin.on_sleeve(v)) continue;
      const double share = (basin.mesh.position[v].y - kShoulder) / (kDepth - kShoulder);
      EXPECT_NEAR(dy[v], share * over(basin, surface, basin.mesh.position[v].x) + (1 - share) * 0.2, 1e-15);
      ++sleeve;
    }
    EXPECT_GE(sleeve, 10);
  }
}

// Thesis (4.6), and the same with the tip in the surface's place.
TEST(VerticalMotion, IsLinearOverTheHeightUnderTheTipAndBesideThePile) {
  const Basin basin = with_pile();
  const std::vector<double> surface = waves(basin, 6);
  const std::vector<double> dy = MeshMotion(basin.mesh, basin.boundary, Vertical{}).displacements(surface, 0.2);
  int under = 0;
  for (std::size_t v = 0; v < dy.size(); ++v) {
    const base::Vec2 p = basin.mesh.position[v];
    if (basin.on_sleeve(v) || p.y == kDepth) continue;
    under += basin.under_pile(v);
    const double tip = kApex + (kShoulder - kApex) * std::abs(p.x) / kRadius;
    EXPECT_NEAR(dy[v], basin.under_pile(v) ? p.y / tip * 0.2 : p.y / kDepth * over(basin, surface, p.x), 1e-15);
  }
  EXPECT_GE(under, 20);
}

// Thesis, algorithm A, up to the shoulders' height.
TEST(ZonesMotion, BlendsThePileWithTheSurface) {
  const Basin basin = with_pile();
  const std::vector<double> surface = waves(basin, 7);
  const std::vector<double> dy = MeshMotion(basin.mesh, basin.boundary, kZones).displacements(surface, 0.2);
  int with_pile_alone = 0, with_surface_alone = 0;
  for (std::size_t v = 0; v < dy.size(); ++v) {
    const base::Vec2 p = basin.mesh.position[v];
    const double distance = std::abs(p.x) - kRadius;
    const double free_surface = p.y / kDepth * over(basin, surface, p.x);
    const double a = distance < 0 ? 0 : std::min(1.0, distance / kZones.reach);
    const double b = p.y < kApex ? (kApex - p.y) / kApex : 0;
    const double alpha = std::max(a, b);
    if (p.y <= kShoulder || a == 1) {
      EXPECT_NEAR(dy[v], alpha * free_surface + (1 - alpha) * 0.2, 1e-15);
    }
    with_pile_alone += dy[v] == 0.2;
    with_surface_alone += alpha == 1;
  }
  EXPECT_GE(with_pile_alone, 5);
  EXPECT_GE(with_surface_alone, 100);
}

// Above the shoulders the pile's part fades towards the surface, or vertices near the pile would leave the water.
TEST(ZonesMotion, DoesNotJumpAtTheSurfaceOrTheSleeve) {
  const Basin basin = with_pile();
  const std::vector<double> still(basin.boundary.surface.size(), 0);
  const std::vector<double> dy = MeshMotion(basin.mesh, basin.boundary, kZones).displacements(still, 1);
  for (std::size_t v = 0; v < dy.size(); ++v) {
    const base::Vec2 p = basin.mesh.position[v];
    if (p.y < kShoulder) continue;
    const double a = std::min(1.0, (std::abs(p.x) - kRadius) / kZones.reach);
    EXPECT_NEAR(dy[v], (1 - a) * (kDepth - p.y) / (kDepth - kShoulder), 1e-15);
  }
}

TEST(ZonesMotion, WithoutAPileIsVertical) {
  const Basin basin = without_pile(even(0, 1, 4));
  const std::vector<double> surface = waves(basin, 8);
  EXPECT_EQ(MeshMotion(basin.mesh, basin.boundary, kZones).displacements(surface, 0),
            MeshMotion(basin.mesh, basin.boundary, Vertical{}).displacements(surface, 0));
}

// The exact solution is linear over the height, and linear elements hold it.
TEST(EllipticMotion, UnderALevelSurfaceIsLinearOverTheHeight) {
  const Basin basin = without_pile(std::vector<double>{0, 0.1, 0.35, 0.6, 1});
  const std::vector<double> dy = MeshMotion(basin.mesh, basin.boundary, Elliptic{})
                                     .displacements(std::vector<double>(basin.boundary.surface.size(), 0.3), 0);
  for (std::size_t v = 0; v < dy.size(); ++v) EXPECT_NEAR(dy[v], 0.3 * basin.mesh.position[v].y, 1e-15);
}

// One dimension: k dy' is the same in every row, and k = area^-p; so dy' = area^p up to a factor.
TEST(EllipticMotion, StiffensSmallTriangles) {
  const std::vector<double> rows = {0, 0.1, 0.35, 0.6, 1};
  const Basin basin = without_pile(rows);
  for (const double stiffening : {0.5, 1.0, 2.0}) {
    const std::vector<double> dy = MeshMotion(basin.mesh, basin.boundary, Elliptic{stiffening})
                                       .displacements(std::vector<double>(basin.boundary.surface.size(), 0.3), 0);
    std::vector<double> exact{0};
    for (std::size_t r = 1; r < rows.size(); ++r)
      exact.push_back(exact.back() + std::pow(rows[r] - rows[r - 1], 1 + stiffening));
    for (std::size_t v = 0; v < dy.size(); ++v) {
      const auto row = std::ranges::find(rows, basin.mesh.position[v].y) - rows.begin();
      EXPECT_NEAR(dy[v], 0.3 * exact[row] / exact.back(), 1e-15);
    }
  }
}

// dy = sin(pi x/2) sinh(pi y/2)/sinh(pi/2) between walls at x = -1 and 1 along which dy is free.
TEST(EllipticMotion, ConvergesToTheHarmonicFunction) {
  double error[2] = {};
  for (const int level : {0, 1}) {
    const int cells = 16 << level;
    Basin basin{rectangle(even(-1, 1, 2 * cells), even(0, 1, cells)), {}};
    basin.boundary = {by_rising_x(basin.mesh, {kTop}), {}, 0};
    std::vector<double> surface;
    const auto exact = [](base::Vec2 p) {
      constexpr double k = std::numbers::pi / 2;
      return std::sin(k * p.x) * std::sinh(k * p.y) / std::sinh(k);
    };
    for (const std::int32_t vertex : basin.boundary.surface) surface.push_back(exact(basin.mesh.position[vertex]));
    const std::vector<double> dy = MeshMotion(basin.mesh, basin.boundary, Elliptic{}).displacements(surface, 0);
    for (std::size_t v = 0; v < dy.size(); ++v)
      error[level] = std::max(error[level], std::abs(dy[v] - exact(basin.mesh.position[v])));
  }
  std::printf("largest error %.2e, at half the size %.2e\n", error[0], error[1]);
  EXPECT_LT(error[1], 2e-4);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.2);
}

TEST(EllipticMotion, StaysBetweenTheDisplacementsOfTheBoundary) {
  const Basin basin = with_pile();
  const std::vector<double> still(basin.boundary.surface.size(), 0);
  for (const double dy : MeshMotion(basin.mesh, basin.boundary, Elliptic{}).displacements(still, 1)) {
    EXPECT_GE(dy, 0);
    EXPECT_LE(dy, 1);
  }
}

TEST(Motion, OfABoundaryThatIsNoneIsRefused) {
  const Basin basin = with_pile();
  const auto refused = [&](auto change) {
    MovingBoundary boundary = basin.boundary;
    change(boundary);
    for (const MotionKind& kind : kKinds) EXPECT_THROW(MeshMotion(basin.mesh, boundary, kind), std::logic_error);
  };
  refused([](MovingBoundary& b) { std::ranges::reverse(b.surface); });
  refused([](MovingBoundary& b) { std::ranges::reverse(b.tip); });
  refused([](MovingBoundary& b) { b.tip.pop_back(); });  // Does not end where the surface does.
  refused([](MovingBoundary& b) { b.tip.erase(b.tip.begin()); });
  refused([](MovingBoundary& b) { b.surface = {b.surface.front(), b.surface.back()}; });
  EXPECT_THROW(MeshMotion(basin.mesh, basin.boundary, Zones{0}), std::logic_error);
  EXPECT_THROW(MeshMotion(basin.mesh, basin.boundary, Vertical{}).displacements(std::vector<double>(3, 0), 0),
               std::logic_error);
}

}  // namespace
}  // namespace seapile::mesh
