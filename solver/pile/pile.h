// The pile's geometry and motion.
#pragma once

#include "solver/base/segment.h"
#include "solver/pile/pile_spec.h"

namespace seapile::pile {

/// What a stretch of the pile's outline belongs to. A corner between tip and sleeve belongs to the tip.
enum Feature : std::int32_t { kTip = 0, kSleeve = 1 };

/// Height of the tip above its apex: R / tan(alpha/2); 0 for a flat one [m].
double tip_height(const PileSpec& pile);

/// Tip and sleeve with the apex (flat: the middle of the face) at the origin, anticlockwise from the left sleeve down and
/// up the right one; the sleeve ends `length` [m] above the apex.
std::vector<base::Segment> outline(const PileSpec& pile, double length);

/// Downward path of the pile from 0 to t [m].
double path(const Driving& driving, double t);

/// Downward velocity at t [m/s].
double velocity(const Driving& driving, double t);

/// Largest speed ever reached [m/s].
double largest_speed(const Driving& driving);

/// Time at which the path first reaches `depth` > 0 [s]; infinity when it never does.
double time_to_reach(const Driving& driving, double depth);

}  // namespace seapile::pile
