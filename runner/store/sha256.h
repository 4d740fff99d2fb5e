#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace seapile::store {

/// SHA-256 of a text, 64 lower-case hex digits.
std::string sha256(std::string_view text);

/// SHA-256 of a file's bytes, as `sha256sum` prints it. Throws StoreError::io.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace seapile::store
