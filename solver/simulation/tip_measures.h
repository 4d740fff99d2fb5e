// What a frame says of the grains under the tip: numbers that two tips, speeds or fluids can be compared by.
// Definitions are in docs/formulation.md 3. They become metrics named after the frame's depth.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "solver/base/fields.h"
#include "solver/base/vec2.h"
#include "solver/grains/fields_on_grid.h"
#include "solver/simulation/array.h"
#include "solver/simulation/flow_record.h"
#include "solver/simulation/run.h"

namespace seapile::simulation {

/// The way of the pile over which a frame judges how the grains move [m].
inline constexpr double kMotionTravel = 5e-3;

/// Of one frame. What cannot be said of it is NaN.
struct TipMeasures {
  static constexpr double kAbsent = FlowRecord::kAbsent;
  double asked = 0;                                                  ///< the frame's depth [m]
  double nose_cone = kAbsent;                                        ///< [-]
  double set_in_motion = kAbsent;                                    ///< [-]
  double lateral_motion = kAbsent;                                   ///< [-]
  double stress_under_tip = kAbsent;                                 ///< [Pa]
  double vertical_stress_share = kAbsent;                            ///< [-]
  double strong_force_verticality = kAbsent;                         ///< [-]
  double contact_force_mean = kAbsent, contact_force_p95 = kAbsent;  ///< [N/m]
};

/// visit(name, unit, meaning, member), without `asked`.
void columns(auto&& visit, base::SameAs<TipMeasures> auto& m) {
  visit("nose_cone", "-", "share of the grains in the triangle below the tip that move with the pile", m.nose_cone);
  visit("set_in_motion", "-", "grains that move by more than 0.1 of the pile's last 5 mm", m.set_in_motion);
  visit("lateral_motion", "-", "sum |dx| over sum |dy| of the grains set in motion", m.lateral_motion);
  visit("stress_under_tip", "Pa", "95th percentile of the major principal stress within 2R below the tip",
        m.stress_under_tip);
  visit("vertical_stress_share", "-", "mean of sigma_yy / (sigma_xx + sigma_yy) within 2R below the tip",
        m.vertical_stress_share);
  visit("strong_force_verticality", "-", "sum f n_y^2 / sum f of the strong contacts within 4R below the tip",
        m.strong_force_verticality);
  visit("contact_force_mean", "N/m", "mean normal force of the contacts of two grains", m.contact_force_mean);
  visit("contact_force_p95", "N/m", "95th percentile of the normal forces of two grains", m.contact_force_p95);
}

/// The lowest point of a pile's tip, and the pile's half-width R.
struct TipPlace {
  base::Vec2 lowest;  ///< [m]
  double radius = 0;  ///< [m]
};

/// Where grains and tip were some way of the pile ago.
struct PlacesBefore {
  double tip = 0;                 ///< height of its lowest point [m]
  std::vector<base::Vec2> grain;  ///< [m], (grains)
};

/// Those of the motion since `before`; absent when the pile has gone less than kMotionTravel down since then.
void measure_motion(TipMeasures& measures, std::span<const grains::Disc> discs, const PlacesBefore& before,
                    const TipPlace& tip);

/// Those of stress and forces, from a frame's contacts.
void measure_forces(TipMeasures& measures, std::span<const grains::ContactForce> contacts,
                    std::span<const grains::Disc> discs, const grains::Box& box, const TipPlace& tip);

/// What a run has measured so far, and the places that its coming frames compare with, in the frames' order. Beside the
/// state in a checkpoint, because it depends on what is recorded.
struct Measuring {
  std::vector<TipMeasures> taken;
  std::vector<PlacesBefore> open;
};

/// As arrays whose names begin with "measures/"; none when nothing was measured.
std::vector<Array> arrays_of(const Measuring& measuring);

/// Takes these arrays out of a checkpoint's. Throws std::invalid_argument when they do not fit each other.
Measuring take_out(std::vector<Array>& checkpoint);

/// One metric per number that is there, named "<name>_<depth>".
std::vector<Metric> metrics_of(std::span<const TipMeasures> taken);

/// A depth in a metric's name: "0.20", "0.125"; to 0.1 mm.
std::string depth_text(double depth);

}  // namespace seapile::simulation
