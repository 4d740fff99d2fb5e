// One step in time of a flow on a moving mesh.
//
// The mesh has moved to its new place already, with one velocity w; boundary values and porosity are those of the new
// time.
//   first order     dv/dt = (v - v_n)/dt                          implicit Euler
//   second order    dv/dt = (3 v - 4 v_n + v_n-1)/(2 dt)          BDF2; its first step is an Euler step
// along the vertices. The same formula gives w and dphi/dt from places and porosities, so that they are consistent.
//
// The nonlinear equations R(U) = 0 are solved from the extrapolated state 2 U_n - U_n-1 by U <- U - A^-1 R(U), with the
// LU factors of an earlier step's Jacobian A, and Anderson's acceleration, which for linear equations is GMRES with A
// as its preconditioner (Walker, Ni 2011). No matrix is assembled but for a new factor:
//   - when there is none, the rate of the scheme has changed, or the mesh is another one;
//   - when the last step took more than kManyIterations, or when the corrections that the steps since the last factor
//     took beyond what the first of them took add up to what a factor costs: nobody knows for how long a factor would
//     have served, and if a new one does as well as this one did at first, the rule spends at most twice the least;
//   - when a step does not converge within kMostIterations: it begins again with a new one.
//
// Where the domain depends on the flow of the same step (a free surface), it is found by the same iteration: the domain
// is made anew from the unknowns before each residual. Of that A knows what a level film's weight and tension do
// (without it (omega dt)^2 of the fastest surface wave would have to stay below 1); Anderson's acceleration makes up
// for the rest.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/instruction_set.h"
#include "solver/base/objection.h"
#include "solver/base/profile.h"
#include "solver/fluid/flow.h"
#include "solver/fluid/kept_factor.h"
#include "solver/fluid/residual.h"

namespace seapile::fluid {

/// A time level that the scheme looks back to.
struct TimeLevel {
  std::vector<double> unknown;           ///< (3 vertices)
  std::vector<base::Vec2> interstitial;  ///< v = u/phi [m/s], (vertices)
  std::vector<base::Vec2> position;      ///< [m], (vertices)
  std::vector<double> porosity;          ///< [-], (vertices)
};

/// The levels n, n-1 (newest first; at most two). All of one dt apart.
struct Past {
  std::vector<TimeLevel> level;
  double dt = 0;  ///< [s]
};

enum class TimeOrder { first = 1, second = 2 };

struct FlowSolver {
  TimeOrder order = TimeOrder::second;
  double tolerance = 1e-8;  ///< largest |R| by the size of its terms (see FlowReport) [-]
  base::InstructionSet instructions = base::InstructionSet::generic;
  /// The fastest rate at which the flow changes, for its stabilisation (element.h) [1/s]; absent: that of the scheme.
  /// 0 is for flows that friction or drag rules: at Re 2e5, and in water that begins to move, nothing converges.
  std::optional<double> unsteadiness;

  KeptFactor factor;
  double factor_rate = -1;  ///< rate of the scheme that the factor belongs to [1/s]
  int last_iterations = 0;
  int first_iterations = 0;   ///< of the step that the factor was made for
  int excess_iterations = 0;  ///< of all steps with this factor, beyond first_iterations
  std::int64_t refactorisations = 0;
  PackedFlow packed;
};

/// A factor costs as much as so many corrections: 40 ms and 1.2 ms at 1,961 vertices, on a busy machine.
inline constexpr int kFactorWorth = 32;
inline constexpr int kManyIterations = 6, kMostIterations = 25;

struct FlowReport {
  bool converged = false;
  int iterations = 0;
  bool refactored = false;
  /// |R|, mass rows weighted with (rho rate + mu/h^2) h, by (rho rate h^2 + mu) |u|; h^2 the mean area of a vertex. 0
  /// when |R| is no more than the rounding of the pressure's terms, |p| h, and of the films' heights: a fluid at rest
  /// has no other scale [-].
  double residual = 0;
  std::string reason;  ///< one sentence when not converged
  /// What the equations of continuity are short of where the iteration ended, (vertices) [m2/s].
  std::vector<double> defect;
};

/// Why the flow could not be advanced; empty when it was.
base::Objection objection(const FlowReport& report, const Past& past);

/// Remembers the flow as it is as the newest level. Forgets what was before when dt changes.
void remember(Past& past, const Flow& flow, double dt);

/// Derivatives in time at the new level, by the scheme that advance() will use, from the places and porosities of flow
/// and past: sets flow.mesh_velocity and flow.porosity_rate.
void set_rates(Flow& flow, const Past& past, TimeOrder order);

/// How the scheme makes dv/dt of the new level from those of the past.
TimeScheme scheme_of(const Past& past, const FlowSolver& solver);

/// Makes the domain that belongs to flow.unknown: places, velocities of the mesh, values that are held, outside
/// pressures. False when there is none; the step then fails.
using FollowFlow = std::function<bool(Flow&)>;

/// Solves for the new level; `flow.unknown` holds the values that are held. On failure the unknowns are those given.
/// `follow`: empty when the domain does not depend on the flow.
FlowReport advance(Flow& flow, const Past& past, FlowSolver& solver, base::Profile& profile,
                   const FollowFlow& follow = {});

}  // namespace seapile::fluid
