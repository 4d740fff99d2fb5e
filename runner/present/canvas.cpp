#include "runner/present/canvas.h"

#include <cairo-svg.h>
#include <fmt/format.h>

#include <cmath>

#include "runner/present/lettering.h"
#include "runner/store/store_error.h"

namespace seapile::present {
namespace {

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw store::StoreError(store::StoreError::Kind::io,
                          fmt::format("the picture was not drawn: {}", cairo_status_to_string(status)));
}

cairo_surface_t* new_surface(PictureFormat format, double width, double height, std::string& bytes) {
  if (format == PictureFormat::svg) return cairo_svg_surface_create_for_stream(append, &bytes, width, height);
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(width * kPixelsPerUnit)),
                                    static_cast<int>(std::ceil(height * kPixelsPerUnit)));
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : readable(text)) result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return result;
}

}  // namespace

std::optional<PictureFormat> picture_format(const std::filesystem::path& file) {
  if (file.extension() == ".svg") return PictureFormat::svg;
  if (file.extension() == ".png") return PictureFormat::png;
  return std::nullopt;
}

Canvas::Canvas(PictureFormat format, double width, double height)
    : format_(format),
      surface_(new_surface(format, width, height, bytes_), cairo_surface_destroy),
      context_(cairo_create(surface_.get()), cairo_destroy) {
  if (format == PictureFormat::png) cairo_scale(context(), kPixelsPerUnit, kPixelsPerUnit);
  cairo_set_source_rgb(context(), 1, 1, 1);
  cairo_paint(context());
  // Hinting would move the letters of a vector picture to the pixels of a screen that it does not have.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(context(), options);
  cairo_font_options_destroy(options);
}

std::string Canvas::finish(const std::string& description) {
  check(cairo_status(context()));
  if (format_ == PictureFormat::png) {
    cairo_surface_flush(surface_.get());
    check(cairo_surface_write_to_png_stream(surface_.get(), append, &bytes_));
  }
  context_.reset();
  cairo_surface_finish(surface_.get());
  check(cairo_surface_status(surface_.get()));
  if (format_ == PictureFormat::svg) {
    const std::size_t root = bytes_.find("<svg"), behind = bytes_.find('>', root);
    if (root == std::string::npos || behind == std::string::npos) check(CAIRO_STATUS_WRITE_ERROR);
    bytes_.insert(behind + 1, "\n<desc>" + escaped(description) + "</desc>");
    // The drawing is a group that cairo names by how many surfaces the process has had: nobody refers to it.
    const std::size_t name = bytes_.find(R"( id="surface)");
    if (name != std::string::npos) bytes_.erase(name, bytes_.find('>', name) - name);
  }
  return std::move(bytes_);
}

}  // namespace seapile::present
