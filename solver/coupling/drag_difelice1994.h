// Drag of the water on a grain among others, with an exponent of the porosity that knows the Reynolds number.
//
//   F = 1/2 rho C_d d |U| U phi_d^-beta (phi/phi_d),   beta = 3.7 - 0.65 exp(-(1.5 - log10 Re)^2/2)      [N/m]
//   C_d = (0.63 + 4.8/sqrt(Re))^2,   Re = rho d |U|/mu,   U = phi (v_f - v_i)
//
// R. Di Felice, The voidage function for fluid-particle interaction systems, Int. J. Multiphase Flow 20 (1994) 153-159.
// F is his drag: the share phi of the whole fluid force, which is F/phi = 1/2 rho C_d d |U| U phi_d^-(beta+1).
// phi/phi_d is 1 where both are the porosity of the plane, and otherwise hands the grain the force that a packing of
// porosity phi_d has although the fluid's equations divide by phi (drag.h). Written as F = gamma (v_f - v_i),
//   gamma = 1/2 rho C_d d |U| phi^2 phi_d^-(beta+1)      [kg/m/s].
//
// Neglected: as in drag_dallavalle1948.h.
#pragma once

#include "solver/fluid/element.h"

namespace seapile::coupling {

/// beta [-], between 3.05 (at Re = 10^1.5) and 3.7.
double di_felice_exponent(double reynolds);

/// gamma [kg/m/s]; diameter d [m], |U| [m/s].
double di_felice_drag(const fluid::Properties& fluid, double diameter, double porosity, double porosity_in_law,
                      double superficial_slip);

}  // namespace seapile::coupling
