#pragma once

#include <optional>
#include <string>

#include "runner/present/frame_figure.h"

namespace seapile::commands {

/// What `--window x0,x1,y0,y1` says; absent for "". Throws UsageError.
std::optional<present::View> view_of(const std::string& window);

}  // namespace seapile::commands
