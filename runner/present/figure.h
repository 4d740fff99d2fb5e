// Tip resistance against depth, as a picture: depth downwards, as soil is looked at.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runner/present/overburden.h"
#include "runner/present/statistics.h"

namespace seapile::present {

/// One run: q_c [Pa] at depth d [m], in the order of the records.
struct ResistanceCurve {
  std::vector<double> depth;
  std::vector<double> resistance;
  std::optional<Overburden> over = {};  ///< there: it is shown as q_c/sigma'_v0 against d/B
};

/// q_c and its depth as they are shown: as they are, or normalised, absent at and above the surface.
struct ShownPoint {
  double depth = 0, resistance = 0;
};
std::optional<ShownPoint> shown(const ResistanceCurve& curve, double depth, double resistance);

/// The curve of a drive's run. Throws store::StoreError when its series cannot be read.
ResistanceCurve read_resistance(const std::filesystem::path& run_folder);

/// Runs that differ by their packing alone; they share a colour and a line in the legend.
struct CurveGroup {
  std::string label;
  std::vector<ResistanceCurve> packings;
};

/// A test in the field, drawn in grey over curves that are all normalised.
struct SiteCurve {
  std::string label;
  ResistanceCurve curve;
};

struct Figure {
  std::string title;  ///< of any length; may hold any character
  std::vector<CurveGroup> groups;
  std::vector<SiteCurve> site = {};  ///< down to the depth that the groups reach; resistances on a logarithmic axis
};

inline constexpr double kBinWidth = 0.05;     ///< [m] of depth
inline constexpr std::size_t kMostFaint = 4;  ///< groups; of more, the means alone are drawn

/// Means over bins of depth as (middle of the bin [m], mean [Pa]), over the records that reach new depth, so that a
/// pile that moves up and down counts where it penetrates. Bins above the surface and bins that are not full are left
/// out. Of a normalised curve the mean q_c over sigma'_v0 in the middle of the bin, at its middle over B: the mean of
/// the records' own ratios would grow without bound towards the surface.
std::vector<std::pair<double, double>> bin_means(const ResistanceCurve& curve);

/// A bin of depth: its middle and the mean of the packings' bin means, as bin_means() gives both.
struct BandPoint {
  double depth = 0;
  Interval mean;
};

/// Mean of the packings' bin means with its interval, over the bins that all of them have.
std::vector<BandPoint> band_of_packings(const CurveGroup& group, double level = kLevel);

/// Input for gnuplot that draws the figure to standard output.
std::string gnuplot_script(const Figure& figure);

/// Draws the figure with gnuplot; the file appears when it is complete. Throws store::StoreError.
void draw(const Figure& figure, const std::filesystem::path& svg);

}  // namespace seapile::present
