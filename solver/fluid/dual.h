// Numbers that carry derivatives: Eigen's forward automatic differentiation.
#pragma once

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

namespace seapile::fluid {

/// A number and its derivatives by N variables.
template <int N>
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, N, 1>>;

/// The variable number `index`.
template <int N>
Dual<N> variable(double value, int index) {
  return {value, N, index};
}

/// A number that does not depend on the variables.
template <int N>
Dual<N> constant(double value) {
  return {value, Eigen::Matrix<double, N, 1>::Zero()};
}

}  // namespace seapile::fluid
