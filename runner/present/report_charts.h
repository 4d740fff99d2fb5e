// The curves of a study as charts of its report: tip resistance over depth, surfaces of jets, series of basins.
#pragma once

#include <optional>
#include <vector>

#include "runner/present/comparison.h"
#include "runner/present/report.h"
#include "runner/present/summary.h"

namespace seapile::present {

inline constexpr std::size_t kMostChartPoints = 2000;  ///< of a line
inline constexpr std::size_t kMostRecordLines = 24;    ///< of more runs, the means alone are kept
inline constexpr std::size_t kMostChartGroups = 60;    ///< of more cases, the first ones are drawn

/// A chart for each kind of scene that has one, from the completed runs. `published`: where a value is of a bin of
/// depth
/// ("tip_resistance_bin_0.25") or of a jet's swell ratio, it is drawn as a point. Throws store::StoreError.
std::vector<ReportChart> report_charts(const std::vector<CaseResult>& cases, const std::vector<Comparison>& published);

}  // namespace seapile::present
