// A figure of triangles' quality as a file: a column per mesh: itself, its shapes and its angles, and what
// is bad in another colour.
#pragma once

#include <string>

#include "runner/present/canvas.h"
#include "runner/present/quality_figure.h"

namespace seapile::present {

/// The bytes of the file; the same for the same figure. Throws store::StoreError when cairo fails.
std::string picture_of(const QualityFigure& figure, PictureFormat format);

}  // namespace seapile::present
