// A trend as a picture: the points with their intervals, and beside them the effect of the axis on the same beds.
#pragma once

#include <filesystem>
#include <string>

#include "runner/present/trend.h"

namespace seapile::present {

/// Input for gnuplot that draws the trend to standard output. `title`: of any length; may hold any character.
std::string gnuplot_script(const std::string& title, const Trend& trend);

/// Draws the trend with gnuplot; the file appears when it is complete. Throws store::StoreError.
void draw(const std::string& title, const Trend& trend, const std::filesystem::path& svg);

}  // namespace seapile::present
