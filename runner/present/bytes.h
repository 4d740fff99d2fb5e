// Sizes of files and folders, as people write them.
#pragma once

#include <cstdint>
#include <string>

namespace seapile::present {

/// "12 B", "1.2 KiB", "34.5 GiB": powers of 1024, three digits.
std::string bytes_text(std::uint64_t bytes);

}  // namespace seapile::present
