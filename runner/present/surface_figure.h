// Free surfaces as a picture: how a jet swells or shrinks behind the lip, one curve per case.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seapile::present {

/// Height h [H] of the free surface at place x [H], from the lip at x = 0 on; H is the die's radius or half gap.
struct SurfaceCurve {
  std::string label;
  std::vector<double> x, height;
};

/// The surface in the last frame of a flow's run, without a label; absent when there is none. Throws store::StoreError.
std::optional<SurfaceCurve> read_surface(const std::filesystem::path& run_folder);

struct SurfaceFigure {
  std::string title;  ///< of any length; may hold any character
  std::vector<SurfaceCurve> curves;
};

/// Input for gnuplot that draws the figure to standard output.
std::string gnuplot_script(const SurfaceFigure& figure);

/// Draws the figure with gnuplot; the file appears when it is complete. Throws store::StoreError.
void draw(const SurfaceFigure& figure, const std::filesystem::path& svg);

}  // namespace seapile::present
