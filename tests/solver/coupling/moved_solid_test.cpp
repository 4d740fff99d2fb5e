// Grains a little off the places that they were deposited at.
#include "solver/coupling/moved_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/coupling/porosity.h"
#include "tests/solver/coupling/meshes.h"

namespace seapile::coupling {
namespace {

using base::uniform;
using base::Vec2;
using grains::Disc;
using mesh::TriangleMesh;

constexpr double kRadius = 0.015;

std::vector<Disc> scattered(int count, double from, double to) {
  std::vector<Disc> discs;
  for (int i = 0; i < count; ++i)
    discs.push_back(
        {uniform(from, to, 1, 0, i), uniform(from, to, 1, 1, i), uniform(0.7 * kRadius, kRadius, 1, 2, i), 0});
  return discs;
}

/// Each disc its own way, of up to `most` in x and y.
std::vector<Disc> moved(std::vector<Disc> discs, double most) {
  for (std::size_t i = 0; i < discs.size(); ++i) {
    discs[i].x += uniform(-most, most, 2, 0, i);
    discs[i].y += uniform(-most, most, 2, 1, i);
  }
  return discs;
}

Deposit deposited(const TriangleMesh& mesh, const std::vector<Disc>& discs, Kernel kernel = Kernel::disc) {
  Location location(mesh);
  return deposit(mesh, location, discs, kernel);
}

std::vector<double> moved_solid(const TriangleMesh& mesh, const Deposit& on, const std::vector<Disc>& from,
                                const std::vector<Disc>& to) {
  return coupling::moved_solid(mesh, vertex_volume(mesh), on, solid_volume(on, mesh.vertices()), from, to);
}

struct Moments {
  double area = 0;
  Vec2 first;
};
Moments moments(const TriangleMesh& mesh, const std::vector<double>& solid) {
  Moments m;
  for (std::size_t v = 0; v < solid.size(); ++v) {
    m.area += solid[v];
    m.first = m.first + solid[v] * mesh.position[v];
  }
  return m;
}

double largest(Vec2 a) { return std::max(std::abs(a.x), std::abs(a.y)); }

TEST(MovedSolid, WithoutAWayItIsTheDepositBitForBit) {
  const TriangleMesh mesh = shaken(1, 1);
  const auto discs = scattered(500, -0.05, 1.05);
  for (const Kernel kernel : {Kernel::disc, Kernel::hat}) {
    const Deposit on = deposited(mesh, discs, kernel);
    EXPECT_EQ(moved_solid(mesh, on, discs, discs), solid_volume(on, mesh.vertices()));
  }
}

TEST(MovedSolid, TheAreaIsKeptAndTheCentreMoves) {
  const TriangleMesh mesh = shaken(1, 1);
  const auto discs = scattered(500, -0.05, 1.05), there = moved(discs, 1e-3);
  const Deposit on = deposited(mesh, discs);
  const Moments before = moments(mesh, solid_volume(on, mesh.vertices())),
                after = moments(mesh, moved_solid(mesh, on, discs, there));
  Vec2 way;
  int in = 0;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    way = way + on.immersed[i] * Vec2{there[i].x - discs[i].x, there[i].y - discs[i].y};
    in += on.immersed[i] > 0;
  }
  ASSERT_GT(in, 400);
  EXPECT_NEAR(after.area, before.area, 1e-14 * before.area);
  EXPECT_LT(largest(after.first - before.first - way), 1e-13 * before.area);
}

// By the equation of continuity, vertex by vertex: int grad N_j . q, q linear with its values at the vertices.
TEST(MovedSolid, WhatIsCarriedOverTheHatsSlopesIsMoved) {
  const TriangleMesh mesh = shaken(1, 1);
  const auto discs = scattered(500, -0.05, 1.05), there = moved(discs, 1e-3);
  const Deposit on = deposited(mesh, discs);
  const std::vector<double> volume = vertex_volume(mesh), solid = solid_volume(on, mesh.vertices()),
                            found = moved_solid(mesh, on, discs, there);
  std::vector<Vec2> q(mesh.vertices());
  for (std::size_t i = 0; i < discs.size(); ++i)
    for (std::int32_t k = on.first[i]; k < on.first[i + 1]; ++k)
      q[on.vertex[k]] = q[on.vertex[k]] +
                        on.volume[k] / volume[on.vertex[k]] * Vec2{there[i].x - discs[i].x, there[i].y - discs[i].y};
  double most = 0;
  for (std::size_t j = 0; j < mesh.vertices(); ++j) {
    double moved = 0;
    for (const auto& t : mesh.triangle)
      for (int c = 0; c < 3; ++c) {
        if (t[c] != static_cast<std::int32_t>(j)) continue;
        const Vec2 opposite = mesh.position[t[(c + 2) % 3]] - mesh.position[t[(c + 1) % 3]];
        for (const std::int32_t v : t) moved += dot(0.5 * base::perpendicular(opposite), q[v]) / 3;
      }
    EXPECT_NEAR(found[j] - solid[j], moved, 1e-16) << j;
    most = std::max(most, std::abs(moved));
  }
  EXPECT_GT(most, 1e-6);
}

}  // namespace
}  // namespace seapile::coupling
