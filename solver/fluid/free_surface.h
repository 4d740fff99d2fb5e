// The free surface: a height over x, on a chain of the mesh's vertices.
//
//   kinematic    dh/dt + v_x dh/dx - v_y = 0                           thesis (3.4)
//   dynamic      (-p I + tau) n = (gamma kappa - p_ext) n              thesis (3.10), with the viscous normal stress
//   kappa = d/dx (h'/sqrt(1 + h'^2)), and - 1/(h sqrt(1 + h'^2)) more when axisymmetric
//
// Kinematic condition: weak form with upwinded test functions, N + share (dx/2) sign(v_x) N' (the streamline-upwind
// Petrov-Galerkin method in one dimension; Brooks, Hughes 1982), implicit in h with the velocity extrapolated to the
// new time, of the order of the flow's scheme. Plain Galerkin wiggles at the lip of a die and drifts in creeping flow.
// The condition is first-order hyperbolic: a height is prescribed only where fluid enters below it (the lip), never
// where it leaves. Dynamic condition: in time, by the curvature's L2 projection, as a pressure from outside; in steady
// flow by the film's exact derivative (boundary_terms.h). The thesis' own schemes are there to be measured: explicit
// Euler with plain Galerkin, and differences (3.18). Neglected: what the surface does once it is no graph; it is
// detected and told.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/base/objection.h"
#include "solver/fluid/flow.h"
#include "solver/mesh/columns.h"

namespace seapile::fluid {

enum class KinematicScheme {
  upwinded,     ///< implicit, upwinded weak form
  galerkin,     ///< explicit Euler, plain Galerkin (thesis 3.2 with (3.5))
  differences,  ///< explicit Euler, differences from the left (3.18)
};

struct FreeSurface {
  std::vector<std::int32_t> vertex;  ///< of the mesh, by rising x, (surface vertices)
  std::vector<double> x;             ///< [m], (surface vertices)
  std::vector<double> height;        ///< h [m], (surface vertices)
  mesh::Columns columns;             ///< how the mesh hangs below it
  /// Between this vertex and the next one there is no surface, but a body that stands in it; absent: one stretch.
  std::optional<std::size_t> gap;
  bool pinned = false;               ///< the first vertex stays where it is: the lip of a die
  /// The ends of the film stand at 90 degrees to what they end at, as in the thesis (3.5); false: at the slope that
  /// they have.
  bool right_angles = false;
  double tension = 0;           ///< gamma [N/m]
  double outside_pressure = 0;  ///< p_ext [Pa]
  KinematicScheme scheme = KinematicScheme::upwinded;
  double upwinding = 0.5;  ///< share of the full upwinding [-]
  /// Edges (from, to) across a round jet where it leaves as a plug, below the surface's last vertex: there the film's
  /// hoop tension acts from outside, a pressure of gamma/h. Empty: the traction there is what the flow's lists say.
  std::vector<std::array<std::int32_t, 2>> outflow;
};

/// The surface along the mesh's boundary edges of `tag`. Throws std::logic_error when they are no graph.
FreeSurface surface_along(const mesh::TriangleMesh& mesh, std::int32_t tag, double bottom);

/// Velocities and heights of earlier times, newest first; as many as the order of the scheme, all of one dt apart.
struct SurfaceLevel {
  std::span<const base::Vec2> interstitial;  ///< of the mesh's vertices [m/s]
  std::vector<double> height;                ///< [m]
};

/// Length of the surface along x, without the gap [m].
double width_of(const FreeSurface& surface);

/// The heights a time dt later. `lift`: added to v_y, as the volume correction asks (3.17) [m/s]. `now`: velocities at the new
/// time, of the mesh's vertices, for the implicit scheme; empty: they are extrapolated.
std::vector<double> advanced_height(const FreeSurface& surface, std::span<const SurfaceLevel> past, double dt,
                                    double lift, std::span<const base::Vec2> now = {});

/// Flux through the surface, the integral of v.n over it, n out of the fluid [m2/s; m3/s per radian when axisymmetric].
double flux_through(const FreeSurface& surface, Geometry geometry, std::span<const base::Vec2> interstitial);

/// kappa at the surface's vertices by L2 projection (thesis (3.12), in the form that is exact for large slopes) [1/m].
std::vector<double> curvature(const FreeSurface& surface, Geometry geometry);

/// Largest |v.n| of the surface's edges that begin at or behind `from` [m/s].
double largest_leak(const FreeSurface& surface, std::span<const base::Vec2> interstitial, double from);

/// When the surface is no graph that a mesh can hang on any more: not finite, at the bottom, or too steep.
base::Objection objection(const FreeSurface& surface);

}  // namespace seapile::fluid
