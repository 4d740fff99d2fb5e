// Non-smooth contact dynamics (Moreau 1988, Jean 1999): the thesis' method, for reference.
//
// One step of size dt, with normals and gaps at its start and v0 the velocities there:
//   1. v = v0 + dt g + (impulses of the last step) / m                             warm start
//   2. impulses p_n, p_t of all contacts such that at the step's end
//        0 <= p_n  _|_  v_n + b >= 0,      |p_t| <= mu p_n,  p_t = -mu p_n sign(v_t) where v_t /= 0
//      with b = g/dt, so that no gap is negative at the end; a contact that closes within the step and approached with
//      v_n0 leaves with at least -e v_n0:  b = min(g/dt, e v_n0)                    Newton's restitution
//   3. x += dt v
//
// The impulses are found by nonlinear Gauss-Seidel in the order of the blocks (NLGS): each contact is solved exactly,
// because for discs its problem is diagonal. Sweeps are sped up by Nesterov's momentum, which begins anew whenever a
// sweep changes more than the one before (O'Donoghue and Candes 2015); the fixed point is that of plain NLGS.
//
// First order in dt. The residual that is reported is the natural map's: what a solve of every contact by itself, from the
// final state, would still change. A finite number of sweeps leaves one; it biases a pile's resistance low.
// Neglected: rolling resistance, the turning of normals within a step. An impact is placed at the end of its step.
#pragma once

#include "solver/grains/contact_solver.h"

namespace seapile::grains {

/// integrate() for a law with `nonsmooth`.
template <class Real>
ContactReport integrate_rigidly(ContactSystem<Real>& system, Grains& grains, const Box& box, const ContactLaw& law,
                                RigidBody* body, std::span<const double> body_path, bool keep_impulses,
                                ContactTotals& totals, const Team& team, base::Profile& profile);

}  // namespace seapile::grains
