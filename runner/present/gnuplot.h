// gnuplot as a subprocess that writes one SVG file, and the looks that all pictures share.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace seapile::present {

/// A gnuplot string. What could end it, run a command or name a macro is written by its octal code.
std::string quoted(const std::string& text);

/// Lines of at most `most` characters, broken at spaces.
std::vector<std::string> wrapped(const std::string& text, std::size_t most);

/// How the n-th group of a picture looks: an RGB colour in hex, and a dash as gnuplot takes it.
struct Style {
  std::string_view colour;
  std::string_view dash;
};
Style style_of(std::size_t group);

/// Both axes by powers of ten, with a grid.
inline constexpr std::string_view kLogarithmicAxes =
    "set border 3 lw 1 lc rgb '#8c8c8c'\n"
    "set logscale xy\n"
    "set xtics out nomirror scale 0.6 tc rgb '#444444'\n"
    "set ytics out nomirror scale 0.6 tc rgb '#444444'\n"
    "set grid xtics ytics back lt 1 lw 1 lc rgb '#e8e8e8'\n";

/// The beginning of a script: the terminal, and from the picture's upper edge a title and a note in words. Lengths in
/// pixels.
struct Heading {
  std::string script;
  int bottom = 0;  ///< how far down it reaches
};
inline constexpr int kHeadingSide = 28;  ///< from the left and from the upper edge
/// `title`: of any length; broken at `most` characters, and cut when it is longer than a few lines.
Heading heading(const std::string& title, const std::string& note, int width, int height, std::size_t most);

/// "gnuplot 5.4 patchlevel 4"; "" where it is not installed or does not answer.
std::string gnuplot_version();

/// Runs a script that draws one picture to standard output; the file appears when it is complete. Throws
/// store::StoreError.
void draw_with_gnuplot(const std::string& script, const std::filesystem::path& svg);

}  // namespace seapile::present
