// The derivatives of the residuals against finite differences.
//
// tau and tau_L are not differentiated: the Jacobian is that of the residual with both held where they are. Without
// density they do not depend on the unknowns, and the whole residual is differenced. With density, triangles are
// differenced with a number that carries two values: the one that is moved, and the one before, which is what the
// stabilisation sees. In the unknowns such a residual is a polynomial of degree 3 (the advection of the advection, in
// the streamline-upwind term), of which the differences used here are exact, but for roundings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/fluid/boundary_terms.h"
#include "solver/fluid/kept_factor.h"
#include "solver/fluid/residual.h"
#include "tests/solver/fluid/flow_scenes.h"

namespace seapile::fluid {
namespace {

using support::random_flow;
using support::RandomFlow;
using support::uneven_mesh;

/// A number that is moved; plain() of it is the one before.
struct Moved {
  double now = 0, before = 0;
  Moved() = default;
  Moved(double both) : now(both), before(both) {}
  Moved(double moved, double kept) : now(moved), before(kept) {}
  double value() const { return before; }
  Moved& operator+=(Moved a) { return *this = *this + a; }
  friend Moved operator+(Moved a, Moved b) { return {a.now + b.now, a.before + b.before}; }
  friend Moved operator-(Moved a, Moved b) { return {a.now - b.now, a.before - b.before}; }
  friend Moved operator*(Moved a, Moved b) { return {a.now * b.now, a.before * b.before}; }
  friend Moved operator/(Moved a, Moved b) { return {a.now / b.now, a.before / b.before}; }
};

/// df/ds of a polynomial of degree 4 at most, exactly.
template <class F>
double slope(F&& f, double step) {
  return (8 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step);
}

/// The Jacobian by differences of triangles with the stabilisation held, and of slip.
Eigen::MatrixXd differenced(const RandomFlow& random) {
  const Flow& flow = random.flow;
  const auto size = static_cast<Eigen::Index>(flow.unknown.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t t = 0; t < flow.mesh.triangles(); ++t) {
    const auto& vertex = flow.mesh.triangle[t];
    std::array<Moved, 3> x, y;
    std::array<Moved, kUnknowns> u;
    for (int i = 0; i < 3; ++i) {
      x[i] = flow.mesh.position[vertex[i]].x;
      y[i] = flow.mesh.position[vertex[i]].y;
      for (int c = 0; c < 3; ++c) u[3 * i + c] = flow.unknown[3 * vertex[i] + c];
    }
    const ElementInput<double> in = input_of(flow, random.scheme, t);
    for (int row = 0; row < kUnknowns; ++row)
      for (int column = 0; column < kUnknowns; ++column) {
        const auto moved = [&](double by) {
          auto v = u;
          v[column].now += by;
          return element_residual<double, Moved>(flow.fluid, in, x, y, v)[row].now;
        };
        matrix(3 * vertex[row / 3] + row % 3, 3 * vertex[column / 3] + column % 3) += slope(moved, 0.1);
      }
  }
  for (const SlipEdge& e : flow.slip) {
    const std::int32_t vertex[] = {e.from, e.to};
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) {
        const auto moved = [&](double by) {
          std::array<EdgeEnd<double>, 2> end;
          for (int i = 0; i < 2; ++i)
            end[i] = {flow.mesh.position[vertex[i]].x, flow.mesh.position[vertex[i]].y, flow.u(vertex[i], kVelocityX),
                      flow.u(vertex[i], kVelocityY)};
          (column % 2 == 0 ? end[column / 2].ux : end[column / 2].uy) += by;
          return slip_force(flow.fluid.geometry, end, porosity_at(flow, e.from, e.to), e.friction,
                            e.wall)[row / 2][row % 2];
        };
        matrix(3 * vertex[row / 2] + row % 2, 3 * vertex[column / 2] + column % 2) += slope(moved, 0.1);
      }
  }
  return matrix;
}

/// Compares but for what is held, whose rows and columns must be those of the unit matrix.
void expect_equal(const Eigen::SparseMatrix<double>& sparse, const Eigen::MatrixXd& expected, const Flow& flow) {
  const Eigen::MatrixXd matrix(sparse);
  const double largest = expected.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      if (flow.held[i] || flow.held[j])
        EXPECT_EQ(matrix(i, j), i == j ? 1 : 0) << i << ", " << j;
      else
        // Differences of residuals of the matrix' size, over a step of 0.1, in double precision.
        EXPECT_NEAR(matrix(i, j), expected(i, j), 1e-12 * largest) << i << ", " << j;
    }
}

TEST(Jacobian, IsTheDerivativeOfTheWholeResidualWhereTauIsFixed) {
  for (const Geometry geometry : {Geometry::planar, Geometry::axisymmetric}) {
    RandomFlow random = random_flow(uneven_mesh(5, 4, 1), {0, 0.3, geometry}, 1);
    const Eigen::SparseMatrix<double> matrix = jacobian(random.flow, random.scheme);
    const auto size = static_cast<Eigen::Index>(random.flow.unknown.size());
    Eigen::MatrixXd expected(size, size);
    std::vector<double> residual(random.flow.unknown.size());
    for (Eigen::Index j = 0; j < size; ++j) {
      // Linear without density: a step of 1 rounds least.
      Eigen::VectorXd change = Eigen::VectorXd::Zero(size);
      for (const int sign : {1, -1}) {
        std::vector<double> unknown = random.flow.unknown;
        unknown[static_cast<std::size_t>(j)] += sign;
        residual_of(random.flow, random.scheme, unknown, residual);
        change += 0.5 * sign * Eigen::Map<const Eigen::VectorXd>(residual.data(), size);
      }
      expected.col(j) = change;
    }
    expect_equal(matrix, expected, random.flow);
  }
}

TEST(Jacobian, IsTheDerivativeWithTheStabilisationHeld) {
  for (const Geometry geometry : {Geometry::planar, Geometry::axisymmetric})
    for (const double viscosity : {0.5, 1e-3})
      for (const Convection convection : {Convection::included, Convection::omitted}) {
        const RandomFlow random = random_flow(uneven_mesh(5, 4, 2), {1.2, viscosity, geometry, convection}, 2);
        expect_equal(jacobian(random.flow, random.scheme), differenced(random), random.flow);
      }
}

// The difference between the two is what the name says: with density, tau moves with the velocity.
TEST(Jacobian, LeavesOutHowTheStabilisationMoves) {
  const RandomFlow random = random_flow(uneven_mesh(3, 2, 3), {1.2, 1e-3, Geometry::planar}, 3);
  const auto size = static_cast<Eigen::Index>(random.flow.unknown.size());
  const Eigen::MatrixXd matrix(jacobian(random.flow, random.scheme));
  double most = 0;
  for (Eigen::Index j = 0; j < size; ++j) {
    if (random.flow.held[j]) continue;
    const auto at = [&](double by) {
      std::vector<double> unknown = random.flow.unknown, residual(unknown.size());
      unknown[static_cast<std::size_t>(j)] += by;
      residual_of(random.flow, random.scheme, unknown, residual);
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(residual.data(), size));
    };
    most = std::max(most, ((at(1e-5) - at(-1e-5)) / 2e-5 - matrix.col(j)).cwiseAbs().maxCoeff());
  }
  EXPECT_GT(most, 1e-3 * matrix.cwiseAbs().maxCoeff());
  EXPECT_LT(most, 1.0 * matrix.cwiseAbs().maxCoeff());
}

TEST(KeptFactor, SolvesWithItsMatrix) {
  const RandomFlow random = random_flow(uneven_mesh(6, 4, 4), {1, 0.1, Geometry::planar}, 4);
  KeptFactor factor;
  EXPECT_TRUE(factor.empty());
  ASSERT_TRUE(factor.factorise(jacobian(random.flow, random.scheme)));
  EXPECT_FALSE(factor.empty());
  const auto size = factor.matrix().rows();
  const Eigen::VectorXd x = Eigen::VectorXd::Random(size), b = factor.matrix() * x;
  Eigen::VectorXd found(size);
  factor.solve({b.data(), static_cast<std::size_t>(size)}, {found.data(), static_cast<std::size_t>(size)});
  EXPECT_LT((found - x).norm(), 1e-10 * x.norm());  // A few digits of condition.
}

TEST(KeptFactor, SaysSoWhenTheMatrixIsSingular) {
  Flow flow = at_rest(uneven_mesh(3, 2, 1), {1, 1, Geometry::planar});
  for (auto& held : flow.held) held = 1;
  KeptFactor factor;
  Eigen::SparseMatrix<double> matrix = jacobian(flow, {});
  ASSERT_TRUE(factor.factorise(matrix));
  matrix.coeffRef(4, 4) = 0;
  EXPECT_FALSE(factor.factorise(matrix));
  EXPECT_TRUE(factor.empty());
  matrix.coeffRef(4, 4) = 2;
  EXPECT_TRUE(factor.factorise(matrix));
}

}  // namespace
}  // namespace seapile::fluid
