// How grains and water act on each other: what a scene may say about it.
#pragma once

#include <optional>

#include "solver/base/fields.h"

namespace seapile::coupling {

using base::between;
using base::Field;
using base::part;
using base::positive;
using base::SameAs;

/// How a grain's area is shared out among the vertices of the mesh.
enum class Kernel {
  disc,  ///< the hat functions' integrals over the grain: smooth as a grain passes from triangle to triangle
  hat,   ///< the hat functions' values at its centre, of the literature: pressure is kicked at each edge
};

/// Which law a grain's drag follows.
enum class DragClosure {
  dallavalle,  ///< C_d of Dallavalle (1948), phi^-1.8 as the thesis' code has it
  di_felice,   ///< C_d of Dallavalle, the exponent of Di Felice (1994)
};

/// Which porosity stands in the law of drag. Volumes are always those of the plane.
enum class DragPorosity {
  equivalent,  ///< that of spheres packed as densely as the discs are (Hoomans et al. 1996)
  plane,       ///< the discs' own: three times as dense a bed, as in the thesis
};

/// How fluid and grains are advanced together.
enum class Scheme {
  once,                 ///< the fluid with the grains' predicted answer, then the grains
  predictor_corrector,  ///< twice, the second time with what the grains did in the first
};

}  // namespace seapile::coupling

namespace seapile::base {

template <>
struct EnumNames<coupling::Kernel> {
  static constexpr const char* values[] = {"disc", "hat"};
};
template <>
struct EnumNames<coupling::DragClosure> {
  static constexpr const char* values[] = {"dallavalle", "di_felice"};
};
template <>
struct EnumNames<coupling::DragPorosity> {
  static constexpr const char* values[] = {"equivalent", "plane"};
};
template <>
struct EnumNames<coupling::Scheme> {
  static constexpr const char* values[] = {"once", "predictor_corrector"};
};

}  // namespace seapile::base

namespace seapile::coupling {

struct DragSpec {
  DragClosure closure = DragClosure::dallavalle;
  DragPorosity porosity = DragPorosity::equivalent;
  friend bool operator==(const DragSpec&, const DragSpec&) = default;
};
void fields(auto& visit, SameAs<DragSpec> auto& drag) {
  visit(part("closure", "the law: dallavalle (with phi^-1.8) or di_felice"), drag.closure);
  visit(part("porosity", "in the law: equivalent (of spheres, 3-D) or plane (of the discs)"), drag.porosity);
}

struct PorositySpec {
  Kernel kernel = Kernel::disc;
  double least = 0.1;  ///< phi is not smaller than this; what is cut off is recorded [-]
  friend bool operator==(const PorositySpec&, const PorositySpec&) = default;
};
void fields(auto& visit, SameAs<PorositySpec> auto& porosity) {
  visit(part("kernel", "how a grain is shared out among vertices: disc (smooth) or hat (of the literature)"),
        porosity.kernel);
  visit(Field{"least", "-", between(0.01, 0.5), "smallest porosity; what is cut off is recorded"}, porosity.least);
}

struct CouplingSpec {
  DragSpec drag;
  PorositySpec porosity;
  Scheme scheme = Scheme::once;
  friend bool operator==(const CouplingSpec&, const CouplingSpec&) = default;
};
void fields(auto& visit, SameAs<CouplingSpec> auto& coupling) {
  visit(part("drag", "of the fluid on the grains"), coupling.drag);
  visit(part("porosity", "of the grains in the fluid"), coupling.porosity);
  visit(part("scheme", "once, or predictor_corrector: fluid and grains are advanced twice"), coupling.scheme);
}

}  // namespace seapile::coupling
