#include "solver/coupling/drag_difelice1994.h"

#include <cmath>

#include "solver/coupling/drag_dallavalle1948.h"

namespace seapile::coupling {

double di_felice_exponent(double reynolds) {
  if (!(reynolds > 0)) return 3.7;
  const double decades = 1.5 - std::log10(reynolds);
  return 3.7 - 0.65 * std::exp(-0.5 * decades * decades);
}

double di_felice_drag(const fluid::Properties& fluid, double diameter, double porosity, double porosity_in_law,
                      double superficial_slip) {
  const double beta = di_felice_exponent(fluid.density * diameter * superficial_slip / fluid.viscosity);
  return 0.5 * diameter * sphere_resistance(fluid, diameter, superficial_slip) * porosity * porosity *
         std::pow(porosity_in_law, -(beta + 1));
}

}  // namespace seapile::coupling
