// Momentum and volume that grains and fluid give each other within a step of the fluid.
//
//   drag       F_d = gamma_e (v_f - v*),   gamma_e = gamma m/(m + dt gamma)                         [N/m]
//   pressure   F_p = -sum_j V_j g_j,   g_j = (1/m_j) integral of N_j grad p                         [N/m]
//
// of a grain of mass m, of which the vertex j has the area V_j (deposit.h); m_j the integral of the hat function N_j,
// v_f = sum_j (V_j/V) u_j/phi_j the fluid's velocity at the grain. v* is the velocity that the grain will have at the
// end of the step but for this step's drag, so that gamma_e makes the drag implicit in the grain's velocity too: stable
// for grains however light (the semi-implicit drag of MigFlow: Constant, Dubois, Lambrechts, Legat, Comp. Part. Mech. 6
// (2019) 213-226). Pressure is without the hydrostatic one: buoyancy is part of the grains' weight.
//
// On the fluid's side (fluid/element.h) the same forces stand lumped at the vertices,
//   beta = B_j/(m_j phi_j),   u_g = phi_j (sum_i gamma_e w_ij v*_i)/B_j,   B_j = sum_i gamma_e w_ij,   w_ij = V_ij/V_i
// and (1 - phi) grad p inside its -phi grad p: what one gains the other loses, to rounding.
//
// Volume: dphi/dt is that of the grains' predicted way x + dt (v - dt a), a the acceleration by the last step's
// exchange; what this step's exchange makes of it stands in the mass equation as the grains' answer,
//   kappa = (dt/m_j) sum_i (V_i/m) V_ij,   chi = (dt/(m_j phi_j)) sum_i (V_i/m) gamma_e w_ij.
// With the way alone, the pressure would answer last step's motion: where (1 - phi) rho > phi rho_p, as in every
// dense bed, the two then throw each other to and fro, the faster the smaller dt.
//
// The rate of phi at the moving vertices is made of volumes, so that none is lost whatever the mesh does:
//   m_j dphi_j/dt = (1 - phi_j) D m_j - D S_j,   S_j = sum_i V_ij,   D the difference of the scheme in time.
// At the start of a step S_j is that of where the grains were expected, put right (moved_solid.h).
// Areas of triangles whose vertices move vertically are linear in time, and the mesh velocity's divergence is D m_j.
//
// First order in time. Neglected: added mass beyond what the pressure of the averaged flow gives, lift, torque.
#pragma once

#include <span>
#include <vector>

#include "solver/base/vec2.h"
#include "solver/coupling/deposit.h"
#include "solver/coupling/drag.h"
#include "solver/coupling/porosity.h"
#include "solver/fluid/advance.h"
#include "solver/fluid/flow.h"

namespace seapile::coupling {

/// The grains as the fluid meets them within a step, one by one, (grains).
struct Suspended {
  std::span<const double> mass;          ///< m [kg/m]
  std::span<const double> drag;          ///< gamma_e [kg/m/s]
  std::span<const base::Vec2> velocity;  ///< v* [m/s]
};

/// What the grains bring to a vertex, summed up in their order: a cache line.
struct alignas(64) Load {
  double solid = 0;                       ///< S_j [m2]
  double resistance = 0;                  ///< B_j [kg/m/s]
  double momentum_x = 0, momentum_y = 0;  ///< sum_i gamma_e w_ij v*_i [N/m]
  double moved = 0;                       ///< dt sum_i (V_i/m) V_ij, by pressure [m5 s/kg]
  double answered = 0;                    ///< dt sum_i (V_i/m) gamma_e w_ij, by drag [m2]
};
/// Of each vertex.
std::vector<Load> load(const Deposit& deposit, const Suspended& grains, double dt, std::size_t vertices);

/// m_j now and at the level before [m2], (vertices).
struct VertexVolumes {
  std::span<const double> now, before;
};
/// Sets flow.porosity_rate at the flow's porosity and places, and those of `past`.
void set_porosity_rate(fluid::Flow& flow, const fluid::Past& past, fluid::TimeOrder order, const VertexVolumes& volume);

/// The fluid where the grains are, (grains): means over a grain's share at the vertices.
struct Surroundings {
  std::vector<double> porosity;      ///< phi; 1 out of the fluid [-]
  std::vector<base::Vec2> velocity;  ///< v_f; 0 out of the fluid [m/s]
};
Surroundings surroundings(const fluid::Flow& flow, const Deposit& deposit);

/// gamma of each grain [kg/m/s], of its share in the fluid. `immersed`: V_i; `velocity`: of the grains.
std::vector<double> drag_coefficients(const DragSpec& law, const fluid::Properties& fluid, const Surroundings& around,
                                      std::span<const double> immersed, std::span<const grains::Disc> disc,
                                      std::span<const base::Vec2> velocity);

/// Sets the flow's drag, carried, mobility and response. `kept`: of the porosity.
void put_grains(fluid::Flow& flow, std::span<const Load> load, std::span<const double> vertex_volume,
                std::span<const double> kept);

/// What the flow, solved, does to the grains.
struct Forces {
  std::vector<base::Vec2> drag, pressure;  ///< [N/m], (grains)
  Surroundings around;                     ///< found on the way
};
Forces forces_on(const Deposit& deposit, const fluid::Flow& flow, std::span<const double> vertex_volume,
                 std::span<const double> kept, const Suspended& grains);

}  // namespace seapile::coupling
