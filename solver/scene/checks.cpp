#include "solver/scene/checks.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <variant>

#include "solver/scene/validate.h"

namespace seapile::scene {
namespace {

using base::Problems;
using std::numbers::pi;

// Steps per period below which a vibration is not the one that was asked for.
constexpr double kFewestStepsPerPeriod = 10;

Motion motion_of(const pile::ConstantDriving& drive, double time) {
  const double way = drive.speed * time;
  return {std::max(0.0, way), std::max(0.0, -way), std::abs(way)};
}

Motion motion_of(const pile::SinusoidalDriving& drive, double time) {
  const double half_period = std::min(time, 0.5 / drive.frequency);
  const double stroke =
      drive.speed / (2 * pi * drive.frequency) * (1 - std::cos(2 * pi * drive.frequency * half_period));
  return {std::max(0.0, stroke), std::max(0.0, -stroke), std::abs(drive.speed) * time};
}

Motion motion_of(const pile::VibratoryDriving& drive, double time) {
  const double way = drive.speed * time;
  return {std::max(0.0, way) + 2 * drive.amplitude, std::max(0.0, -way),
          std::abs(way) + 4 * drive.amplitude * drive.frequency * time};
}

}  // namespace

std::string text(double number) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, number, std::chars_format::general, 6).ptr};
}

std::string text(double number, const char* unit) { return text(number) + " " + unit; }

Motion motion(const pile::Driving& driving, double time) {
  return std::visit([&](const auto& drive) { return motion_of(drive, time); }, driving);
}

double duration(const pile::PileSpec& pile) {
  double time = pile.duration.value_or(std::numeric_limits<double>::infinity());
  if (!pile.depth) return time;
  if (const double speed = mean_speed(pile.driving); speed > 0) time = std::min(time, *pile.depth / speed);
  if (const auto* sine = std::get_if<pile::SinusoidalDriving>(&pile.driving); sine && sine->speed > 0) {
    if (sine->speed / (pi * sine->frequency) >= *pile.depth) time = std::min(time, 0.5 / sine->frequency);
  }
  return time;
}

double mean_speed(const pile::Driving& driving) {
  if (std::holds_alternative<pile::SinusoidalDriving>(driving)) return 0;
  if (const auto* constant = std::get_if<pile::ConstantDriving>(&driving)) return constant->speed;
  return std::get<pile::VibratoryDriving>(driving).speed;
}

double largest_speed(const pile::Driving& driving) {
  if (const auto* constant = std::get_if<pile::ConstantDriving>(&driving)) return std::abs(constant->speed);
  if (const auto* sine = std::get_if<pile::SinusoidalDriving>(&driving)) return std::abs(sine->speed);
  const auto& vibratory = std::get<pile::VibratoryDriving>(driving);
  return std::abs(vibratory.speed) + 2 * pi * vibratory.frequency * vibratory.amplitude;
}

double tip_height(double radius, const pile::Tip& tip) {
  const auto* cone = std::get_if<pile::ConicalTip>(&tip);
  return cone ? radius / std::tan(cone->apex_angle / 2) : 0;
}

std::string driving_pointer(const std::string& pointer, const pile::Driving& driving, const char* key) {
  const char* name = std::visit([](const auto& drive) { return std::decay_t<decltype(drive)>::kName; }, driving);
  return pointer + "/" + name + "/" + key;
}

void check_period(const pile::Driving& driving, double step, const std::string& pointer, Problems& problems) {
  double frequency = 0;
  if (const auto* sine = std::get_if<pile::SinusoidalDriving>(&driving)) frequency = sine->frequency;
  if (const auto* vibratory = std::get_if<pile::VibratoryDriving>(&driving)) frequency = vibratory->frequency;
  if (frequency * step * kFewestStepsPerPeriod <= 1) return;
  problems.push_back({driving_pointer(pointer, driving, "frequency"),
                      "has fewer than 10 steps of " + text(step, "s") + " per period",
                      "at most " + text(1 / (kFewestStepsPerPeriod * step), "Hz"), ""});
}

void check_frames(const std::vector<double>& frames, double most, const FrameWords& words, Problems& problems) {
  const std::string list = std::string("/") + words.key, one = words.singular;
  if (frames.size() > kMostFrames) {
    problems.push_back({list, "has " + std::to_string(frames.size()) + " " + one + "s", "at most 10000", ""});
    return;
  }
  std::set<double> seen;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::string pointer = list + "/" + std::to_string(i);
    if (frames[i] > most) problems.push_back({pointer, words.beyond, "at most " + text(most, words.unit), ""});
    if (!seen.insert(frames[i]).second) problems.push_back({pointer, kTwice, "each " + one + " once", ""});
  }
}

}  // namespace seapile::scene
