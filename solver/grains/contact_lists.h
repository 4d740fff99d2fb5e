// From places to coloured blocks: which grains may touch before the next rebuild, and in which lane each contact stands.
#pragma once

#include "solver/grains/contact_solver.h"

namespace seapile::grains {

/// Makes the neighbour list and the blocks anew from the grains' places; contacts that stay keep their impulses.
/// The same for any crew.
template <class Real>
void list_contacts(ContactSystem<Real>& system, Grains& grains, const Box& box, base::Crew* crew = nullptr);

/// Puts the points of the walls at the feet of their grains.
template <class Real>
void place_wall_points(const ContactSystem<Real>& system, Grains& grains, const Box& box);

}  // namespace seapile::grains
