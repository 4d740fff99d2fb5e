// Structured meshes of a rectangle, for scenes that ask for symmetry or exact positions.
#pragma once

#include <span>

#include "solver/mesh/triangle_mesh.h"

namespace seapile::mesh {

/// Tags of a rectangle's sides.
enum Side : std::int32_t { kBottom = 0, kRight = 1, kTop = 2, kLeft = 3 };

/// How the quadrangles of a grid are cut into triangles.
enum class Diagonals {
  alike,     ///< all from lower left to upper right
  mirrored,  ///< mirror images of each other left and right of the middle; the number of columns must be even
};

/// The grid of all (x[i], y[j]), x and y rising; vertex i + j * x.size(). Throws std::logic_error when an axis has
/// fewer than two values.
TriangleMesh rectangle(std::span<const double> x, std::span<const double> y, Diagonals diagonals = Diagonals::alike);

/// `count` + 1 evenly spaced values from `first` to `last`.
std::vector<double> even(double first, double last, int count);

}  // namespace seapile::mesh
