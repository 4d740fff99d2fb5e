#pragma once

#include <filesystem>

#include "runner/store/stamp.h"
#include "solver/simulation/run.h"

namespace seapile::store {

/// Seals bed.h5: the grains as exact numbers, and everything else that is known of the bed.
void write_bed(const std::filesystem::path& file, const Stamp& stamp, const simulation::Bed& bed);

simulation::Bed read_bed(const std::filesystem::path& file, const Stamp& stamp);

}  // namespace seapile::store
