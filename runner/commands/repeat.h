// `runner run --from FILE.tar`: a bundled run once more, and whether the bits are the same.
#pragma once

#include <string>

#include "runner/execute/campaign.h"

namespace seapile::commands {

/// Where a repetition is computed by default: in a store of its own, for in one that is in use a bed that is computed
/// again outdates every drive that is built on it.
inline constexpr const char* kRepetitionRoot = "again";

/// Returns the exit code. Throws UsageError and study::BadInput for what is wrong with the bundle.
int repeat(const std::string& bundle_file, const execute::CampaignOptions& options, bool dry_run);

}  // namespace seapile::commands
