#pragma once

#include <optional>

#include "solver/base/problem.h"
#include "solver/scene/spec.h"

namespace seapile::scene {

/// Relations between fields, each problem with its JSON pointer into the scene ("/pile/radius"); empty: the scene can
/// be built. Ranges of single fields are checked where they are read.
/// `bed_height`: top of the highest grain [m] where it is known, as for grains from a file; otherwise it is estimated
/// for grains that are drawn, and what depends on it is not checked for grains from a file.
base::Problems validate(const SceneSpec& scene, std::optional<double> bed_height = {});

/// Relations between what is recorded and the scene, each problem with its JSON pointer into the record ("/frames/2").
base::Problems validate(const RecordSpec& record, const SceneSpec& scene);

/// What a problem says of a frame that stands in its list already.
inline constexpr const char* kTwice = "is there twice";

}  // namespace seapile::scene
