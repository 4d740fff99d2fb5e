// The factors of a matrix, kept while the matrix they are used for moves on.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <span>

#include "solver/fluid/flow.h"

namespace seapile::fluid {

/// LU factors by UMFPACK (Davis 2004), without iterative refinement: what is left is the outer iteration's to correct.
/// The factors are a function of the matrix alone, so a checkpoint keeps the matrix.
class KeptFactor {
 public:
  KeptFactor();
  ~KeptFactor();
  KeptFactor(KeptFactor&&) noexcept;
  KeptFactor& operator=(KeptFactor&&) noexcept;

  bool empty() const;
  /// Factorises; false when the matrix is singular. The ordering is kept while the pattern stays the same.
  bool factorise(Eigen::SparseMatrix<double> matrix);
  /// x = A^-1 b. Both of the matrix' size; not the same array.
  void solve(std::span<const double> b, std::span<double> x) const;
  const Eigen::SparseMatrix<double>& matrix() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

/// The derivatives of all residuals by all unknowns at the flow's state (tau held fast), by automatic differentiation;
/// rows and columns of what is held are those of the unit matrix. Of films that follow
/// the flow it has the stiffness that they have when they are level.
Eigen::SparseMatrix<double> jacobian(const Flow& flow, const TimeScheme& scheme);

}  // namespace seapile::fluid
