// What the store holds of the variants of a study.
#pragma once

#include <filesystem>
#include <vector>

#include "runner/present/trade.h"
#include "runner/study/study.h"

namespace seapile::commands {

/// One group for each combination of the axes beside variant and seed. Reads the newest run of every case; what is not
/// completed is told as a failure. Throws store::StoreError, and study::BadInput when no finished case has a metric of
/// a name.
std::vector<present::TradedGroup> traded(const study::Study& study, const std::filesystem::path& root);

}  // namespace seapile::commands
