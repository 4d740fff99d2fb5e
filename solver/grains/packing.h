// What a packing is known by: solid fraction, porosity profile, surface, coordination number.
#pragma once

#include <span>
#include <vector>

#include "solver/grains/grains.h"

namespace seapile::grains {

/// Area of a disc of radius r below the height h above its centre [m2]: 0 for h <= -r, pi r^2 for h >= r.
double disc_area_below(double r, double h);

/// Area of a disc inside the rectangle [x0, x1] x [y0, y1], all relative to its centre [m2].
double disc_area_in_rectangle(double r, double x0, double x1, double y0, double y1);

/// Share of the strip y0 < y < y1 of the given width that grains fill [-]; exact areas of the discs.
double solid_fraction(std::span<const Disc> discs, double width, double y0, double y1);

/// Mean over columns of width 0.1 m of the top of the highest grain whose centre stands in the column [m].
double bed_surface(std::span<const Disc> discs, double left, double right);

/// The band in which a bed's solid fraction is read: 15 % to 85 % of the surface's height.
inline constexpr double kBandBottom = 0.15, kBandTop = 0.85;

}  // namespace seapile::grains
