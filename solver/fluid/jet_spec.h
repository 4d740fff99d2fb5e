#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "solver/base/fields.h"
#include "solver/fluid/element.h"
#include "solver/fluid/free_surface.h"

namespace seapile::base {

template <>
struct EnumNames<fluid::Geometry> {
  static constexpr const char* values[] = {"planar", "axisymmetric"};
};
template <>
struct EnumNames<fluid::KinematicScheme> {
  static constexpr const char* values[] = {"upwinded", "galerkin", "differences"};
};

}  // namespace seapile::base

namespace seapile::fluid {

using base::between;
using base::Field;
using base::part;
using base::positive;
using base::SameAs;

/// The steady state itself, by Newton's method on flow and surface at once.
struct SteadyMethod {
  static constexpr const char* kName = "steady";
  friend bool operator==(const SteadyMethod&, const SteadyMethod&) = default;
};
void fields(auto&, SameAs<SteadyMethod> auto&) {}

/// A jet that develops in time, from flow as in the die everywhere.
struct TransientMethod {
  static constexpr const char* kName = "transient";
  double step = 0.005;     ///< [H/U]
  double duration = 100;   ///< [H/U]
  std::int64_t order = 2;  ///< of the scheme in time, 1 or 2
  KinematicScheme kinematic = KinematicScheme::upwinded;
  double tolerance = 1e-8;  ///< of the flow's equations [-]
  friend bool operator==(const TransientMethod&, const TransientMethod&) = default;
};
void fields(auto& visit, SameAs<TransientMethod> auto& method) {
  visit(Field{"step", "-", positive(10), "time step, in H/U"}, method.step);
  visit(Field{"duration", "-", positive(1e5), "time at which the run ends, in H/U"}, method.duration);
  visit(Field{"order", "-", between(1, 2), "order in time: implicit Euler or BDF2"}, method.order);
  visit(part("kinematic", "scheme of the surface: upwinded; or the thesis' galerkin or differences, explicit"),
        method.kinematic);
  visit(Field{"tolerance", "-", between(1e-13, 1e-2), "largest residual of the flow's equations"}, method.tolerance);
}

using JetMethod = std::variant<SteadyMethod, TransientMethod>;

/// Fluid that leaves a die: the thesis' stick-slip flow (ch. 3.4). Lengths in H, the die's radius or half gap;
/// velocities in U, the mean in the die; stresses in mu U/H.
struct JetSpec {
  Geometry geometry = Geometry::axisymmetric;
  double reynolds = 24;             ///< Re = 2 rho U H/mu [-]
  std::optional<double> capillary;  ///< Ca = mu U/gamma [-]; absent: no surface tension
  double upstream = 3.5;            ///< L_1, length of the die [H]
  double downstream = 20;           ///< L_2, length of the jet [H]
  double lip_size = 0.01;           ///< edges at the lip [H]
  double growth = 0.15;             ///< of the edges with the distance from the lip [-]
  double largest_size = 0.2;        ///< edges far from the lip [H]
  JetMethod method = SteadyMethod{};
  Convection convection = Convection::included;  ///< not written in a study: decided (scene/analysis.h)
  friend bool operator==(const JetSpec&, const JetSpec&) = default;
};
void fields(auto& visit, SameAs<JetSpec> auto& jet) {
  visit(part("geometry", "planar (a slit) or axisymmetric (a round die)"), jet.geometry);
  visit(Field{"reynolds", "-", between(0, 1000), "Reynolds number 2 rho U H/mu"}, jet.reynolds);
  visit(Field{"capillary", "-", between(0.01, 1e9), "capillary number mu U/gamma; null: no surface tension"},
        jet.capillary);
  visit(Field{"upstream", "-", between(0.5, 100), "length of the die, in H"}, jet.upstream);
  visit(Field{"downstream", "-", between(1, 1000), "length of the jet, in H"}, jet.downstream);
  visit(Field{"lip_size", "-", between(1e-5, 1), "size of the elements at the lip, in H"}, jet.lip_size);
  visit(Field{"growth", "-", between(0.01, 1), "growth of the elements with the distance from the lip"}, jet.growth);
  visit(Field{"largest_size", "-", between(0.005, 2), "size of the elements far from the lip, in H"}, jet.largest_size);
  visit(part("method", "steady; or transient, from flow as in the die everywhere"), jet.method);
}

}  // namespace seapile::fluid
