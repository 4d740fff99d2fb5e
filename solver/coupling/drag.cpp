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

namespace {

/// Calls f(phi_d of phi, gamma) with what the law says they are.
auto with(const DragSpec& law, auto&& f) {
  const auto plane = [](double porosity) { return porosity; };
  const auto spheres = [](double porosity) { return equivalent_porosity(porosity); };
  const auto dallavalle = [](auto&&... a) { return dallavalle_drag(a...); };
  const auto di_felice = [](auto&&... a) { return di_felice_drag(a...); };
  if (law.closure == DragClosure::dallavalle)
    return law.porosity == DragPorosity::plane ? f(plane, dallavalle) : f(spheres, dallavalle);
  return law.porosity == DragPorosity::plane ? f(plane, di_felice) : f(spheres, di_felice);
}

}  // namespace

double drag_coefficient(const DragSpec& law, const fluid::Properties& fluid, double diameter, double porosity,
                        double superficial_slip) {
  return with(law, [&](auto&& in_law, auto&& gamma) {
    return gamma(fluid, diameter, porosity, in_law(porosity), superficial_slip);
  });
}

void drag_coefficients(const DragSpec& law, const fluid::Properties& fluid, std::span<const double> diameter,
                       std::span<const double> porosity, std::span<const double> superficial_slip,
                       std::span<double> gamma) {
  with(law, [&](auto&& in_law, auto&& gamma_of) {
    for (std::size_t i = 0; i < gamma.size(); ++i)
      gamma[i] = gamma_of(fluid, diameter[i], porosity[i], in_law(porosity[i]), superficial_slip[i]);
  });
}

}  // namespace seapile::coupling
