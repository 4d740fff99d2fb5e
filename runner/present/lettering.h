// Texts on a canvas.
#pragma once

#include <cairo.h>

#include <string>

namespace seapile::present {

enum class Align { left, middle, right };

struct Lettering {
  double size = 11;  ///< of the font
  Align align = Align::left;
  bool bold = false;
  double grey = 0.1;  ///< 0 black, 1 white
};

/// The text as UTF-8 on one line, whatever it was: cairo refuses anything else, and with it the whole picture.
std::string readable(const std::string& text);

double text_width(cairo_t* context, const std::string& text, const Lettering& look);

/// Writes on the base line that begins, has its middle, or ends at (x, y); turned, upwards along it.
void write(cairo_t* context, double x, double y, const std::string& text, const Lettering& look, bool upwards = false);

/// Writes no wider than `width`: in a smaller font, and when that is not enough, cut off with an ellipsis.
void write_within(cairo_t* context, double x, double y, double width, const std::string& text, Lettering look);

}  // namespace seapile::present
