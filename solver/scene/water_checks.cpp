#include "solver/scene/water_checks.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <variant>

#include "solver/scene/checks.h"

namespace seapile::scene {
namespace {

using base::Problems;
using basin::SurfaceSpec;

// Shares of the depth that stay between the pile's shoulder and the surface at rest, which would flood it otherwise,
// and between its tip and the bottom, where the mesh would have no room.
constexpr double kLeastOverShoulder = 1e-3;
constexpr double kLeastUnderTip = 1e-2;
// A wave whose half has fewer columns than these is not the one that was asked for.
constexpr double kFewestColumns = 4;
// Lowest value of sin(s)/s, and where it is.
constexpr double kLowestHump = -0.21723362821122166;
constexpr double kPlaceOfLowestHump = 4.4934094579090642;

/// What lifts the surface at the start, per metre of its amplitude: the lowest and the highest.
struct Shape {
  double lowest = 0, highest = 0;
};

Shape shape_of(const basin::FlatSurface&, double) { return {}; }

Shape shape_of(const basin::HumpSurface& hump, double width) {
  const double end = width / (2 * hump.width);
  return {end < kPlaceOfLowestHump ? std::sin(end) / end : kLowestHump, 1};
}

Shape shape_of(const basin::CosineSurface&, double) { return {-1, 1}; }

double amplitude_of(const basin::FlatSurface&) { return 0; }
double amplitude_of(const auto& wave) { return wave.amplitude; }

/// Lowest height of the surface above the rest level at the start [m].
double lowest_start(const basin::InitialSurface& initial, double width) {
  return std::visit(
      [&](const auto& wave) {
        const Shape shape = shape_of(wave, width);
        const double amplitude = amplitude_of(wave);
        return std::min(amplitude * shape.lowest, amplitude * shape.highest);
      },
      initial);
}

void check_start(const SurfaceSpec& surface, const WaterBox& water, const std::string& pointer, Problems& problems) {
  const double room = water.depth - water.floor;
  if (lowest_start(surface.initial, water.width) > -room) return;
  const char* name = std::visit([](const auto& wave) { return std::decay_t<decltype(wave)>::kName; }, surface.initial);
  const Shape shape = std::visit([&](const auto& wave) { return shape_of(wave, water.width); }, surface.initial);
  std::string allowed = "more than " + text(-room / shape.highest, "m");
  if (shape.lowest < 0) allowed += ", less than " + text(room / -shape.lowest, "m");
  problems.push_back({pointer + "/initial/" + name + "/amplitude",
                      water.floor > 0 ? "lets the surface start below the pile's shoulder"
                                      : "lets the surface start at or below the bottom",
                      allowed, ""});
}

/// Columns of the mesh over one half wave of a cosine, or elements along it.
void check_wave(const SurfaceSpec& surface, double columns, const std::string& pointer, Problems& problems) {
  const auto* wave = std::get_if<basin::CosineSurface>(&surface.initial);
  if (!wave) return;
  const double most = std::floor(columns / kFewestColumns);
  if (static_cast<double>(wave->mode) <= most) return;
  problems.push_back({pointer + "/initial/cosine/mode",
                      "has fewer than 4 columns of the mesh per half wave: " + text(columns) + " across the water",
                      most >= 1 ? "at most " + text(most) + ", or a finer mesh" : "a finer mesh", ""});
}

}  // namespace

void check_surface(const SurfaceSpec& surface, const WaterBox& water, double columns, const std::string& pointer,
                   Problems& problems) {
  check_start(surface, water, pointer, problems);
  check_wave(surface, columns, pointer, problems);
  if (surface.volume_correction && surface.scheme == basin::SurfaceScheme::conservative) {
    problems.push_back({pointer + "/volume_correction",
                        "has nothing to correct: the conservative scheme loses no volume", "false, or another scheme",
                        ""});
  }
}

void check_sizes(double size, double pile_size, double side, const std::string& pointer, Problems& problems) {
  if (pile_size > size) {
    problems.push_back(
        {pointer + "/pile_size", "is larger than the size far from the pile", "at most " + text(size, "m"), ""});
  }
  if (size > side) {
    problems.push_back({pointer + "/size", "is larger than the water", "at most " + text(side, "m"), ""});
  }
}

void check_follows_pile(const basin::MotionMethod& motion, const std::string& pointer, Problems& problems) {
  if (!std::holds_alternative<basin::VerticalMotion>(motion)) return;
  problems.push_back({pointer, "is vertical, which follows a surface, not a pile", "zones, elliptic", ""});
}

TipRange tip_range(double radius, const pile::Tip& tip, double depth) {
  return {tip_height(radius, tip) + kLeastOverShoulder * depth, (1 - kLeastUnderTip) * depth};
}

}  // namespace seapile::scene
