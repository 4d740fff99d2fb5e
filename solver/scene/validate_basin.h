#pragma once

#include "solver/base/problem.h"
#include "solver/scene/spec.h"

namespace seapile::scene {

/// As validate() (solver/scene/validate.h) has it of a basin, and of what is recorded of one.
base::Problems validate_basin(const basin::BasinSpec& basin);
base::Problems validate_record(const RecordSpec& record, const basin::BasinSpec& basin);

}  // namespace seapile::scene
