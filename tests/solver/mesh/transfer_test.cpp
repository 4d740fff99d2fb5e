// Values carried over from one mesh to another.
#include "solver/mesh/transfer.h"

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

/// A basin with a pile's notch, whose faces are neither level nor upright.
TriangleMesh basin(double size) {
  const std::vector<Corner> corners = {{{-1, 0}, 0},       {{1, 0}, 0},        {{1, 1}, 0},
                                       {{0.13, 1.03}, 0},  {{0.13, 0.71}, 0},  {{0, 0.47}, 0},
                                       {{-0.13, 0.71}, 0}, {{-0.13, 1.03}, 0}, {{-1, 1}, 0}};
  return generate(corners, [&](base::Vec2) { return size; });
}

/// The unit square with vertices off their grid by up to a fifth of a cell, in another way for every number.
TriangleMesh square(int cells, std::uint32_t number) {
  TriangleMesh mesh = rectangle(even(0, 1, cells), even(0, 1, cells));
  for (std::size_t v = 0; v < mesh.vertices(); ++v) {
    base::Vec2& p = mesh.position[v];
    const double dx = base::uniform(-0.2, 0.2, number, 0, v) / cells,
                 dy = base::uniform(-0.2, 0.2, number, 1, v) / cells;
    if (p.x > 0 && p.x < 1) p.x += dx;
    if (p.y > 0 && p.y < 1) p.y += dy;
  }
  return mesh;
}

template <class Function>
std::vector<double> values(const TriangleMesh& mesh, Function f) {
  std::vector<double> values;
  for (const base::Vec2 p : mesh.position) values.push_back(f(p));
  return values;
}

std::vector<double> noise(const TriangleMesh& mesh, std::uint32_t number) {
  std::vector<double> values;
  for (std::size_t v = 0; v < mesh.vertices(); ++v) values.push_back(base::uniform(-1, 1, number, 2, v));
  return values;
}

double linear(base::Vec2 p) { return 0.3 + 2 * p.x - 0.7 * p.y; }

TEST(Transfer, KeepsLinearFunctions) {
  const TriangleMesh from = basin(0.11), to = basin(0.07);
  for (const auto& [a, b] : {std::pair(&from, &to), std::pair(&to, &from)}) {
    const Transfer transfer(*a, *b);
    const std::vector<double> before = values(*a, linear), exact = values(*b, linear);
    const std::vector<double> interpolated = transfer.interpolated(before), projected = transfer.projected(before);
    for (std::size_t v = 0; v < exact.size(); ++v) {
      EXPECT_NEAR(interpolated[v], exact[v], 2e-15);
      EXPECT_NEAR(projected[v], exact[v], 1e-13);
    }
    EXPECT_LT(transfer.error(before, projected).difference, 1e-14);
  }
}

TEST(Transfer, TheProjectionKeepsTheIntegral) {
  for (std::uint32_t number = 0; number < 5; ++number) {
    const TriangleMesh from = basin(0.11 - 0.01 * number), to = basin(0.065 + 0.01 * number);
    const Transfer transfer(from, to);
    const std::vector<double> before = noise(from, number);
    const TransferError error = transfer.error(before, transfer.projected(before));
    EXPECT_NEAR(error.after, error.before, 1e-12 * error.norm);
    EXPECT_GT(error.difference, 0.1 * error.norm);  // It was not for want of a difference.
  }
}

TEST(Transfer, TheInterpolationKeepsTheBounds) {
  const TriangleMesh from = basin(0.11), to = basin(0.05);
  const std::vector<double> before = noise(from, 1), after = Transfer(from, to).interpolated(before);
  EXPECT_GE(std::ranges::min(after), std::ranges::min(before) - 1e-15);
  EXPECT_LE(std::ranges::max(after), std::ranges::max(before) + 1e-15);
}

TEST(Transfer, TheInterpolationIsTheValueAtThePlace) {
  const TriangleMesh from = square(7, 1), to = square(11, 2);
  const std::vector<double> before = noise(from, 1), after = Transfer(from, to).interpolated(before);
  for (std::size_t v = 0; v < to.vertices(); ++v) {
    const base::Vec2 p = to.position[v];
    double value = std::nan("");
    for (const auto& t : from.triangle) {
      const base::Vec2 a = from.position[t[0]], b = from.position[t[1]], c = from.position[t[2]];
      const double all = doubled_area(a, b, c), at_a = doubled_area(p, b, c) / all, at_b = doubled_area(a, p, c) / all;
      if (at_a > -1e-12 && at_b > -1e-12 && at_a + at_b < 1 + 1e-12)
        value = at_a * before[t[0]] + at_b * before[t[1]] + (1 - at_a - at_b) * before[t[2]];
    }
    EXPECT_NEAR(after[v], value, 1e-11);
  }
}

// What is left is orthogonal to every function on the new mesh: Pythagoras, and no neighbour is nearer.
TEST(Transfer, TheProjectionIsTheNearest) {
  const TriangleMesh from = square(7, 3), to = square(9, 4);
  const Transfer transfer(from, to);
  const std::vector<double> before = noise(from, 1), after = transfer.projected(before);
  const TransferError error = transfer.error(before, after);
  const double norm_after = Transfer(to, from).error(after, before).norm;
  EXPECT_NEAR(std::pow(error.norm, 2), std::pow(norm_after, 2) + std::pow(error.difference, 2), 1e-14);
  for (std::uint32_t number = 0; number < 5; ++number) {
    std::vector<double> beside = noise(to, 10 + number);
    for (std::size_t v = 0; v < after.size(); ++v) beside[v] = after[v] + 1e-3 * beside[v];
    EXPECT_GT(transfer.error(before, beside).difference, error.difference);
  }
}

// f = x on two triangles against nothing: integral 1/2, norm 1/sqrt(3).
TEST(Transfer, SaysWhatItDid) {
  const TriangleMesh from = rectangle(even(0, 1, 1), even(0, 1, 1)), to = square(3, 5);
  const Transfer transfer(from, to);
  const std::vector<double> before = values(from, [](base::Vec2 p) { return p.x; });
  const TransferError error = transfer.error(before, std::vector<double>(to.vertices(), 0.25));
  EXPECT_NEAR(error.before, 0.5, 1e-15);
  EXPECT_NEAR(error.after, 0.25, 1e-15);
  EXPECT_NEAR(error.norm, 1 / std::numbers::sqrt3, 1e-15);
  EXPECT_NEAR(error.difference, std::sqrt(1.0 / 3 - 0.25 + 0.0625), 1e-15);
}

TEST(Transfer, BothAreOfSecondOrder) {
  const auto smooth = [](base::Vec2 p) { return std::sin(3 * p.x + 1) * std::exp(p.y); };
  double interpolation[3] = {}, projection[3] = {};
  for (const int level : {0, 1, 2}) {
    const TriangleMesh from = square(10 << level, 6), to = square(13 << level, 7);
    const Transfer transfer(from, to);
    const std::vector<double> before = values(from, smooth), exact = values(to, smooth);
    const auto off = [&](std::vector<double> after) {
      for (std::size_t v = 0; v < after.size(); ++v) after[v] -= exact[v];
      return Transfer(to, from).error(after, before).norm;
    };
    interpolation[level] = off(transfer.interpolated(before));
    projection[level] = off(transfer.projected(before));
  }
  for (const auto* error : {interpolation, projection}) {
    std::printf("off by %.2e, %.2e, %.2e\n", error[0], error[1], error[2]);
    EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.15);
    EXPECT_NEAR(std::log2(error[1] / error[2]), 2, 0.15);
  }
}

TEST(Transfer, ToTheSameMeshChangesNothing) {
  const TriangleMesh mesh = basin(0.07);
  const Transfer transfer(mesh, mesh);
  const std::vector<double> before = noise(mesh, 1), projected = transfer.projected(before);
  EXPECT_EQ(transfer.interpolated(before), before);
  for (std::size_t v = 0; v < before.size(); ++v) EXPECT_NEAR(projected[v], before[v], 1e-14);
  EXPECT_LT(transfer.error(before, projected).difference, 1e-14);
  EXPECT_EQ(transfer.error(before, before).difference, 0);
}

TEST(Transfer, OfTheWaterUnderASlopeReachesEveryVertex) {
  // Vertices along the slopes lie to either side of the old edges by a rounding.
  const TriangleMesh from = basin(0.11), to = basin(0.023);
  for (const double value : Transfer(from, to).interpolated(values(from, linear))) EXPECT_TRUE(std::isfinite(value));
  const std::vector<double> one = Transfer(from, to).interpolated(std::vector<double>(from.vertices(), 1));
  for (const double value : one) EXPECT_NEAR(value, 1, 1e-15);
}

TEST(Transfer, GivesTheSameBitsAgain) {
  const TriangleMesh from = basin(0.11), to = basin(0.07);
  const std::vector<double> before = noise(from, 1);
  const auto first = Transfer(from, to).projected(before), second = Transfer(from, to).projected(before);
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(double)), 0);
}

TEST(Transfer, RefusesAnotherAreaAndValuesOfAnotherMesh) {
  const TriangleMesh from = square(5, 8), to = square(6, 9);
  TriangleMesh larger = to;
  for (base::Vec2& p : larger.position) p = (1 + 1e-6) * p;
  EXPECT_THROW(Transfer(from, larger), std::logic_error);
  EXPECT_THROW(Transfer(from, {}), std::logic_error);
  EXPECT_THROW(Transfer({}, {}), std::logic_error);
  larger.position[9].y = std::nan("");
  EXPECT_THROW(Transfer(from, larger), std::logic_error);
  const Transfer transfer(from, to);
  const std::vector<double> old_values(from.vertices(), 1), new_values(to.vertices(), 1);
  EXPECT_THROW(transfer.interpolated(new_values), std::logic_error);
  EXPECT_THROW(transfer.projected(new_values), std::logic_error);
  EXPECT_THROW(transfer.error(new_values, new_values), std::logic_error);
  EXPECT_THROW(transfer.error(old_values, old_values), std::logic_error);
}

}  // namespace
}  // namespace seapile::mesh
