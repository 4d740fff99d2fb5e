#include "runner/present/lettering.h"

#include <algorithm>
#include <numbers>

namespace seapile::present {
namespace {

constexpr double kSmallest = 8;  ///< font that is still read

void choose(cairo_t* context, const Lettering& look) {
  // Fontconfig finds the nearest font there is.
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         look.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, look.size);
}

}  // namespace

std::string readable(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80   ? 1
                               : lead < 0xC2 ? 0
                               : lead < 0xE0 ? 2
                               : lead < 0xF0 ? 3
                               : lead < 0xF5 ? 4
                                             : 0;
    bool whole = length > 0 && i + length <= text.size();
    for (std::size_t k = 1; whole && k < length; ++k) whole = (text[i + k] & 0xC0) == 0x80;
    result += !whole ? "?" : lead < 0x20 ? " " : text.substr(i, length);
    i += whole ? length : 1;
  }
  return result;
}

double text_width(cairo_t* context, const std::string& text, const Lettering& look) {
  choose(context, look);
  cairo_text_extents_t extents;
  cairo_text_extents(context, readable(text).c_str(), &extents);
  return extents.x_advance;
}

void write(cairo_t* context, double x, double y, const std::string& text, const Lettering& look, bool upwards) {
  const double width = text_width(context, text, look);
  const double before = look.align == Align::left ? 0 : look.align == Align::middle ? width / 2 : width;
  cairo_save(context);
  cairo_translate(context, x, y);
  if (upwards) cairo_rotate(context, -std::numbers::pi / 2);
  cairo_set_source_rgb(context, look.grey, look.grey, look.grey);
  cairo_move_to(context, -before, 0);
  cairo_show_text(context, readable(text).c_str());
  cairo_restore(context);
}

void write_within(cairo_t* context, double x, double y, double width, const std::string& text, Lettering look) {
  std::string shown = readable(text);
  const double whole = text_width(context, shown, look);
  if (whole > width) look.size = std::max(kSmallest, look.size * width / whole);
  while (!shown.empty() && text_width(context, shown, look) > width * 1.001) {
    if (shown.ends_with("…")) shown.resize(shown.size() - std::string("…").size());
    while (!shown.empty() && (shown.back() & 0xC0) == 0x80) shown.pop_back();
    if (!shown.empty()) shown.pop_back();
    shown += "…";
    if (shown == "…") break;
  }
  write(context, x, y, shown, look);
}

}  // namespace seapile::present
