// A study that asks for as many packings as narrow a band, and what the store holds of them.
#pragma once

#include <filesystem>
#include <optional>

#include "runner/present/enough_packings.h"
#include "runner/study/study.h"

namespace seapile::commands {

/// What a study's rule asks for; it has to have one.
present::PackingsAsked packings_asked(const study::PackingRule& rule);

/// The round that the packings of this study make up; absent while one of them has no completed result. Throws
/// study::BadInput when the cases lack the rule's metric.
std::optional<present::PackingRound> packing_round(const study::Study& study, const std::filesystem::path& root);

/// The study with the packings that its rule comes to on what the store holds: as many as are enough, or so many that
/// results of the last round are missing. Without a rule the study as it is.
study::Study read_settled(const std::filesystem::path& file, study::Options options, const std::filesystem::path& root);

}  // namespace seapile::commands
