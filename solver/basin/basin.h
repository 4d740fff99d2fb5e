// A basin of water while it runs: its flow, what holds at its boundary, its surface and its pile.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "solver/base/clock.h"
#include "solver/base/instruction_set.h"
#include "solver/basin/basin_spec.h"
#include "solver/basin/surface_flux.h"
#include "solver/fluid/advance.h"
#include "solver/fluid/flow.h"
#include "solver/fluid/free_surface.h"
#include "solver/mesh/motion.h"
#include "solver/mesh/quality.h"
#include "solver/pile/pile.h"

namespace seapile::basin {

/// What the basin's mesh is, between two remeshes: everything that depends on the mesh alone.
struct Domain {
  std::vector<base::Vec2> reference;     ///< places when the mesh was made [m], (vertices)
  std::vector<double> reference_height;  ///< of the surface then [m], (surface vertices)
  double reference_tip = 0;              ///< height of the tip's lowest point then [m]
  mesh::MeshMotion motion;               ///< from the reference places
  std::vector<Under> under;              ///< the surface above each vertex, (vertices)
  std::vector<std::int32_t> wetted;      ///< vertices on tip and sleeves
  std::vector<std::uint8_t> of_tip;      ///< 1 for those on the tip, shoulders included, (vertices)
  std::vector<std::uint8_t> of_sleeve;   ///< 1 for the others of them, (vertices)
  std::vector<std::int32_t> at_pile;     ///< triangles that touch them
};

/// What a remesh did.
struct RemeshReport {
  double time = 0;  ///< [s]
  mesh::QualitySummary before, after;
  double velocity_difference = 0;  ///< L2 norm of what the transfer changed, by that of the velocity [-]
  double energy_change = 0;        ///< of the kinetic energy, by it [-]
  double momentum_change = 0;      ///< of the integral of the velocity, by its L2 norm and the root of the area [-]
};

struct Basin {
  BasinSpec spec;
  fluid::Flow flow;
  /// Heights and vertices of the top; with a fixed top it is a line that stays, and absent from what is solved.
  fluid::FreeSurface top;
  Domain domain;
  fluid::Past past = {};
  std::vector<double> past_tip = {};  ///< heights of the tip at the levels of `past` [m]
  /// Fluxes through the surface at the levels of `past`, newest first, of the conservative update without iteration
  /// [m2/s].
  std::vector<std::vector<double>> past_flux = {};
  fluid::FlowSolver solver = {};
  base::Vec2 tip_force = {}, sleeve_force = {};  ///< of the water in the last step, without the hydrostatic one [N/m]
  double volume_at_start = 0;          ///< of the water [m2]
  base::Clock clock = {};              ///< steps done
  std::int64_t iterations = 0;         ///< corrections so far
  std::int64_t last_iterations = 0;
  std::vector<RemeshReport> remeshes = {};  ///< so far
};

/// The basin at its start: at rest, with its surface as the scene says. Throws mesh::NoMesh.
Basin filled(const BasinSpec& spec, base::InstructionSet instructions);
/// The same on a mesh that is given: of the water at rest, around the pile where it starts.
Basin filled(const BasinSpec& spec, base::InstructionSet instructions, mesh::TriangleMesh mesh);

/// A basin of given parts, with its solver as the spec says; nothing remembered yet.
Basin assembled(const BasinSpec& spec, base::InstructionSet instructions, fluid::Flow flow, fluid::FreeSurface top,
                Domain domain);

/// What depends on a mesh alone. The mesh is at its reference places.
Domain domain_of(const BasinSpec& spec, const mesh::TriangleMesh& mesh, const fluid::FreeSurface& top, double tip);

/// A flow at rest on the mesh, with what holds at its boundary, and the vertices of its top.
fluid::Flow flow_in(const BasinSpec& spec, mesh::TriangleMesh mesh);
fluid::FreeSurface top_of(const BasinSpec& spec, const mesh::TriangleMesh& mesh);

/// Height of the tip's lowest point at a time [m]; 0 without a pile.
double tip_at(const BasinSpec& spec, double time);
/// The tip's outline for a lowest point at height `tip`, right half, by rising x [m].
std::vector<base::Vec2> tip_outline(const BasinPileSpec& pile, double tip);

/// Whether surface and flow are found together in each step; explicit schemes of the surface have nothing to be found.
bool is_iterated(const BasinSpec& spec);

double time_of(const Basin& basin);

/// Makes the step dt/2^halvings. The past is one of the old step: what comes next begins anew, as an Euler step.
void set_halvings(Basin& basin, int halvings);

/// rho/2 times the integral of u^2 [J/m].
double kinetic_energy_of(const fluid::Flow& flow);
/// Area of the mesh [m2].
double volume_of(const mesh::TriangleMesh& mesh);

/// Puts the mesh where surface and tip say.
void place(Basin& basin, double tip);
/// Pressures from outside: the weight of what stands above the rest level, and the film's tension.
void set_outside(Basin& basin);

}  // namespace seapile::basin
