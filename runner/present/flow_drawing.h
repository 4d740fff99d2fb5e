// A figure of the water as a file: panels one below the other, or side by side where they are not much longer than
// high, with axes, a legend, and a line that says what is seen.
#pragma once

#include <string>

#include "runner/present/canvas.h"
#include "runner/present/flow_figure.h"

namespace seapile::present {

/// The bytes of the file; the same for the same figure. Throws store::StoreError when cairo fails.
std::string picture_of(const FlowFigure& figure, PictureFormat format);

}  // namespace seapile::present
