#include "solver/grains/packing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace seapile::grains {

double disc_area_below(double r, double h) {
  if (h <= -r) return 0;
  if (h >= r) return std::numbers::pi * r * r;
  return r * r * (std::numbers::pi / 2 + std::asin(h / r)) + h * std::sqrt(r * r - h * h);
}

namespace {

/// Area of the disc where x < a and y < b.
double quadrant(double r, double a, double b) {
  if (a <= -r || b <= -r) return 0;
  if (a >= r) return disc_area_below(r, b);
  if (b >= r) return disc_area_below(r, a);
  if (a * a + b * b >= r * r) {
    // The corner lies outside the disc: what is cut off on both sides does not meet.
    if (a >= 0 && b >= 0) return disc_area_below(r, a) + disc_area_below(r, b) - std::numbers::pi * r * r;
    if (a < 0 && b < 0) return 0;
    return a < 0 ? disc_area_below(r, a) : disc_area_below(r, b);
  }
  // Inside: integral over x from the disc's left, or from where the line y = b enters it, of b + sqrt(r^2 - x^2).
  const double enter = -std::sqrt(r * r - b * b);
  const auto half = [&](double x) { return 0.5 * (x * std::sqrt(std::max(r * r - x * x, 0.0)) + r * r * std::asin(std::clamp(x / r, -1.0, 1.0))); };
  if (b >= 0) {
    // Left of `enter` the disc lies wholly below b.
    if (a <= enter) return 2 * (half(a) - half(-r));
    return 2 * (half(enter) - half(-r)) + (half(a) - half(enter)) + b * (a - enter);
  }
  return a <= enter ? 0 : (half(a) - half(enter)) + b * (a - enter);
}

}  // namespace

double disc_area_in_rectangle(double r, double x0, double x1, double y0, double y1) {
  return quadrant(r, x1, y1) - quadrant(r, x0, y1) - quadrant(r, x1, y0) + quadrant(r, x0, y0);
}

double solid_fraction(std::span<const Disc> discs, double width, double y0, double y1) {
  double area = 0;
  for (const Disc& d : discs) area += disc_area_below(d.radius, y1 - d.y) - disc_area_below(d.radius, y0 - d.y);
  return area / (width * (y1 - y0));
}

double bed_surface(std::span<const Disc> discs, double left, double right) {
  const auto columns = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround((right - left) / 0.1)));
  std::vector<double> top(columns, -std::numeric_limits<double>::infinity());
  for (const Disc& d : discs) {
    const double share = (d.x - left) / (right - left);
    const auto k = static_cast<std::size_t>(std::clamp(share * static_cast<double>(columns), 0.0, static_cast<double>(columns - 1)));
    top[k] = std::max(top[k], d.y + d.radius);
  }
  double sum = 0;
  std::size_t filled = 0;
  for (const double t : top)
    if (std::isfinite(t)) sum += t, ++filled;
  return filled ? sum / static_cast<double>(filled) : 0;
}

}  // namespace seapile::grains
