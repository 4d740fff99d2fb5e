// A PNG file's pixels.
#pragma once

#include <cairo.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace seapile {

struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;  ///< 0xRRGGBB, row by row from the top
  std::uint32_t at(int x, int y) const { return pixels.at(static_cast<std::size_t>(y * width + x)); }
  /// How much ink a pixel has: 0 white, 1 black.
  double ink(int x, int y) const {
    const std::uint32_t p = at(x, y);
    return 1 - static_cast<double>((p >> 16 & 255) + (p >> 8 & 255) + (p & 255)) / 765;
  }
};

/// Reads it with cairo; throws std::runtime_error when it is not a whole PNG file.
inline Picture picture_from_png(const std::string& bytes) {
  struct Source {
    const std::string& bytes;
    std::size_t at = 0;
  } source{bytes};
  const auto read = [](void* from, unsigned char* to, unsigned int length) {
    auto& s = *static_cast<Source*>(from);
    if (s.at + length > s.bytes.size()) return CAIRO_STATUS_READ_ERROR;
    std::memcpy(to, s.bytes.data() + s.at, length);
    s.at += length;
    return CAIRO_STATUS_SUCCESS;
  };
  cairo_surface_t* surface = cairo_image_surface_create_from_png_stream(read, &source);
  if (cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) throw std::runtime_error("no PNG file");
  Picture picture{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  const unsigned char* data = cairo_image_surface_get_data(surface);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      std::uint32_t pixel;
      std::memcpy(&pixel, data + y * cairo_image_surface_get_stride(surface) + 4 * x, 4);
      picture.pixels.push_back(pixel & 0xFFFFFF);
    }
  }
  cairo_surface_destroy(surface);
  return picture;
}

}  // namespace seapile
