// Three digits say enough of a scale.
#pragma once

#include <charconv>
#include <string>

namespace seapile::scene {

inline std::string rounded(double number) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, number, std::chars_format::general, 3).ptr};
}

}  // namespace seapile::scene
