// JSON texts that seal themselves: the last member, "seal", is the SHA-256 of everything before it.
#pragma once

#include <filesystem>
#include <string>

namespace seapile::store {

/// The text of a JSON object, indented by two, with its seal as the last member.
std::string with_seal(std::string object);

/// The object without its seal, to be parsed. `where` is named in errors. Throws StoreError::damaged when the seal is
/// not that of the text.
std::string unsealed(const std::string& text, const std::filesystem::path& where);

/// The seal of an object as with_seal() makes it. Throws likewise.
std::string seal_of(const std::string& text, const std::filesystem::path& where);

}  // namespace seapile::store
