// A work-precision diagram: error against CPU time, both by powers of ten.
#pragma once

#include <filesystem>
#include <string>

#include "runner/present/trade.h"

namespace seapile::present {

/// Of one metric of a group: each variant a point with its interval, those on the frontier joined, those without a
/// result at the upper edge. A dashed line is what chance gives a variant that does not differ: the median over the
/// variants of their intervals' half-widths.
std::string gnuplot_script(const std::string& title, const TradedGroup& group, std::size_t metric);

/// Writes one SVG file. Throws store::StoreError.
void draw(const std::string& title, const TradedGroup& group, std::size_t metric, const std::filesystem::path& svg);

}  // namespace seapile::present
