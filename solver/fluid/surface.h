// The free surface: a height over x, on a chain of the mesh's vertices.
//
//   kinematic    dh/dt + v_x dh/dx - v_y = 0                           thesis (3.4)
//   dynamic      (-p I + tau) n = (gamma kappa - p_ext) n              thesis (3.10), with the viscous normal stress
//
// The kinematic condition is written in the weak form with upwinded test functions, N + share (dx/2) sign(v_x) N' (the
// streamline-upwind Petrov-Galerkin method in one dimension): plain Galerkin wiggles at the lip and drifts in creeping
// flow. It is first-order hyperbolic: a height is prescribed only where fluid enters below it (the lip of a die), never
// where it leaves.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/mesh/columns.h"

namespace seapile::fluid {

struct FreeSurface {
  std::vector<std::int32_t> vertex;  ///< of the mesh, by rising x, (surface vertices)
  std::vector<double> height;        ///< h [m], (surface vertices)
  mesh::Columns columns;             ///< how the mesh hangs below it
  bool pinned = false;               ///< the first vertex stays where it is: the lip of a die
  double tension = 0;                ///< gamma [N/m]
  double outside_pressure = 0;       ///< p_ext [Pa]
  double upwinding = 0.5;            ///< share of the full upwinding [-]
  /// Edges (from, to) across a round jet where it leaves as a plug, below the surface's last vertex: there the film's
  /// hoop tension acts from outside, a pressure of gamma/h. Empty: the traction there is what the flow's lists say.
  std::vector<std::array<std::int32_t, 2>> outflow;
};

}  // namespace seapile::fluid
