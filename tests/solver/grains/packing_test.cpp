#include "solver/grains/packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/base/random.h"

namespace seapile::grains {
namespace {

using std::numbers::pi;

/// Area of a disc inside a rectangle by the midpoint rule over the disc's chords.
double area_by_quadrature(double r, double x0, double x1, double y0, double y1) {
  constexpr int kStrips = 40'000;
  const double left = std::max(x0, -r), right = std::min(x1, r);
  if (right <= left) return 0;
  double sum = 0;
  for (int k = 0; k < kStrips; ++k) {
    const double x = left + (right - left) * (k + 0.5) / kStrips, chord = std::sqrt(std::max(r * r - x * x, 0.0));
    sum += std::max(0.0, std::min(y1, chord) - std::max(y0, -chord));
  }
  return sum * (right - left) / kStrips;
}

TEST(DiscAreaBelow, GrowsFromNothingToTheWholeDisc) {
  EXPECT_EQ(disc_area_below(0.3, -0.3), 0);
  EXPECT_EQ(disc_area_below(0.3, -5), 0);
  EXPECT_DOUBLE_EQ(disc_area_below(0.3, 0), pi * 0.09 / 2);
  EXPECT_EQ(disc_area_below(0.3, 0.3), pi * 0.3 * 0.3);
  EXPECT_EQ(disc_area_below(0.3, 5), pi * 0.3 * 0.3);
  // Half the height of a cap of 60 degrees: r^2 (pi/3 - sqrt(3)/4) is cut off.
  EXPECT_NEAR(disc_area_below(1, -0.5), pi / 3 - std::sqrt(3.0) / 4, 1e-15);
}

// The midpoint rule's error at the ends of a chord is about r^2 kStrips^-1.5 = 1e-7 r^2.
TEST(DiscAreaInRectangle, IsThatOfQuadrature) {
  for (std::uint64_t k = 0; k < 400; ++k) {
    const double r = base::uniform(0.2, 2, 1, 0, k);
    double x0 = base::uniform(-2.5, 2.5, 1, 1, k), x1 = base::uniform(-2.5, 2.5, 1, 2, k);
    double y0 = base::uniform(-2.5, 2.5, 1, 3, k), y1 = base::uniform(-2.5, 2.5, 1, 4, k);
    if (x0 > x1) std::swap(x0, x1);
    if (y0 > y1) std::swap(y0, y1);
    EXPECT_NEAR(disc_area_in_rectangle(r, x0, x1, y0, y1), area_by_quadrature(r, x0, x1, y0, y1), 3e-7 * r * r)
        << r << " [" << x0 << ", " << x1 << "] x [" << y0 << ", " << y1 << "]";
  }
}

TEST(DiscAreaInRectangle, CornersOnTheDiscAndTangentsAreNoExceptions) {
  EXPECT_NEAR(disc_area_in_rectangle(1, -1, 1, -1, 1), pi, 1e-15);
  EXPECT_NEAR(disc_area_in_rectangle(1, 0, 1, 0, 1), pi / 4, 1e-15);
  EXPECT_NEAR(disc_area_in_rectangle(1, 1, 2, -1, 1), 0, 1e-15);
  const double corner = std::sqrt(0.5);
  EXPECT_NEAR(disc_area_in_rectangle(1, -corner, corner, -corner, corner), 2, 1e-14);
  EXPECT_NEAR(disc_area_in_rectangle(1, corner, 2, corner, 2), 0, 1e-15);
  EXPECT_EQ(disc_area_in_rectangle(1, 0.3, 0.3, -1, 1), 0);
}

// The cells of any partition of the plane add up to the disc: each term is rounded at 1e-16 r^2.
TEST(DiscAreaInRectangle, CellsOfAPartitionAddUpToTheDisc) {
  for (std::uint64_t k = 0; k < 50; ++k) {
    const double r = base::uniform(0.01, 3, 2, 0, k), shift_x = base::uniform(0, 0.4, 2, 1, k);
    const double shift_y = base::uniform(0, 0.4, 2, 2, k);
    double sum = 0;
    for (int iy = -9; iy < 9; ++iy)
      for (int ix = -9; ix < 9; ++ix)
        sum += disc_area_in_rectangle(r, 0.4 * ix + shift_x, 0.4 * (ix + 1) + shift_x, 0.4 * iy + shift_y,
                                      0.4 * (iy + 1) + shift_y);
    EXPECT_NEAR(sum, pi * r * r, 1e-12 * r * r);
  }
}

// pi / sqrt(12) = 0.9069: a strip of whole periods of the hexagonal packing has its solid fraction exactly.
TEST(SolidFraction, OfAHexagonalPackingIsPiOverRoot12) {
  constexpr double r = 0.01;
  constexpr int kColumns = 20, kRows = 30;
  const double rise = std::sqrt(3.0) * r;
  std::vector<Disc> discs;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) discs.push_back({r * (2 * column + row % 2), rise * row, r, 0});
  // Four rows further from the ends than a grain reaches, cut through grains on both sides.
  const double width = 2 * r * kColumns;
  EXPECT_NEAR(solid_fraction(discs, width, 5.3 * rise, 25.3 * rise), pi / std::sqrt(12.0), 1e-13);
}

TEST(SolidFraction, CountsOnlyWhatStandsInTheStrip) {
  const std::vector<Disc> discs = {{0, 0, 1, 0}, {0, 10, 1, 0}};
  EXPECT_NEAR(solid_fraction(discs, 4, 0, 2), pi / 2 / 8, 1e-15);
  EXPECT_NEAR(solid_fraction(discs, 4, 1, 9), 0, 1e-15);
}

TEST(BedSurface, IsTheMeanOverColumnsOfTheHighestTop) {
  // Four columns of 0.1 m; in the last stands nothing.
  const std::vector<Disc> discs = {
      {-0.19, 0.10, 0.01, 0}, {-0.12, 0.30, 0.02, 0}, {-0.02, 0.20, 0.01, 0}, {0.05, 0.40, 0.05, 0}};
  EXPECT_NEAR(bed_surface(discs, -0.2, 0.2), (0.32 + 0.21 + 0.45) / 3, 1e-15);
}

TEST(BedSurface, AGrainCountsWhereItsCentreStandsEvenOutsideTheWalls) {
  const std::vector<Disc> discs = {{-0.001, 0.1, 0.01, 0}, {0.1999, 0.2, 0.01, 0}, {0.2001, 0.3, 0.01, 0}};
  EXPECT_NEAR(bed_surface(discs, 0, 0.2), (0.11 + 0.31) / 2, 1e-15);
}

TEST(BedSurface, OfANarrowBoxIsOneColumn) {
  EXPECT_NEAR(bed_surface(std::vector<Disc>{{0.01, 0.1, 0.01, 0}, {0.03, 0.2, 0.01, 0}}, 0, 0.04), 0.21, 1e-15);
}

}  // namespace
}  // namespace seapile::grains
