// A map of where scenes stop holding.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/present/edge.h"

namespace seapile::present {

/// Between last good and first bad a bar for each search that found them, over the first label that is a number; one
/// line for each combination of the other labels. What always holds points upwards from the bad end, what never does
/// downwards from the good one. Both axes by powers of ten. "" when no label is a number.
std::string gnuplot_script(const std::string& title, const std::vector<EdgeSearch>& searches);

/// Writes one SVG file; false when there is nothing to draw. Throws store::StoreError.
bool draw(const std::string& title, const std::vector<EdgeSearch>& searches, const std::filesystem::path& svg);

}  // namespace seapile::present
