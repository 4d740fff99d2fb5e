// How far a pile acts to its sides: porosity and stress of the bed against the distance from its axis, before the drive
// and behind it. Numbers only; zone_drawing.h makes a picture of them, and zone_table() rows.
//
// A value at a distance is the mean over the cells of a band of heights that lie there, left and right of the axis. The
// same cells count before and after: those that lie in the band and in the box as a whole, and that the pile has no
// part in after.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "runner/present/frame_figure.h"
#include "runner/store/catalogue.h"

namespace seapile::present {

/// A drive at d = 0 and at some depth.
struct ZoneOfRun {
  std::string title;       ///< what tells the run from others
  scene::SceneSpec scene;  ///< with a pile
  double surface = 0;      ///< height of the initial bed surface above the base [m]
  simulation::Frame before, after;
};

/// What is shown of the cells, in its order.
enum class ZoneQuantity { porosity, vertical_stress, major_stress };
inline constexpr std::size_t kZoneQuantities = 3;

struct ZoneCurve {
  std::vector<double> before, after;  ///< [-] or [Pa], at each distance
  /// The distance beyond which the change stays below kFaintChange of its largest [m]; absent where it does not as far
  /// as is seen, or nothing changes.
  std::optional<double> reach;
};
inline constexpr double kFaintChange = 0.05;

struct ZonePanel {
  std::string title;
  double depth = 0;              ///< d behind the drive [m]
  double pile_radius = 0;        ///< [m]
  View band;                     ///< distances from the axis, and heights above the base [m]
  std::vector<double> distance;  ///< means over the cells' centres, increasing [m]
  std::array<ZoneCurve, kZoneQuantities> curves;
};

struct ZoneFigure {
  std::vector<ZonePanel> runs;
};

inline constexpr double kZoneHalfHeight = 2;  ///< of the band where nothing is said, in R

/// The band where nothing is said: the distances up to the wall, the heights from 2 R below to 2 R above the lowest
/// point of the tip, ending at the base and at the initial surface.
View default_band(const ZoneOfRun& run);

/// Throws std::invalid_argument, in a sentence, when a band holds no cell; store::StoreError when a frame lacks an
/// array or the two frames differ in their cells.
ZoneFigure zone_figure(const std::vector<ZoneOfRun>& runs, const std::optional<View>& band);

/// A row per run and distance. Of each quantity the reach stands in every row.
store::Table zone_table(const ZoneFigure& figure);

}  // namespace seapile::present
