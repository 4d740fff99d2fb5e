// A white sheet to draw on with cairo, as an SVG or PNG file.
#pragma once

#include <cairo.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace seapile::present {

enum class PictureFormat { svg, png };

/// What a file is by the end of its name, ".svg" or ".png"; absent for any other.
std::optional<PictureFormat> picture_format(const std::filesystem::path& file);

/// Lengths are in units of 1/72 inch, x to the right, y downwards. SVG files hold texts as outlines, so that they look
/// the same where a font is missing; PNG files have kPixelsPerUnit pixels per unit.
class Canvas {
 public:
  Canvas(PictureFormat format, double width, double height);
  cairo_t* context() { return context_.get(); }
  /// Ends the drawing and returns the file's bytes. `description` is kept in an SVG file as text for people who cannot
  /// see it. Throws store::StoreError when cairo failed on the way.
  std::string finish(const std::string& description);

 private:
  PictureFormat format_;
  std::string bytes_;
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
  std::unique_ptr<cairo_t, void (*)(cairo_t*)> context_;
};

inline constexpr double kPixelsPerUnit = 2;

}  // namespace seapile::present
