#pragma once

#include <filesystem>
#include <string>

#include "runner/store/run_folder.h"

namespace seapile::store {

/// manifest.json as text: readable JSON whose last member, "seal", is the SHA-256 of everything before it.
std::string manifest_text(const Manifest& manifest);

/// Reads it back. `where` is named in errors. Throws StoreError::damaged.
Manifest parse_manifest(const std::string& text, const std::filesystem::path& where);

const char* name(simulation::Outcome outcome);

/// 64 bits as 16 hex digits: JSON's numbers lose them.
std::string hex(std::uint64_t bits);

}  // namespace seapile::store
