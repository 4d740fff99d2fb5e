#include "solver/grains/fields_on_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/base/random.h"
#include "solver/grains/packing.h"

namespace seapile::grains {
namespace {

using std::numbers::pi;

/// A square lattice of equal discs at rest between two walls: each contact carries the discs above it, each wall and
/// each horizontal contact `lateral` times the pressure there.
struct Column {
  static constexpr double kRadius = 0.01, kDensity = 1500, kGravity = 9.81;
  static constexpr int kAcross = 30, kUp = 100;
  static constexpr double kWidth = 2 * kRadius * kAcross, kHeight = 2 * kRadius * kUp;
  Box box{0, kWidth, 0};
  std::vector<Disc> discs;
  std::vector<ContactForce> contacts;

  explicit Column(double lateral) {
    const double weight = kDensity * pi * kRadius * kRadius * kGravity;
    for (int row = 0; row < kUp; ++row)
      for (int column = 0; column < kAcross; ++column) {
        const double x = kRadius * (2 * column + 1), y = kRadius * (2 * row + 1);
        const auto me = static_cast<std::int32_t>(discs.size());
        discs.push_back({x, y, kRadius, 0});
        const double below = weight * (kUp - row), across = lateral * weight * (kUp - row - 0.5);
        contacts.push_back({me, row == 0 ? -3 : me - kAcross, x, y - kRadius, 0, -1, below, 0});
        contacts.push_back({me, column == 0 ? -1 : me - 1, x - kRadius, y, -1, 0, across, 0});
        if (column == kAcross - 1) contacts.push_back({me, -2, x + kRadius, y, 1, 0, across, 0});
      }
  }
  /// Vertical pressure at a height [Pa].
  static double pressure(double y) { return pi / 4 * kDensity * kGravity * (kHeight - y); }
};

// Stress of a column is the weight above per width. Averaging over a disc of 0.08 m, 50 contacts across, leaves the
// lattice's own graininess: 2r / 0.08 m of the force times the share on the rim, below 2 %.
TEST(StressOnGrid, OfAColumnGrowsLinearlyWithDepth) {
  const Column column(0.4);
  const Grid grid{0, 0, 0.05, 12, 40};
  const std::vector<Stress> stress = stress_on_grid(column.contacts, column.discs, column.box, grid);
  for (int iy = 2; iy < 36; ++iy)
    for (int ix = 2; ix < 10; ++ix) {
      const Stress& s = stress[static_cast<std::size_t>(iy) * 12 + ix];
      const double expected = Column::pressure((iy + 0.5) * grid.spacing), total = Column::pressure(0);
      EXPECT_NEAR(s.yy, expected, 0.05 * total) << "height " << iy;
      EXPECT_NEAR(s.xx, 0.4 * expected, 0.05 * 0.4 * total) << "height " << iy;
      EXPECT_NEAR(s.xy, 0, 1e-9 * total);
    }
}

// Slope over depth from means over many cells whose centres meet the lattice in every phase: the density of the solid
// times gravity, within what the mean of some 200 cells leaves of the graininess.
TEST(StressOnGrid, OfAColumnHasTheSlopeOfItsDensity) {
  const Column column(0.4);
  const Grid grid{0, 0, 0.0137, 43, 145};
  const std::vector<Stress> stress = stress_on_grid(column.contacts, column.discs, column.box, grid);
  double lower = 0, upper = 0;
  for (int ix = 7; ix < 37; ++ix)
    for (int iy = 0; iy < 15; ++iy) {
      lower += stress[static_cast<std::size_t>(iy + 15) * 43 + ix].yy / 450;
      upper += stress[static_cast<std::size_t>(iy + 115) * 43 + ix].yy / 450;
    }
  const double expected = pi / 4 * Column::kDensity * Column::kGravity;
  EXPECT_NEAR((lower - upper) / (100 * grid.spacing), expected, 0.01 * expected);
}

// At the base the averaging disc is cut in half and the area with it: weight over width within 5 %, of which 1.7 % are
// the height of the half disc's middle in a column of 2 m.
TEST(StressOnGrid, AtTheBaseIsTheWeightOverTheWidth) {
  const Column column(0.4);
  const Grid grid{0, 0, 0.01, 60, 2};
  const std::vector<Stress> stress = stress_on_grid(column.contacts, column.discs, column.box, grid);
  double mean = 0;
  for (int ix = 10; ix < 50; ++ix) mean += stress[ix].yy / 40;
  EXPECT_NEAR(mean, Column::pressure(0), 0.05 * Column::pressure(0));
}

TEST(StressOnGrid, AtAWallIsThatOfTheColumn) {
  const Column column(0.4);
  const Grid grid{0, 0, 0.01, 2, 200};
  const std::vector<Stress> stress = stress_on_grid(column.contacts, column.discs, column.box, grid);
  double mean = 0, expected = 0;
  for (int iy = 50; iy < 150; ++iy) {
    mean += stress[static_cast<std::size_t>(iy) * 2].xx / 100;
    expected += 0.4 * Column::pressure((iy + 0.5) * 0.01) / 100;
  }
  EXPECT_NEAR(mean, expected, 0.05 * expected);
}

// sum of f (x) l over the area, written out for one contact: f = 3 n + 2 t on the second body, l between the centres.
TEST(StressOnGrid, OfOneContactIsItsForceTimesItsBranchOverTheArea) {
  const std::vector<Disc> discs = {{0, 1, 0.02, 0}, {0.03, 1.04, 0.03, 0}};
  const double nx = 0.6, ny = 0.8;
  const std::vector<ContactForce> contact = {{0, 1, 0.012, 1.016, nx, ny, 3, 2}};
  const Grid grid{-0.05, 0.95, 0.1, 1, 1};
  const Stress s = stress_on_grid(contact, discs, {-1, 1, 0}, grid).front();
  const double fx = 3 * nx - 2 * ny, fy = 3 * ny + 2 * nx, area = pi * kStressRadius * kStressRadius;
  EXPECT_NEAR(s.xx, fx * 0.03 / area, 1e-10);
  EXPECT_NEAR(s.yy, fy * 0.04 / area, 1e-10);
  EXPECT_NEAR(s.xy, 0.5 * (fx * 0.04 + fy * 0.03) / area, 1e-10);
}

TEST(StressOnGrid, AContactCountsWithinTheRadiusOfACellsCentreAndNotBeyond) {
  const std::vector<Disc> discs = {{0, 1, 0.02, 0}, {0, 1.04, 0.02, 0}};
  const std::vector<ContactForce> contact = {{0, 1, 0, 1.02, 0, 1, 1, 0}};
  const Grid grid{-0.5, 0.5, 0.02, 50, 50};
  const std::vector<Stress> stress = stress_on_grid(contact, discs, {-1, 1, 0}, grid);
  for (int iy = 0; iy < 50; ++iy)
    for (int ix = 0; ix < 50; ++ix) {
      const double x = -0.5 + 0.02 * (ix + 0.5), y = 0.5 + 0.02 * (iy + 0.5);
      const bool within = std::hypot(x, y - 1.02) < kStressRadius;
      EXPECT_EQ(stress[static_cast<std::size_t>(iy) * 50 + ix].yy > 0, within) << x << ", " << y;
    }
}

TEST(StressOnGrid, TheSumOverAGridIsTheSumOverTheContacts) {
  // Integral over the plane of (1/A) f (x) l = f (x) l, for a grid that is fine against the averaging disc.
  const std::vector<Disc> discs = {{0, 1, 0.02, 0}, {0.013, 1.037, 0.02, 0}};
  const std::vector<ContactForce> contact = {{0, 1, 0.007, 1.018, 0.33, 0.94, 5, -1}};
  const Grid grid{-0.2, 0.8, 0.002, 200, 200};
  double sum = 0;
  for (const Stress& s : stress_on_grid(contact, discs, {-1, 1, 0}, grid)) sum += s.yy * 0.002 * 0.002;
  EXPECT_NEAR(sum, (5 * 0.94 - 0.33) * 0.037, 0.002 * 5 * 0.037);
}

TEST(PorosityOnGrid, SumsToTheAreaOfTheGrains) {
  std::vector<Disc> discs;
  double area = 0;
  for (std::uint64_t k = 0; k < 200; ++k) {
    discs.push_back(
        {base::uniform(0.1, 0.9, 1, 0, k), base::uniform(0.1, 1.9, 1, 1, k), base::uniform(0.01, 0.09, 1, 2, k), 0});
    area += pi * discs.back().radius * discs.back().radius;
  }
  for (const double spacing : {0.05, 0.0625, 0.25, 1.0}) {
    const Grid grid{0, 0, spacing, static_cast<int>(1 / spacing + 0.5), static_cast<int>(2 / spacing + 0.5)};
    double solid = 0;
    for (const double porosity : porosity_on_grid(discs, grid)) solid += (1 - porosity) * spacing * spacing;
    EXPECT_NEAR(solid, area, 1e-12 * area) << "spacing " << spacing;
  }
}

TEST(PorosityOnGrid, OfAnEmptyCellIsOneAndOfAFullOneZero) {
  const std::vector<Disc> discs = {{0.55, 0.55, 0.2, 0}};
  const std::vector<double> porosity = porosity_on_grid(discs, {0, 0, 0.1, 10, 10});
  EXPECT_EQ(porosity[0], 1);
  EXPECT_EQ(porosity[99], 1);
  EXPECT_NEAR(porosity[55], 0, 1e-13);
}

TEST(PorosityOnGrid, GrainsOutsideTheGridDoNotCount) {
  const std::vector<Disc> discs = {{-0.2, 0.5, 0.05, 0}, {0.5, 5, 0.05, 0}, {0.5, -0.01, 0.02, 0}};
  double solid = 0;
  for (const double porosity : porosity_on_grid(discs, {0, 0, 0.1, 10, 10})) solid += (1 - porosity) * 0.01;
  EXPECT_NEAR(solid, disc_area_below(0.02, -0.01), 1e-15);
}

// A stress with principal values a >= b, the major one along an angle, turned into components and back.
TEST(Principal, ValuesAndDirectionAreRecovered) {
  for (std::uint64_t k = 0; k < 200; ++k) {
    const double b = base::uniform(-5, 5, 2, 0, k), a = b + base::uniform(0.1, 10, 2, 1, k);
    const double angle = base::uniform(-pi / 2 + 1e-6, pi / 2, 2, 2, k), c = std::cos(angle), s = std::sin(angle);
    const PrincipalStress p = principal({a * c * c + b * s * s, a * s * s + b * c * c, (a - b) * s * c});
    EXPECT_NEAR(p.major, a, 1e-13 * 20);
    EXPECT_NEAR(p.minor, b, 1e-13 * 20);
    EXPECT_NEAR(p.direction, angle, 1e-13 * 20 / (a - b));
  }
}

TEST(Principal, AnIsotropicStressHasNoDirection) {
  const PrincipalStress p = principal({3, 3, 0});
  EXPECT_EQ(p.major, 3);
  EXPECT_EQ(p.minor, 3);
  EXPECT_EQ(p.direction, 0);
}

// The direction lies in (-pi/2, pi/2]: a vertical major stress has +pi/2, whatever the sign of a zero shear.
TEST(Principal, AVerticalMajorStressPointsUp) {
  EXPECT_DOUBLE_EQ(principal({1, 3, 0.0}).direction, pi / 2);
  EXPECT_DOUBLE_EQ(principal({1, 3, -0.0}).direction, pi / 2);
}

}  // namespace
}  // namespace seapile::grains
