// A figure of frames as a file: panels side by side, axes in metres, a legend, and a line that says what is seen.
#pragma once

#include <string>

#include "runner/present/canvas.h"
#include "runner/present/frame_figure.h"

namespace seapile::present {

/// The bytes of the file; the same for the same figure. Throws store::StoreError when cairo fails.
std::string picture_of(const FrameFigure& figure, PictureFormat format);

}  // namespace seapile::present
