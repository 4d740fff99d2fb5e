#include "solver/scene/predictions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/scene/checks.h"

namespace seapile::scene {
namespace {

using std::numbers::pi;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A pile in water, by what it does at most.
struct Stirring {
  double radius;  ///< R [m]
  double speed;   ///< V [m/s]
  double travel;  ///< farthest from its start [m]
};

/// What basins and saturated beds have in common.
struct WaterScene {
  double width, depth, gravity, density, viscosity;  ///< SI
  std::optional<basin::SurfaceSpec> surface;
  double finest, coarsest;  ///< edges of the mesh [m]
  double surface_edge;      ///< longest of the surface's finest edges [m]
  std::optional<Stirring> pile;
  double crowding = 1;  ///< of the flow between grains: 1/phi at most [-]
};

WaterScene water_of(const basin::BasinSpec& basin) {
  WaterScene water{basin.width, basin.depth, basin.gravity, basin.density, basin.viscosity, basin.surface, 0, 0, 0, {}};
  if (const auto* grid = std::get_if<basin::StructuredMesh>(&basin.mesh.pattern)) {
    const double column = basin.width / static_cast<double>(grid->columns),
                 row = basin.depth / static_cast<double>(grid->rows);
    water.finest = std::min(column, row * grid->bottom_row);
    water.coarsest = std::max(column, row);
    water.surface_edge = column;
  } else {
    const auto& pattern = std::get<basin::UnstructuredMesh>(basin.mesh.pattern);
    water.finest = water.surface_edge = std::min(pattern.size, pattern.pile_size);
    water.coarsest = std::max(pattern.size, pattern.pile_size);
  }
  if (basin.pile) {
    const Motion moved = motion(basin.pile->driving, basin.time.duration);
    water.pile = {basin.pile->radius, largest_speed(basin.pile->driving), std::max(moved.down, moved.up)};
  }
  return water;
}

/// It starts above the highest grain under it: two grains above the mean surface are granted.
WaterScene water_of(const SceneSpec& scene) {
  const FluidSpec& fluid = *scene.fluid;
  const DomainSpec& box = scene.bed.domain;
  const double finest = std::min(fluid.mesh.size, fluid.mesh.pile_size),
               coarsest = std::max(fluid.mesh.size, fluid.mesh.pile_size);
  WaterScene water{box.width,
                   fluid.depth,
                   box.gravity,
                   fluid.density,
                   fluid.density * fluid.kinematic_viscosity,
                   fluid.surface,
                   finest,
                   coarsest,
                   finest,
                   {},
                   1 / fluid.coupling.porosity.least};
  if (!scene.pile) return water;
  const pile::PileSpec& pile = *scene.pile;
  const double time = duration(pile);
  double down = kInfinity, up = kInfinity;
  if (std::isfinite(time)) {
    const Motion moved = motion(pile.driving, time);
    down = pile.duration ? moved.down : kInfinity;
    up = moved.up;
  }
  if (pile.depth) down = std::min(down, *pile.depth + 4 * scene.bed.grains.radius.max);
  water.pile = {pile.radius, largest_speed(pile.driving), std::max(down, up)};
  return water;
}

/// Amplitude [m] and largest wave number [1/m] of the surface's shape at the start; 0 when it is level.
struct Shape {
  double amplitude = 0, wave_number = 0;
};
Shape shape_of(const WaterScene& water) {
  if (!water.surface) return {};
  if (const auto* hump = std::get_if<basin::HumpSurface>(&water.surface->initial))
    return {std::abs(hump->amplitude), 1 / hump->width};
  if (const auto* wave = std::get_if<basin::CosineSurface>(&water.surface->initial))
    return {std::abs(wave->amplitude), static_cast<double>(wave->mode) * pi / water.width};
  return {};
}

/// Height by which a pile lifts the water [m]: what it displaces over the surface beside it, 2 R d/(L - 2 R); the wave
/// that it sends to each side, R V/sqrt(g H); and the head of its speed, V^2/g.
double rise_of(const Stirring& pile, const WaterScene& water) {
  if (pile.speed == 0) return 0;
  if (water.gravity == 0) return kInfinity;
  return 2 * pile.radius * pile.travel / (water.width - 2 * pile.radius) +
         pile.radius * pile.speed / std::sqrt(water.gravity * water.depth) + pile.speed * pile.speed / water.gravity;
}

Predictions predictions_of(const WaterScene& water) {
  Predictions predicted;
  const Shape shape = shape_of(water);
  const double tension = water.surface ? water.surface->tension : 0;
  if (water.surface) {
    double k = shape.wave_number > 0 ? shape.wave_number : pi / water.width;
    if (water.pile) k = std::max(k, pi / water.surface_edge);
    predicted.bond = tension > 0 ? water.density * water.gravity / (tension * k * k) : kInfinity;
  }
  double speed = 0, length = 0, way = 2 * shape.amplitude;
  if (shape.amplitude > 0) {
    speed = shape.amplitude * wave_frequency(water.gravity, tension, water.density, water.depth, shape.wave_number);
    length = 1 / shape.wave_number;
  }
  if (water.pile) {
    const double rise = rise_of(*water.pile, water);
    predicted.surface_change = (rise + shape.amplitude) / water.depth;
    const double beside = 2 * water.pile->radius / (water.width - 2 * water.pile->radius);
    speed = std::max(speed, water.pile->speed * std::max(1.0, beside) * water.crowding);
    length = std::max(0.5 * water.width, water.depth);
    way += water.pile->travel + rise;
  }
  predicted.reynolds = water.density * speed * length / water.viscosity;
  predicted.cell_reynolds = water.density * speed * water.coarsest / water.viscosity;
  predicted.mesh_travel = way / water.finest;
  return predicted;
}

Predictions predictions_of(const fluid::JetSpec& jet) {
  Predictions predicted;
  predicted.capillary = jet.capillary.value_or(kInfinity);
  predicted.reynolds = jet.reynolds;
  predicted.cell_reynolds = jet.reynolds / 2 * jet.largest_size;
  predicted.mesh_travel = kInfinity;  // its surface is found, not predicted
  return predicted;
}

}  // namespace

double wave_frequency(double gravity, double tension, double density, double depth, double wave_number) {
  const double k = wave_number;
  return std::sqrt((gravity * k + tension * k * k * k / density) * std::tanh(k * depth));
}

std::optional<Predictions> predictions(const SceneSpec& scene) {
  if (scene.jet) return predictions_of(*scene.jet);
  if (scene.basin) return predictions_of(water_of(*scene.basin));
  if (scene.fluid) return predictions_of(water_of(scene));
  return {};
}

}  // namespace seapile::scene
