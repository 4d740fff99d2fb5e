#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/base/aligned.h"
#include "solver/base/vec2.h"

namespace seapile::grains {

/// Place and size of a disc, as the contact detection gathers it: 32 B.
struct Disc {
  double x = 0;       ///< [m]
  double y = 0;       ///< [m], upwards
  double radius = 0;  ///< r_p [m]
  double unused = 0;
};

/// The grains in the solver's order: along a Hilbert curve, so that neighbours in space are neighbours in memory and a run
/// of them is a compact tile, in which grains next to other threads' come first. The order is made once from (place, id); no result depends on the order of the input.
struct Grains {
  std::vector<std::int64_t> id;      ///< the user's name of each grain, (count)
  base::AlignedVector<Disc> disc;    ///< place and radius, (count)
  std::vector<double> mass;          ///< rho_p pi r^2 [kg/m], (count)
  std::vector<base::Vec2> push;  ///< acceleration by forces besides gravity and contacts [m/s2], (count); empty: none

  std::size_t count() const { return id.size(); }
};

/// Motion of a body as the contact solver gathers it.
template <class Real>
struct alignas(4 * sizeof(Real)) Motion {
  Real vx = 0;            ///< [m/s]
  Real vy = 0;            ///< [m/s]
  Real u = 0;             ///< r omega, the surface speed of the spin [m/s], positive anticlockwise
  Real inverse_mass = 0;  ///< [m/kg]; 0: unmoved by contacts
};

/// Path of a body since the start of the step [m].
template <class Real>
struct alignas(4 * sizeof(Real)) Drift {
  Real dx = 0;
  Real dy = 0;
  Real du = 0;  ///< of its surface by spin
  Real unused = 0;
};

/// Four bodies. A vector register holds a row of them, and one address serves a body's motion and drift.
template <class Real>
struct alignas(64) BodyGroup {
  Motion<Real> motion[4];
  Drift<Real> drift[4];
};

/// What the start of a sub-step needs to know of a body: its velocity one sub-step ago (at the start of a step: the
/// velocity change by the kept impulses), and half its mass [kg/m].
template <class Real>
struct alignas(4 * sizeof(Real)) Before {
  Real vx = 0, vy = 0, u = 0, half_mass = 0;
};

/// A body's acceleration by forces besides gravity and contacts, as the kernels load it [m/s2].
template <class Real>
struct alignas(4 * sizeof(Real)) Push {
  Real x = 0, y = 0, unused[2] = {};
};

/// Where a body's motion begins in an array of groups, counted in numbers, and back.
inline std::int32_t place_of(std::int32_t body) { return body / 4 * 32 + body % 4 * 4; }
inline std::int32_t body_at(std::int32_t place) { return place / 32 * 4 + place % 32 / 4; }

}  // namespace seapile::grains
