#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <variant>

#include "solver/base/fields.h"

namespace seapile::pile {

using base::between;
using base::Field;
using base::part;
using base::positive;
using base::SameAs;

/// A cone (in the plane: a wedge); thesis ch. 6.1.
struct ConicalTip {
  static constexpr const char* kName = "conical";
  double apex_angle = std::numbers::pi / 3;  ///< alpha [rad], full angle at the apex
  friend bool operator==(const ConicalTip&, const ConicalTip&) = default;
};
void fields(auto& visit, SameAs<ConicalTip> auto& tip) {
  visit(Field{"apex_angle", "rad", between(std::numbers::pi / 18, std::numbers::pi), "full angle alpha at the apex"},
        tip.apex_angle);
}

/// A plane face of width 2R.
struct FlatTip {
  static constexpr const char* kName = "flat";
  friend bool operator==(const FlatTip&, const FlatTip&) = default;
};
void fields(auto&, SameAs<FlatTip> auto&) {}

using Tip = std::variant<ConicalTip, FlatTip>;

/// v(t) = speed.
struct ConstantDriving {
  static constexpr const char* kName = "constant";
  double speed = 0.06;  ///< V [m/s], positive down
  friend bool operator==(const ConstantDriving&, const ConstantDriving&) = default;
};
void fields(auto& visit, SameAs<ConstantDriving> auto& driving) {
  visit(Field{"speed", "m/s", between(-10, 10), "speed V, positive down"}, driving.speed);
}

/// v(t) = speed sin(2 pi frequency t).
struct SinusoidalDriving {
  static constexpr const char* kName = "sinusoidal";
  double speed = 0.2;      ///< largest speed [m/s]
  double frequency = 0.1;  ///< f [Hz]
  friend bool operator==(const SinusoidalDriving&, const SinusoidalDriving&) = default;
};
void fields(auto& visit, SameAs<SinusoidalDriving> auto& driving) {
  visit(Field{"speed", "m/s", between(-10, 10), "largest speed, positive: down first"}, driving.speed);
  visit(Field{"frequency", "Hz", positive(1000), "frequency f"}, driving.frequency);
}

/// v(t) = speed + 2 pi frequency amplitude sin(2 pi frequency t).
struct VibratoryDriving {
  static constexpr const char* kName = "vibratory";
  double speed = 0.06;      ///< mean speed [m/s]
  double amplitude = 1e-3;  ///< of the displacement [m]
  double frequency = 20;    ///< f [Hz]
  friend bool operator==(const VibratoryDriving&, const VibratoryDriving&) = default;
};
void fields(auto& visit, SameAs<VibratoryDriving> auto& driving) {
  visit(Field{"speed", "m/s", between(-10, 10), "mean speed, positive down"}, driving.speed);
  visit(Field{"amplitude", "m", between(0, 0.5), "amplitude of the displacement"}, driving.amplitude);
  visit(Field{"frequency", "Hz", positive(1000), "frequency f"}, driving.frequency);
}

using Driving = std::variant<ConstantDriving, SinusoidalDriving, VibratoryDriving>;

/// The driven pile: a rigid body whose vertical motion is prescribed (thesis ch. 6.1).
/// It stands in the middle of the box and starts above the highest grain under it.
struct PileSpec {
  double radius = 0.125;           ///< R [m], half-width
  double friction = 0.5;           ///< mu_p-pile [-]
  Tip tip = ConicalTip{};          ///< shape of the tip
  Driving driving = ConstantDriving{};
  std::optional<double> depth = 1.2;     ///< d [m] at which the run ends; absent: not ended by depth
  std::optional<double> duration = {};   ///< [s] after which the run ends; absent: not ended by time
  friend bool operator==(const PileSpec&, const PileSpec&) = default;
};
void fields(auto& visit, SameAs<PileSpec> auto& pile) {
  visit(Field{"radius", "m", positive(100), "half-width R"}, pile.radius);
  visit(Field{"friction", "-", between(0, 10), "Coulomb coefficient between grain and pile"}, pile.friction);
  visit(part("tip", "shape of the tip"), pile.tip);
  visit(part("driving", "how the pile moves"), pile.driving);
  visit(Field{"depth", "m", positive(1000), "depth d of the tip at which the run ends; null: no such end"}, pile.depth);
  visit(Field{"duration", "s", positive(1e6), "time after which the run ends; null: no such end"}, pile.duration);
}

}  // namespace seapile::pile
