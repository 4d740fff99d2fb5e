#pragma once

#include <string>
#include <string_view>

namespace seapile::study {

/// SHA-256, 64 lower-case hex digits.
std::string sha256(std::string_view bytes);

}  // namespace seapile::study
