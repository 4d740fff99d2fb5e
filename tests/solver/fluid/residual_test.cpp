// The kernels of all instruction sets and their slow twin compute one residual, bit for bit.
#include "solver/fluid/residual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/solver/fluid/flow_scenes.h"

namespace seapile::fluid {
namespace {

using base::InstructionSet;
using support::random_flow;
using support::RandomFlow;
using support::uneven_mesh;

constexpr InstructionSet kSets[] = {InstructionSet::generic, InstructionSet::avx2, InstructionSet::avx512};

std::vector<double> by_kernel(const RandomFlow& random, InstructionSet set) {
  PackedFlow packed;
  pack(packed, random.flow, random.scheme);
  std::vector<double> residual(random.flow.unknown.size(), std::nan(""));
  residual_of(random.flow, packed, random.flow.unknown, residual, set);
  return residual;
}
std::vector<double> by_twin(const RandomFlow& random) {
  std::vector<double> residual(random.flow.unknown.size(), std::nan(""));
  residual_of(random.flow, random.scheme, random.flow.unknown, residual);
  return residual;
}

/// The first `triangles` of a mesh as a mesh of its own.
mesh::TriangleMesh first_of(const mesh::TriangleMesh& whole, std::size_t triangles) {
  mesh::TriangleMesh part;
  part.triangle.assign(whole.triangle.begin(), whole.triangle.begin() + static_cast<std::ptrdiff_t>(triangles));
  std::vector<std::int32_t> index(whole.vertices(), -1);
  for (auto& t : part.triangle)
    for (std::int32_t& v : t) {
      if (index[v] < 0) {
        index[v] = static_cast<std::int32_t>(part.vertices());
        part.position.push_back(whole.position[v]);
      }
      v = index[v];
    }
  part.boundary = mesh::boundary_of(part.triangle, part.position, [](base::Vec2 a, base::Vec2 b) {
    return a.x + b.x > 1 ? mesh::kRight : mesh::kTop;
  });
  mesh::check(part);
  return part;
}

// Kernels and twin are compiled from one formula without contraction, and triangles are added in one order.
void expect_one_residual(const RandomFlow& random, const std::string& what) {
  const std::vector<double> twin = by_twin(random);
  for (const double r : twin) ASSERT_TRUE(std::isfinite(r)) << what;
  for (const InstructionSet set : kSets) {
    if (!available(set)) continue;
    const std::vector<double> kernel = by_kernel(random, set);
    for (std::size_t i = 0; i < twin.size(); ++i)
      ASSERT_EQ(kernel[i], twin[i]) << what << ", set " << static_cast<int>(set) << ", unknown " << i;
  }
}

TEST(Residual, EveryInstructionSetHasTheBitsOfTheSlowTwin) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const Geometry geometry : {Geometry::planar, Geometry::axisymmetric})
      for (const double density : {0.0, 1.3})
        expect_one_residual(random_flow(uneven_mesh(7, 5, seed), {density, 0.2, geometry}, seed),
                            "seed " + std::to_string(seed));
}

TEST(Residual, TrianglesBesideAFullVectorCountOnce) {
  const mesh::TriangleMesh whole = uneven_mesh(5, 4, 3);
  for (const std::size_t triangles : {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 23, 39})
    for (const Geometry geometry : {Geometry::planar, Geometry::axisymmetric})
      expect_one_residual(random_flow(first_of(whole, triangles), {1, 0.1, geometry}, triangles),
                          std::to_string(triangles) + " triangles");
}

// No viscosity: a limit of the least-squares term divides by it.
TEST(Residual, IsFiniteWithoutViscosity) {
  RandomFlow random = random_flow(uneven_mesh(4, 3, 1), {1, 0, Geometry::planar}, 1);
  expect_one_residual(random, "moving");
  for (auto& u : random.flow.unknown) u = 0;
  for (auto& w : random.flow.mesh_velocity) w = {};
  expect_one_residual(random, "at rest");
}

TEST(Residual, OfWhatIsHeldIsZero) {
  const RandomFlow random = random_flow(uneven_mesh(7, 5, 4), {1, 0.1, Geometry::planar}, 4);
  const std::vector<double> residual = by_kernel(random, InstructionSet::generic);
  int held = 0;
  for (std::size_t i = 0; i < residual.size(); ++i) {
    EXPECT_EQ(residual[i] == 0, random.flow.held[i] == 1);
    held += random.flow.held[i];
  }
  EXPECT_GT(held, 10);
}

// Nothing but the unknowns changes between two calls, so the second is the first.
TEST(Residual, DoesNotDependOnWhatWasComputedBefore) {
  const RandomFlow random = random_flow(uneven_mesh(6, 3, 5), {1, 0.1, Geometry::axisymmetric}, 5);
  PackedFlow packed;
  pack(packed, random_flow(uneven_mesh(9, 9, 6), {1, 0.1, Geometry::planar}, 6).flow, {});
  pack(packed, random.flow, random.scheme);
  std::vector<double> residual(random.flow.unknown.size(), 17);
  for (int call = 0; call < 2; ++call) {
    residual_of(random.flow, packed, random.flow.unknown, residual, base::fastest());
    EXPECT_EQ(residual, by_twin(random));
  }
}

}  // namespace
}  // namespace seapile::fluid
