// Porosity and stress on a regular grid.
//
// Stress at a point: sigma = (1/A) sum over the contacts within a disc of radius 0.08 m of f (x) l, with f the contact
// force on the second body and l the branch vector from the first centre to the second (to the contact point, where the
// second is a wall or the pile); compression positive. A is the disc's area inside the box. (Christoffersen, Mehrabadi
// and Nemat-Nasser 1981; formulation.md 3.)
// Porosity of a cell: 1 - (area of the grains inside it) / (its area), exact; the pile counts as void.
#pragma once

#include <span>
#include <vector>

#include "solver/base/vec2.h"
#include "solver/grains/contact_solver.h"

namespace seapile::grains {

inline constexpr double kStressRadius = 0.08;  // [m], of the averaging disc

struct Grid {
  double x0 = 0, y0 = 0, spacing = 0;  ///< lower left corner, edge of a cell [m]
  int nx = 0, ny = 0;
};

/// A mean contact force between two bodies.
struct ContactForce {
  std::int32_t first = 0, second = 0;  ///< as in TouchingContact
  double x = 0, y = 0;                 ///< point of contact [m]
  double nx = 0, ny = 0;               ///< normal from the first to the second
  double normal = 0, tangential = 0;   ///< [N/m]
};

struct Stress {
  double xx = 0, yy = 0, xy = 0;  ///< [Pa], compression positive; xy the mean of both shears
};

/// Principal values and the direction of the major one.
struct PrincipalStress {
  double major = 0, minor = 0;  ///< [Pa]
  double direction = 0;         ///< angle of the major one from x, in (-pi/2, pi/2] [rad]
};
PrincipalStress principal(const Stress& stress);

/// Stress at the cells' centres, x fastest.
std::vector<Stress> stress_on_grid(std::span<const ContactForce> contacts, std::span<const Disc> discs, const Box& box,
                                   const Grid& grid);

/// Porosity of the cells, x fastest.
std::vector<double> porosity_on_grid(std::span<const Disc> discs, const Grid& grid);

}  // namespace seapile::grains
