// Numbers of a flow that its scene predicts before anything is computed.
//
// Scales, not solutions: each is bounded from above where it is not known, so that what is small by them is small.
#pragma once

#include <optional>

#include "solver/scene/spec.h"

namespace seapile::scene {

/// Of a basin, a saturated bed or a jet; a number that the scene does not have is absent.
struct Predictions {
  /// Bo = rho g/(gamma k^2) of the shortest wave that matters [-]; infinite without tension. k: of a cosine its own,
  /// of a hump 1/c, the largest in its spectrum; with a pile, which stirs waves of any length, pi/h, the largest that
  /// edges of length h carry.
  std::optional<double> bond;
  /// Of jets: Ca = mu U/gamma [-]; infinite without tension.
  std::optional<double> capillary;
  /// With a pile: by how much it lifts the surface, and the surface's own shape, over the depth [-].
  std::optional<double> surface_change;
  /// Re = rho U L/mu [-]. U: the pile's largest speed or, if that is more, the water's beside it; of a wave its
  /// amplitude times its frequency. L: the depth or half the width, whichever is more; of a wave alone 1/k. A jet has
  /// its own.
  double reynolds = 0;
  double cell_reynolds = 0;  ///< rho U h/mu of the coarsest elements [-]
  double mesh_travel = 0;    ///< largest way of pile and surface over the finest edge [-]
};

/// Absent when the scene is dry.
std::optional<Predictions> predictions(const SceneSpec& scene);

/// omega of a small wave, omega^2 = (g k + gamma k^3/rho) tanh(k H) (Lamb 1932, 267) [1/s].
double wave_frequency(double gravity, double tension, double density, double depth, double wave_number);

}  // namespace seapile::scene
