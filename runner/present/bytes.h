// Sizes of files and folders, as people write them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace seapile::present {

/// "12 B", "1.2 KiB", "34.5 GiB": powers of 1024, three digits.
std::string bytes_text(std::uint64_t bytes);

/// "500M", "50G", "1T", or with a B behind it, as bytes; a bare number is bytes. Absent when the text is no size.
std::optional<std::uint64_t> bytes_from(const std::string& text);

}  // namespace seapile::present
