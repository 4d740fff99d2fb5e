// A fluid on a mesh of triangles: its state, and what holds at its boundary.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/base/vec2.h"
#include "solver/fluid/element.h"
#include "solver/mesh/triangle_mesh.h"

namespace seapile::fluid {

/// Component of a vertex's unknowns.
enum Component { kVelocityX = 0, kVelocityY = 1, kPressure = 2 };

/// An edge of the boundary on which a pressure acts from outside: traction -phi pressure n; what grains there bear is
/// theirs. The domain lies to its left.
struct OpenEdge {
  std::int32_t from = 0, to = 0;
  std::array<double, 2> pressure{};  ///< at its ends, without the hydrostatic one of the fluid's density [Pa]
};

/// An edge along a wall on which the fluid slips against friction (Navier): tangential traction -friction phi (v -
/// wall), so that the slip length is the same whatever the porosity.
struct SlipEdge {
  std::int32_t from = 0, to = 0;
  double friction = 0;  ///< mu / slip length [Pa s/m]
  base::Vec2 wall;      ///< velocity of the wall [m/s]
};

/// An edge of a film that pulls at its ends with gamma along itself; where films end at walls they stand at 90 degrees.
struct FilmEdge {
  std::int32_t from = 0, to = 0;
  double tension = 0;    ///< gamma [N/m]
  double weight = 0;     ///< growth of the outside pressure with its height [Pa/m]
  bool follows = false;  ///< whether its height is found with the flow of the same step
};

/// The fluid. What a vertex does not hold is solved for; edges that are in no list are free of traction.
struct Flow {
  mesh::TriangleMesh mesh;
  Properties fluid;
  std::vector<double> unknown;     ///< superficial velocity u_x, u_y [m/s] and pressure p [Pa], by vertex, (3 vertices)
  std::vector<std::uint8_t> held;  ///< 1: the unknown keeps its value (a boundary condition), (3 vertices)
  std::vector<OpenEdge> open;
  std::vector<SlipEdge> slip;
  std::vector<FilmEdge> film;
  std::vector<double> porosity;           ///< phi [-], (vertices)
  std::vector<double> porosity_rate;      ///< dphi/dt at the vertex [1/s], (vertices)
  std::vector<base::Vec2> mesh_velocity;  ///< w [m/s], (vertices)
  std::vector<base::Vec2> source;         ///< s [N/m3], (vertices)
  std::vector<double> drag;               ///< beta [kg/m3/s], (vertices)
  std::vector<base::Vec2> carried;        ///< u_g, the superficial velocity that drag leads to [m/s], (vertices)
  std::vector<double> mobility;           ///< kappa, volume that a pressure gradient makes the grains carry [m3 s/kg]
  std::vector<double> response;           ///< chi, volume that drag makes the grains carry, per slip [-], (vertices)

  double& u(std::int32_t vertex, Component component) { return unknown[3 * vertex + component]; }
  double u(std::int32_t vertex, Component component) const { return unknown[3 * vertex + component]; }
};

/// Fluid at rest on the mesh, pure (porosity 1), with nothing held.
Flow at_rest(mesh::TriangleMesh mesh, const Properties& fluid);

/// Keeps a vertex's velocity at the value given.
void hold(Flow& flow, std::int32_t vertex, Component component, double value);

/// How dv/dt is made of a velocity and those before it: rate v + history.
struct TimeScheme {
  double rate = 0;                  ///< [1/s]; 0: steady
  double unsteadiness = 0;          ///< s of the stabilisation [1/s]
  std::vector<base::Vec2> history;  ///< [m/s2], (vertices); empty when steady
};

/// Porosities at an edge's ends.
inline std::array<double, 2> porosity_at(const Flow& flow, std::int32_t from, std::int32_t to) {
  return {flow.porosity[from], flow.porosity[to]};
}

/// What a triangle's equations need of the flow.
ElementInput<double> input_of(const Flow& flow, const TimeScheme& scheme, std::size_t triangle);

}  // namespace seapile::fluid
