// Drag of the water on a grain among others, with the sphere's drag coefficient of Dallavalle.
//
//   F = gamma (v_f - v_i),   gamma = 1/2 rho C_d d |U| phi^2 phi_d^-4.8      [N/m, kg/m/s]
//   C_d = (0.63 + 4.8/sqrt(Re))^2,   Re = rho d |U|/mu,   U = phi (v_f - v_i)
//
// J. M. Dallavalle, Micromeritics, 2nd ed., Pitman, New York 1948: C_d of a single sphere, from creeping flow to
// Re = 2e5. The exponent is that of J. F. Richardson and W. N. Zaki, Trans. Inst. Chem. Eng. 32 (1954) 35-53: a swarm
// falls with U_t phi^n. The pressure gradient adds to F what makes F/phi of it (the fluid's momentum equation has the
// full grad p), and F/phi = 1/2 rho C_d d U^2 phi_d^-4.8 gives n = 4.8 in creeping flow and n = 2.4 in fast flow, with
// one exponent for both.
//
// phi is the porosity of the plane, by which the fluid's equations divide. phi_d is the one that the law means: the
// same, F = phi^-1.8 1/2 rho C_d d |v_r| v_r with v_r = v_f - v_i and Re = phi d |v_r| rho/mu, or that of a packing of
// spheres (drag.h).
//
// Neglected: the disc has a sphere's C_d, with the area d per metre of depth in place of pi d^2/4. Added mass, history
// and lift; the random motion of grains; shapes other than round.
#pragma once

#include <cmath>

#include "solver/coupling/inverse_fifth_root.h"
#include "solver/fluid/element.h"

namespace seapile::coupling {

/// rho C_d |U| of a sphere [kg/m2/s]. Finite for U -> 0 (23.04 mu/d) and for rho -> 0.
inline double sphere_resistance(const fluid::Properties& fluid, double diameter, double superficial_slip) {
  const double root = 0.63 * std::sqrt(fluid.density * superficial_slip) + 4.8 * std::sqrt(fluid.viscosity / diameter);
  return root * root;
}

/// gamma [kg/m/s]; diameter d [m], |U| [m/s].
inline double dallavalle_drag(const fluid::Properties& fluid, double diameter, double porosity, double porosity_in_law,
                              double superficial_slip) {
  return 0.5 * diameter * sphere_resistance(fluid, diameter, superficial_slip) * porosity * porosity *
         power_minus_4_8(porosity_in_law);
}

}  // namespace seapile::coupling
