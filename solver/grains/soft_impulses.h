// Sub-stepped soft sequential impulses: the production method.
//
// One step: contacts are detected once (normals stay), then `substeps` times with h = dt/substeps
//   1. v += h g + (the contacts' velocity change of the sub-step before)          warm start, per body
//   2. one Gauss-Seidel sweep in the order of the colours: g > 0 may close but not overshoot, g < 0 is pushed apart as a
//      damped spring of frequency f and ratio zeta (Catto's soft constraint, Box2D v3)
//   3. x += h v
//
// For discs the local 2x2 problem is diagonal (tangential mass 1/3 of the normal one), so each contact is solved exactly.
// First order in h. Neglected: rolling resistance, the turning of normals within a step.
#pragma once

#include "solver/grains/contact_solver.h"

namespace seapile::grains {

/// integrate() for a law without `nonsmooth`.
template <class Real>
ContactReport integrate_softly(ContactSystem<Real>& system, Grains& grains, const Box& box, const ContactLaw& law,
                               RigidBody* body, std::span<const double> body_path, bool keep_impulses,
                               ContactTotals& totals, const Team& team, base::Profile& profile);

}  // namespace seapile::grains
