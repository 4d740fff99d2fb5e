#include "runner/present/bytes.h"

#include <fmt/format.h>

#include <array>

namespace seapile::present {

std::string bytes_text(std::uint64_t bytes) {
  constexpr std::array kPrefixes = {"", "K", "M", "G", "T"};
  constexpr double kStep = 1024;
  auto number = static_cast<double>(bytes);
  std::size_t prefix = 0;
  for (; number >= kStep && prefix + 1 < kPrefixes.size(); ++prefix) number /= kStep;
  return prefix == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.3g} {}iB", number, kPrefixes[prefix]);
}

}  // namespace seapile::present
