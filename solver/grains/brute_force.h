// The reference: every grain against every other, in natural order, in double; no list, colour, block or thread.
//
// Same laws and same signature as contact_solver.h, by either method, in the most obvious way: natural order is, for each
// grain, its pairs with later grains, the walls left, right and base, and the rigid body. The non-smooth method sweeps
// without momentum. Cost per sweep grows with the square of the count: for some hundred grains, to compare with.
#pragma once

#include <span>
#include <vector>

#include "solver/grains/contact_solver.h"

namespace seapile::grains {

/// A contact that carried an impulse in the last step.
struct KeptContact {
  std::int32_t first = 0, second = 0;  ///< as in TouchingContact; of the rigid body always -4
  double pn = 0, pt = 0;               ///< impulses of the last sub-step [N s/m]
};

struct AllPairs {
  // State.
  std::vector<Motion<double>> body;  ///< (count)
  std::vector<KeptContact> kept;     ///< in natural order

  // Derived.
  std::vector<TouchingContact> touching;  ///< of the last step, which had an impulse, in natural order
  OverlapStatistics overlap;              ///< of the last step
  double smallest_radius = 0;
  std::int64_t rebuilds = 0;  ///< of lists: there are none

  Motion<double>& motion(std::int32_t grain) { return body[grain]; }
  const Motion<double>& motion(std::int32_t grain) const { return body[grain]; }
};

/// Places grains in the system: motion at rest.
void enclose(AllPairs& system, Grains& grains);

/// integrate() of contact_solver.h. Nothing is shared out: `team` is not asked.
ContactReport integrate(AllPairs& system, Grains& grains, const Box& box, const ContactLaw& law, RigidBody* body,
                        std::span<const double> body_path, bool keep_impulses, ContactTotals& totals, const Team& team,
                        base::Profile& profile);

std::vector<TouchingContact> touching_contacts(const AllPairs& system, const Grains& grains, const RigidBody* body);
Energy energy(const AllPairs& system, const Grains& grains, double gravity, double base, base::Crew* crew = nullptr);
OverlapStatistics overlaps(const AllPairs& system, const Grains& grains, const RigidBody* body, base::Crew* crew = nullptr);

}  // namespace seapile::grains
