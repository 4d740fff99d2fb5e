// The momentum equation without v.grad v: linear in the unknowns, and of one place on a mesh that moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/fluid/residual.h"
#include "tests/solver/fluid/flow_scenes.h"

namespace seapile::fluid {
namespace {

using base::InstructionSet;
using support::random_flow;
using support::RandomFlow;
using support::uneven_mesh;

std::vector<double> residual_at(const RandomFlow& random, const std::vector<double>& unknown) {
  std::vector<double> residual(unknown.size());
  residual_of(random.flow, random.scheme, unknown, residual);
  return residual;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

/// How far R(a) + R(b) is from R(a + b) + R(0), by the largest of them; 0 where the equations are linear.
double bend(Geometry geometry, Convection convection) {
  const RandomFlow random = random_flow(uneven_mesh(5, 4, 1), {1.2, 0.01, geometry, convection}, 1);
  std::vector<double> a = random.flow.unknown, b = a, both = a;
  std::ranges::reverse(b);
  for (std::size_t i = 0; i < a.size(); ++i) both[i] = a[i] + b[i];
  const std::vector<double> of_a = residual_at(random, a), of_b = residual_at(random, b),
                            of_both = residual_at(random, both),
                            of_none = residual_at(random, std::vector<double>(a.size(), 0));
  std::vector<double> off(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) off[i] = of_a[i] + of_b[i] - of_both[i] - of_none[i];
  return largest(off) / std::max({largest(of_a), largest(of_b), largest(of_both)});
}

TEST(Convection, WithoutItTheEquationsAreLinear) {
  for (const Geometry geometry : {Geometry::planar, Geometry::axisymmetric}) {
    EXPECT_LT(bend(geometry, Convection::omitted), 1e-13);
    EXPECT_GT(bend(geometry, Convection::included), 0.01);
  }
}

// Its terms are not computed: the kernels and their slow twin are one formula without them too.
TEST(Convection, WithoutItAllInstructionSetsGiveTheSameBits) {
  for (const Geometry geometry : {Geometry::planar, Geometry::axisymmetric}) {
    const RandomFlow random = random_flow(uneven_mesh(5, 5, 4), {1.2, 0.01, geometry, Convection::omitted}, 4);
    const std::vector<double> twin = residual_at(random, random.flow.unknown);
    PackedFlow packed;
    pack(packed, random.flow, random.scheme);
    for (const InstructionSet set : {InstructionSet::generic, InstructionSet::avx2, InstructionSet::avx512}) {
      if (!base::available(set)) continue;
      std::vector<double> residual(twin.size());
      residual_of(random.flow, packed, random.flow.unknown, residual, set);
      for (std::size_t i = 0; i < twin.size(); ++i) ASSERT_EQ(residual[i], twin[i]) << i;
    }
  }
}

// v = (y, 0) for all time, on a mesh that rises: at a vertex v grows by w_y dv/dy, which is no acceleration.
TEST(Convection, WhatTheMeshMovesByIsNotLeftOutWithIt) {
  Flow flow = at_rest(uneven_mesh(5, 4, 2), {1000, 0.5, Geometry::planar, Convection::omitted});
  const auto outer = support::on_boundary(flow.mesh);
  constexpr double kRate = 50, kRise = 0.3;
  TimeScheme scheme;
  scheme.rate = scheme.unsteadiness = kRate;
  double size = 0;
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v) {
    const double y = flow.mesh.position[v].y;
    flow.unknown[3 * v] = y;
    flow.mesh_velocity[v] = {0, kRise};
    scheme.history.push_back({-kRate * (y - kRise / kRate), 0});
    size = std::max(size, 1000 * kRate * y);
  }
  std::vector<double> residual(flow.unknown.size());
  residual_of(flow, scheme, flow.unknown, residual);
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v)
    for (int c = 0; c < 3; ++c)
      if (!outer[v]) {
        EXPECT_LT(std::abs(residual[3 * v + c]), 1e-14 * size) << v << ", " << c;
      }
}

}  // namespace
}  // namespace seapile::fluid
