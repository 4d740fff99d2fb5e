// Values of one mesh on another mesh of the same domain.
//
//   interpolation   f'(x_i) = f(x_i)
//   projection      int N'_i f' = int N'_i f      for all i, in L2, exact on the common refinement of both meshes
//
// f and f' linear on their meshes. Both are of second order; the projection keeps integrals, the interpolation bounds.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/mesh/triangle_mesh.h"

namespace seapile::mesh {

/// What a transfer did to one component.
struct TransferError {
  double before = 0, after = 0;  ///< integrals of f and f' over the domain [unit m2]
  double difference = 0;         ///< L2 norm of f' - f [unit m]
  double norm = 0;               ///< L2 norm of f [unit m]
};

/// From `old_mesh` to `new_mesh`, whose polygons are the same up to rounding (a vertex that lies outside by rounding
/// belongs to the nearest triangle). Throws std::logic_error when the areas differ by more than 1e-6 of them.
class Transfer {
 public:
  Transfer(const TriangleMesh& old_mesh, const TriangleMesh& new_mesh);

  /// `values`: (old vertices); (new vertices) is returned.
  std::vector<double> interpolated(std::span<const double> values) const;
  std::vector<double> projected(std::span<const double> values) const;
  TransferError error(std::span<const double> before, std::span<const double> after) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace seapile::mesh
