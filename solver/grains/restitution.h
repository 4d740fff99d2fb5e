// Newton's restitution: after a step, a contact that closed during it leaves with e times its speed of approach.
//
// Catto's scheme: sub-steps solve with e = 0, then one pass adds the impulse (1/(1/m_i + 1/m_j)) (v_n + e v_n,approach)
// to each contact that approached faster than gravity and push can make it within two steps, and friction up to mu
// times that impulse. Not solved together with its neighbours: exact for single impacts, approximate for simultaneous
// ones.
#pragma once

#include "solver/grains/contact_solver.h"

namespace seapile::grains {

/// Keeps the approach speeds at the start of a step, after detection. `body_velocity`: of the body in this step.
template <class Real>
void remember_approach(ContactSystem<Real>& system, const RigidBody* body, base::Vec2 body_velocity);

/// The pass after the sub-steps. `pull`: of gravity and push [m/s2].
template <class Real>
void rebound(ContactSystem<Real>& system, const Grains& grains, const ContactLaw& law, double pull, RigidBody* body,
             ContactTotals& totals);

}  // namespace seapile::grains
