// A figure of how far piles act to their sides as a file: a panel per quantity over the distance in common, a colour
// per run, dashed before the drive and solid behind it, and a mark where the change has faded.
#pragma once

#include <string>

#include "runner/present/canvas.h"
#include "runner/present/zone_figure.h"

namespace seapile::present {

/// The bytes of the file; the same for the same figure. Throws store::StoreError when cairo fails.
std::string picture_of(const ZoneFigure& figure, PictureFormat format);

}  // namespace seapile::present
