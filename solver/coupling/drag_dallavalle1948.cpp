#include "solver/coupling/drag_dallavalle1948.h"

#include <cmath>

namespace seapile::coupling {

double sphere_resistance(const fluid::Properties& fluid, double diameter, double superficial_slip) {
  const double root = 0.63 * std::sqrt(fluid.density * superficial_slip) + 4.8 * std::sqrt(fluid.viscosity / diameter);
  return root * root;
}

double dallavalle_drag(const fluid::Properties& fluid, double diameter, double porosity, double porosity_in_law,
                       double superficial_slip) {
  return 0.5 * diameter * sphere_resistance(fluid, diameter, superficial_slip) * porosity * porosity *
         std::pow(porosity_in_law, -4.8);
}

}  // namespace seapile::coupling
