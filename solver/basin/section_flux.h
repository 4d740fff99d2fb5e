// How the water's flux through vertical sections moves the surface: the update that loses no volume.
//
//   int N_s dh/dt dx = int u_x dN_s/dx dA + (displaced flux)_s          s: vertices of the surface
//
// N_s is linear in x between the surface's vertices, and the same at all heights; across the pile it is linear between
// the two vertices at its sides. It is the equation of continuity, tested with functions of x alone, which says what
// the kinematic condition says (div u = 0, and u.n = 0 at rest) without a velocity or a slope of the surface: dh/dt = -
// d/dx (int u_x dy). As sum N_s = 1, volume is kept to rounding whatever the flow's tolerance is. The pile pushes half
// of what it displaces to each of its sides: int N_s V dx over its width.
//
// The integral over a triangle between two verticals depends on the triangle's area and on the x of its vertices, which
// do not change as meshes move up and down: the weights are made once per mesh. Order: 2. The condition is not
// upwinded: where the surface moves sideways fast, second differences of the scheme in time are all that damps its
// shortest waves.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/fluid/flow.h"
#include "solver/fluid/free_surface.h"

namespace seapile::basin {

/// What a triangle adds to the flux through one strip between two vertices of the surface: 2 area sum_k weight[k]
/// u_x[k].
struct StripPart {
  std::int32_t triangle = 0;
  std::int32_t strip = 0;  ///< between the surface's vertices strip and strip + 1
  std::array<double, 3> weight{};
};

struct SectionFlux {
  std::vector<StripPart> part;  ///< by rising triangle
  std::vector<double> x;        ///< of the surface's vertices [m]
};

/// The parts of a mesh below a surface whose x are `x`, rising from wall to wall. Throws std::logic_error when a
/// triangle reaches beyond.
SectionFlux section_flux(const mesh::TriangleMesh& mesh, std::span<const double> x);

/// int u_x dN_s/dx dA at the surface's vertices for superficial velocities in `unknown` (3 vertices) [m2/s].
std::vector<double> fluxes(const SectionFlux& flux, const mesh::TriangleMesh& mesh, std::span<const double> unknown);

/// Heights at the new time: rate (h - before) = dh/dt by the consistent mass matrix, from `flux` per vertex [m2/s].
/// `before`: the heights that the scheme in time looks back to [m], (surface vertices).
std::vector<double> risen(const fluid::FreeSurface& surface, std::span<const double> flux, double rate,
                          std::span<const double> before);

}  // namespace seapile::basin
