#include "solver/coupling/drag.h"

#include <cmath>
#include <numbers>

#include "solver/coupling/drag_dallavalle1948.h"
#include "solver/coupling/drag_difelice1994.h"

namespace seapile::coupling {

double equivalent_porosity(double porosity) {
  const double solid = 1 - porosity;
  return 1 - 2 / std::sqrt(std::numbers::pi * std::numbers::sqrt3) * solid * std::sqrt(solid);
}

double drag_coefficient(const DragSpec& law, const fluid::Properties& fluid, double diameter, double porosity,
                        double superficial_slip) {
  const double in_law = law.porosity == DragPorosity::plane ? porosity : equivalent_porosity(porosity);
  return law.closure == DragClosure::dallavalle
             ? dallavalle_drag(fluid, diameter, porosity, in_law, superficial_slip)
             : di_felice_drag(fluid, diameter, porosity, in_law, superficial_slip);
}

}  // namespace seapile::coupling
