// Which drag the water exerts on a grain.
//
// A bed of discs has a plane porosity of about 0.18, where one of spheres has 0.4. Laws from beds of spheres with 0.18
// in them resist about 29 times as much. The porosity of the bed of spheres that is packed alike,
//   phi_3 = 1 - 2/sqrt(pi sqrt(3)) (1 - phi)^1.5
// (B. P. B. Hoomans et al., Chem. Eng. Sci. 51 (1996) 99-118), takes the densest discs to the densest spheres (0.2595)
// and water to water. With it, pressure drop and fluidisation are those of a bed of porosity phi_3.
#pragma once

#include <span>

#include "solver/coupling/coupling_spec.h"
#include "solver/fluid/element.h"

namespace seapile::coupling {

/// phi_3 [-].
double equivalent_porosity(double porosity);

/// gamma in F = gamma (v_f - v_i), the drag on a disc per metre of depth [kg/m/s]. `porosity`: phi of the plane at the
/// grain, > 0; `superficial_slip`: phi |v_f - v_i| [m/s].
double drag_coefficient(const DragSpec& law, const fluid::Properties& fluid, double diameter, double porosity,
                        double superficial_slip);

/// The same of many discs, each of them bit for bit.
void drag_coefficients(const DragSpec& law, const fluid::Properties& fluid, std::span<const double> diameter,
                       std::span<const double> porosity, std::span<const double> superficial_slip,
                       std::span<double> gamma);

}  // namespace seapile::coupling
