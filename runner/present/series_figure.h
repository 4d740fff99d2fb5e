// Columns of time series as a picture: a panel per column, one below the other over the same abscissa, a line per run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/present/curve.h"

namespace seapile::present {

/// A column of a series in all runs.
struct SeriesAxis {
  std::string name, unit;
  std::vector<std::vector<double>> values;  ///< of each run, one per record
};

struct SeriesFigure {
  std::string title;  ///< of any length; may hold any character
  std::vector<std::string> runs;
  SeriesAxis abscissa;
  std::vector<SeriesAxis> panels;
};

inline constexpr std::size_t kMostPanels = 4;

/// The first of the columns is the abscissa. Throws store::StoreError when a series cannot be read.
SeriesFigure series_figure(const std::string& title, const std::vector<CurveSource>& sources, Series series,
                           const std::vector<std::string>& columns);

/// Input for gnuplot that draws the figure to standard output.
std::string gnuplot_script(const SeriesFigure& figure);

/// Draws the figure with gnuplot; the file appears when it is complete. Throws store::StoreError.
void draw(const SeriesFigure& figure, const std::filesystem::path& svg);

}  // namespace seapile::present
