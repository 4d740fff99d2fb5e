// The fluid between and above the grains: what makes a scene saturated.
#pragma once

#include <cstdint>
#include <optional>

#include "solver/base/fields.h"
#include "solver/basin/basin_spec.h"
#include "solver/coupling/coupling_spec.h"

namespace seapile::scene {

/// Triangles by Gmsh, mirrored in the middle; finer near the pile.
struct FluidMeshSpec {
  double size = 0.112;       ///< of the edges, far from the pile [m]
  double pile_size = 0.112;  ///< at the pile's tip [m]
  double growth = 0.15;      ///< of the edges with the distance from the tip [-]
  basin::MotionMethod motion = basin::ZonesMotion{};
  std::optional<basin::RemeshSpec> remesh = basin::RemeshSpec{};  ///< absent: the first mesh is kept
  friend bool operator==(const FluidMeshSpec&, const FluidMeshSpec&) = default;
};
void fields(auto& visit, base::SameAs<FluidMeshSpec> auto& mesh) {
  using base::Field;
  visit(Field{"size", "m", base::positive(1e3), "size of the elements far from the pile"}, mesh.size);
  visit(Field{"pile_size", "m", base::positive(1e3), "size of the elements at the pile's tip"}, mesh.pile_size);
  visit(Field{"growth", "-", base::between(0.01, 1), "growth of the elements with the distance from the tip"},
        mesh.growth);
  visit(base::part("motion", "how the mesh follows: zones (Appendix A) or elliptic (4.2)"), mesh.motion);
  visit(base::part("remesh", "when a new mesh is made; null: never"), mesh.remesh);
}

struct FluidTimeSpec {
  double step = 1e-3;       ///< dt of the fluid [s], a whole number of the grains' steps
  std::int64_t order = 1;   ///< of the scheme in time, 1 or 2
  double tolerance = 1e-5;  ///< of the flow's equations [-]
  std::optional<double> rate =
      {};  ///< the fastest rate that the stabilisation reckons with [1/s]; absent: the scheme's
  friend bool operator==(const FluidTimeSpec&, const FluidTimeSpec&) = default;
};
void fields(auto& visit, base::SameAs<FluidTimeSpec> auto& time) {
  using base::Field;
  visit(Field{"step", "s", base::positive(100), "time step of the fluid, a whole number of the grains' steps"},
        time.step);
  visit(Field{"order", "-", base::between(1, 2), "order in time: implicit Euler or BDF2"}, time.order);
  visit(Field{"tolerance", "-", base::between(1e-13, 1e-2), "largest residual of the flow's equations"},
        time.tolerance);
  visit(Field{"rate", "1/s", base::between(0, 1e9),
              "fastest rate that the stabilisation reckons with; null: the scheme's"},
        time.rate);
}

/// The fluid of a saturated scene. It fills the grains' box to its depth, slips along the box and sticks to the pile.
struct FluidSpec {
  double depth = 4;                   ///< H [m], of the fluid at rest, from the base of the box
  double density = 1000;              ///< rho [kg/m3]
  double kinematic_viscosity = 1e-6;  ///< nu [m2/s]
  basin::WallKind walls = basin::WallKind::slip;
  basin::WallKind bottom = basin::WallKind::slip;
  std::optional<basin::SurfaceSpec> surface = basin::SurfaceSpec{};  ///< absent: an open top at a fixed height
  FluidMeshSpec mesh;
  FluidTimeSpec time;
  coupling::CouplingSpec coupling;
  fluid::Convection convection = fluid::Convection::included;  ///< not written in a study: decided (scene/analysis.h)
  friend bool operator==(const FluidSpec&, const FluidSpec&) = default;
};
void fields(auto& visit, base::SameAs<FluidSpec> auto& fluid) {
  using base::Field;
  visit(Field{"depth", "m", base::positive(1e4), "depth of the fluid at rest, from the base of the box"}, fluid.depth);
  visit(Field{"density", "kg/m3", base::positive(1e5), "density rho"}, fluid.density);
  visit(Field{"kinematic_viscosity", "m2/s", base::positive(1e3), "kinematic viscosity nu"}, fluid.kinematic_viscosity);
  visit(base::part("walls", "slip or no_slip along the sides"), fluid.walls);
  visit(base::part("bottom", "slip or no_slip along the bottom"), fluid.bottom);
  visit(base::part("surface", "the free surface; null: an open top at a fixed height"), fluid.surface);
  visit(base::part("mesh", "the mesh, and how it follows"), fluid.mesh);
  visit(base::part("time", "steps and scheme in time"), fluid.time);
  visit(base::part("coupling", "how grains and fluid act on each other"), fluid.coupling);
}

}  // namespace seapile::scene
