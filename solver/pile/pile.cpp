#include "solver/pile/pile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace seapile::pile {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;  // without which clang 14 does not find it

constexpr double kTurn = 2 * std::numbers::pi;

/// First time in [early, late] at which a path that only rises there has the depth.
double halve(const Driving& driving, double depth, double early, double late) {
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (early + late);
    (path(driving, middle) < depth ? early : late) = middle;
  }
  return late;
}

/// The path rises to a crest in each period, where sin(2 pi f t) = -V / (2 pi f a); the first crest that is as deep as
/// asked for ends the rise in which the depth is first reached.
double time_to_reach_vibrating(const VibratoryDriving& d, double depth) {
  const double never = std::numeric_limits<double>::infinity();
  const double share = d.amplitude > 0 ? d.speed / (kTurn * d.frequency * d.amplitude) : d.speed > 0 ? 2.0 : -2.0;
  if (share <= -1) return never;
  if (share >= 1) return halve(d, depth, 0, depth / d.speed);

  const double period = 1 / d.frequency;
  const double first_crest = (std::numbers::pi + std::asin(share)) / (kTurn * d.frequency);
  const double top = path(d, first_crest);
  double crests = 0;
  if (top < depth) {
    if (d.speed <= 0) return never;
    crests = std::ceil((depth - top) / (d.speed * period));
    while (path(d, first_crest + crests * period) < depth) ++crests;  // by rounding at most once
  }
  // The rise begins at the trough before the crest, as far before the period's end as the crest is behind its middle.
  const double trough = crests * period - std::asin(share) / (kTurn * d.frequency);
  return halve(d, depth, std::max(0.0, trough), first_crest + crests * period);
}

}  // namespace

double tip_height(const PileSpec& pile) {
  return std::visit(Overloaded{[&](const ConicalTip& tip) { return pile.radius / std::tan(tip.apex_angle / 2); },
                               [](const FlatTip&) { return 0.0; }},
                    pile.tip);
}

std::vector<base::Segment> outline(const PileSpec& pile, double length) {
  const double R = pile.radius, h = tip_height(pile);
  const base::Vec2 left_top{-R, length}, left{-R, h}, right{R, h}, right_top{R, length};
  std::vector<base::Segment> segments{{left_top, left, kSleeve}};
  if (std::holds_alternative<ConicalTip>(pile.tip)) {
    const base::Vec2 apex{0, 0};
    segments.push_back({left, apex, kTip});
    segments.push_back({apex, right, kTip});
  } else {
    segments.push_back({left, right, kTip});
  }
  segments.push_back({right, right_top, kSleeve});
  return segments;
}

double path(const Driving& driving, double t) {
  return std::visit(Overloaded{[&](const ConstantDriving& d) { return d.speed * t; },
                               [&](const SinusoidalDriving& d) {
                                 return d.speed / (kTurn * d.frequency) * (1 - std::cos(kTurn * d.frequency * t));
                               },
                               [&](const VibratoryDriving& d) {
                                 return d.speed * t + d.amplitude * (1 - std::cos(kTurn * d.frequency * t));
                               }},
                    driving);
}

double velocity(const Driving& driving, double t) {
  return std::visit(
      Overloaded{[&](const ConstantDriving& d) { return d.speed; },
                 [&](const SinusoidalDriving& d) { return d.speed * std::sin(kTurn * d.frequency * t); },
                 [&](const VibratoryDriving& d) {
                   return d.speed + kTurn * d.frequency * d.amplitude * std::sin(kTurn * d.frequency * t);
                 }},
      driving);
}

double largest_speed(const Driving& driving) {
  return std::visit(
      Overloaded{[](const ConstantDriving& d) { return std::abs(d.speed); },
                 [](const SinusoidalDriving& d) { return std::abs(d.speed); },
                 [](const VibratoryDriving& d) { return std::abs(d.speed) + kTurn * d.frequency * d.amplitude; }},
      driving);
}

double time_to_reach(const Driving& driving, double depth) {
  const double never = std::numeric_limits<double>::infinity();
  return std::visit(
      Overloaded{[&](const ConstantDriving& d) { return d.speed > 0 ? depth / d.speed : never; },
                 [&](const SinusoidalDriving& d) {
                   const double share = 1 - depth * kTurn * d.frequency / d.speed;
                   return d.speed > 0 && share >= -1 ? std::acos(share) / (kTurn * d.frequency) : never;
                 },
                 [&](const VibratoryDriving& d) { return time_to_reach_vibrating(d, depth); }},
      driving);
}

}  // namespace seapile::pile
