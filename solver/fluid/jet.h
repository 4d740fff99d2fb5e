// The domain of a jet from a die, its mesh and what holds at its boundary.
//
//   y=1  wall (u = 0) ---- lip, free surface ----------------------------
//   y=0  axis (v = 0, free of shear) -----------------------------------
//   x = -L1: developed flow, u = 2 (1 - y^2) (round) or 1.5 (1 - y^2) (slit), v = 0;  x = L2: v = 0, no normal stress
//
// Scaled: H = U = mu = 1, rho = Re/2, gamma = 1/Ca. Where a round film ends, its hoop tension acts on the outflow.
#pragma once

#include "solver/fluid/flow.h"
#include "solver/fluid/free_surface.h"
#include "solver/fluid/jet_spec.h"

namespace seapile::fluid {

enum JetSide : std::int32_t { kAxis = 0, kOutflow = 1, kJetSurface = 2, kDieWall = 3, kInflow = 4 };

struct Jet {
  Flow flow;
  FreeSurface surface;
};

/// A flat jet of fluid at rest, with its boundary values. Throws mesh::NoMesh.
Jet flat_jet(const JetSpec& spec);

/// Velocity of developed flow in the die [U].
double developed(Geometry geometry, double y);

/// Flux out of the fluid through the edges of a side, with the weight y when axisymmetric.
double flux_through(const Flow& flow, std::int32_t side);

/// Flux of fluid through the die [U H, U H2 per radian].
double die_flux(const JetSpec& spec);

}  // namespace seapile::fluid
