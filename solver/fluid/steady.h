// Steady flow, with the place of its free surface when it has one: Newton's method on all unknowns at once.
//
// Unknowns: (u_x, u_y, p) of every vertex and, with a surface, h of its vertices; the mesh below hangs on h
// (mesh/columns.h). The derivatives of every triangle's residual, also those by the places of its vertices, are taken
// by automatic differentiation, so convergence is quadratic but for tau, which is not differentiated. Where Newton
// starts far from the solution (a flat jet) the surface moves in pseudo-time first.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "solver/fluid/flow.h"
#include "solver/fluid/free_surface.h"

namespace seapile::fluid {

struct NewtonLimits {
  int most_iterations = 60;
  double tolerance =
      1e-10;  ///< of the largest change of a velocity or height, by the largest velocity or height there is [-]
  double largest_rise = 0.1;  ///< of a surface vertex in an iteration, by its height [-]
};

struct NewtonReport {
  bool converged = false;
  int iterations = 0;
  double change = 0;    ///< of the last iteration, as for `tolerance` [-]
  double residual = 0;  ///< largest residual of an equation at the end
  std::string reason;   ///< one sentence when it did not converge
};

/// Brings `flow` (and `surface`, and the mesh with it) to the steady state near the one given.
NewtonReport solve_steady(Flow& flow, FreeSurface* surface, const NewtonLimits& limits = {});

}  // namespace seapile::fluid
