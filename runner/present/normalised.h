// Resistances without units: q_c/sigma'_v0 against d/B, of drives, and of tests in the field beside them.
#pragma once

#include <string>
#include <vector>

#include "runner/present/curve.h"
#include "runner/present/figure.h"

namespace seapile::present {

/// What the rows of a simulated drive say of the model.
inline constexpr const char* kModel = "plane strain discs";

/// A drive with what it is divided by.
struct NormalisedRun {
  CurveSource source;
  ResistanceCurve curve;      ///< `over` is there
  double width_over_d50 = 0;  ///< B over the median diameter of its bed
};

/// Throws store::StoreError, also when a run of a bed is not there.
std::vector<NormalisedRun> normalised(const std::vector<CurveSource>& drives);

/// CSV, a row per record below the surface: "case", "run", the labels, "depth[m]", "tip_resistance[Pa]",
/// "effective_stress[Pa]", "depth_over_width[-]", "resistance_over_stress[-]", "width_over_d50[-]", "model", "source".
/// The model is kModel and the source "simulated"; rows of the field follow, with the name of their file as the source
/// and no case, labels, model or grains.
std::string normalised_csv(const std::vector<NormalisedRun>& runs, const std::vector<SiteCurve>& site);

/// CSV, a row per case, the seed apart, and bin of depth: the labels, "depth_over_width[-]", "n", "mean[-]", "low[-]",
/// "high[-]" of the resistance over the stress, "width_over_d50[-]" (mean of the packings), "model", "source". Rows of
/// the field follow: their values as means without n and interval.
std::string normalised_bands_csv(const std::vector<NormalisedRun>& runs, const std::vector<SiteCurve>& site,
                                 double level = kLevel);

/// The runs as a figure; `bands`: packings of the same case together. Below `title` stand the model, B/d50 and how many
/// packings there are.
Figure normalised_figure(const std::string& title, const std::vector<NormalisedRun>& runs,
                         const std::vector<SiteCurve>& site, bool bands);

}  // namespace seapile::present
