// What a step may not exceed to be accepted. They are far beyond what a sound run shows, which the records tell: a
// bound that a run meets says that its numbers mean nothing any more, not that they are inexact.
#pragma once

#include "solver/grains/contact_solver.h"

namespace seapile::simulation {

/// The longest way of a grain within a step [smallest radii]. Normals stay for a step: beyond it a grain may pass
/// through another unseen.
inline constexpr double kLongestPath = 1;

/// Of a contact solver, in either precision: both find the same contacts.
struct ContactBounds {
  /// The largest overlap of two bodies [radii of the smaller]. Beyond one radius a normal points to the wrong side;
  /// sound runs show up to some 0.1, under a pile that is driven too fast for its step.
  double overlap;
  /// The rms velocity by which contacts are unsolved, times dt [smallest radii]: such a step would be off by as much as
  /// the longest overlap that is let pass.
  double residual;
};
inline constexpr ContactBounds kSoftBounds{0.5, 0.5};
inline constexpr ContactBounds kNonSmoothBounds{0.5, 0.5};  ///< its overlaps and residuals are of the same size
inline ContactBounds bounds_of(const grains::ContactLaw& law) { return law.nonsmooth ? kNonSmoothBounds : kSoftBounds; }

/// Solid that the smallest porosity leaves no room for [share of the grains' area]. Beds in use show 0; a mesh that is
/// finer than the grains some 1e-3.
inline constexpr double kClippedShare = 0.05;

/// Change of the volume below a surface that keeps it (conservative), whatever the solver's tolerance; 1e-13 is seen.
/// The other schemes of the surface do not promise to keep it, and below a fixed top water flows in and out.
inline constexpr double kVolumeChange = 1e-6;

/// Energy of the grains that nothing has given them in a stretch, by all that was given, taken and there at its start.
/// Rounding and integration leave 1e-3 of it.
inline constexpr double kGainedEnergy = 1;
/// Of a bed at rest nothing is given or taken: a rise by so much of the smallest radius is let pass all the same.
inline constexpr double kGainedRise = 0.01;

}  // namespace seapile::simulation
