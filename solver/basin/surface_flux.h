// The surface update that loses no volume, whatever the flow's tolerance is.
//
//   int N_s dh/dt dx = int N_s (v_y - v_x dh/dx) dx - sum_i N_s(x_i) r_i        s: vertices of the surface
//
// The first integral is the kinematic condition, and its sum over s is the flux through the surface. r_i is what the
// equation of continuity of vertex i is short of: it is 0 up to the tolerance that the flow was solved to, and sum r_i
// is the flux through the whole boundary, to rounding (stabilisation adds nothing to the sum, as sum N_i = 1). So the
// sum of the right-hand sides is what the pile displaces, and the water's volume is kept to rounding. Each vertex hands
// its defect to the surface above it, linear in x; below the pile, to both its sides.
//
// The other way to have fluxes of the equation of continuity, dh/dt = - d/dx int u_x dy with u_x integrated over
// vertical strips, is exact too, but its shortest waves do not feel the pressure that they make (the strips do not know
// the stabilisation of the continuity equation): with surface tension they grow (docs/decisions/0010).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/fluid/flow.h"
#include "solver/fluid/free_surface.h"

namespace seapile::basin {

/// Where a vertex of the mesh lies under the surface: between the surface's vertices `from` and `from` + 1.
struct Under {
  std::int32_t from = 0;
  double weight = 0;  ///< of the second one [-]
};

/// Of all vertices of a mesh, below a surface whose x are `x`, rising from wall to wall.
std::vector<Under> under(const mesh::TriangleMesh& mesh, std::span<const double> x);

/// What the vertices below hand to the surface's: sum_i N_s(x_i) defect_i. `defect`: (vertices).
std::vector<double> handed_up(std::span<const Under> under, std::span<const double> defect,
                              std::size_t surface_vertices);

/// int N_s (v_y - v_x dh/dx) dx at the surface's vertices, for velocities of the mesh's vertices [m2/s].
std::vector<double> kinematic_flux(const fluid::FreeSurface& surface, std::span<const base::Vec2> velocity);

/// Heights for which rate (h - before) = dh/dt, with int N_s dh/dt dx = flux_s [m2/s]. `before` [m]: what the scheme in
/// time looks back to.
std::vector<double> risen(const fluid::FreeSurface& surface, std::span<const double> flux, double rate,
                          std::span<const double> before);

}  // namespace seapile::basin
