#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/segment.h"

namespace seapile::grains {

/// A contact between a grain and the rigid body.
struct BodyContact {
  std::int32_t grain = 0;
  std::int32_t feature = 0;
  double nx = 0, ny = 0;  ///< normal from the grain to the body
  double gap = 0;         ///< at the start of the step [m]
  double pn = 0, pt = 0;            ///< impulses of the last sub-step [N s/m]
  double step_pn = 0, step_pt = 0;  ///< summed over the sub-steps of the last step [N s/m]
  // Of the non-smooth method, within a step.
  double bias = 0;                  ///< v_n + bias >= 0 is asked for [m/s]
  double old_pn = 0, old_pt = 0;    ///< impulses one sweep ago [N s/m]
};

/// A convex body that many grains touch at once. Its contacts share it, so they cannot be coloured: they are solved one
/// after the other, after the blocks, and each leaves its impulse on the body. A prescribed motion is a body of inverse
/// mass 0 whose velocity is set at each sub-step; a free one has a mass and is moved by its contacts, gravity and force.
struct RigidBody {
  std::vector<base::Segment> outline;  ///< closed but for the top, anticlockwise
  double friction = 0;        ///< Coulomb coefficient of its contacts
  double inverse_mass = 0;    ///< [m/kg]; 0: prescribed
  base::Vec2 force;           ///< on a free body, besides gravity and contacts [N/m]
  base::Vec2 position;        ///< of the body's frame [m]
  base::Vec2 velocity;        ///< [m/s]
  base::Vec2 moved;           ///< path since the start of the step; zero between steps [m]

  std::vector<BodyContact> contact;  ///< candidates, by rising grain
  double listed_travel = 0;          ///< path since the candidates were listed [m]
};

}  // namespace seapile::grains
