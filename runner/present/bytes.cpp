#include "runner/present/bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace seapile::present {
namespace {

constexpr std::array kPrefixes = {"", "K", "M", "G", "T"};
constexpr double kStep = 1024;

}  // namespace

std::string bytes_text(std::uint64_t bytes) {
  auto number = static_cast<double>(bytes);
  std::size_t prefix = 0;
  for (; number >= kStep && prefix + 1 < kPrefixes.size(); ++prefix) number /= kStep;
  return prefix == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.3g} {}iB", number, kPrefixes[prefix]);
}

std::optional<std::uint64_t> bytes_from(const std::string& text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  std::string prefix(rest, end);
  if (prefix.ends_with("B")) prefix.pop_back();
  const auto found = std::ranges::find(kPrefixes, prefix);
  if (error != std::errc() || found == kPrefixes.end()) return std::nullopt;
  constexpr double kMost = 1e18;
  const double bytes = number * std::pow(kStep, found - kPrefixes.begin());
  return bytes >= 0 && bytes <= kMost ? std::optional(static_cast<std::uint64_t>(bytes)) : std::nullopt;
}

}  // namespace seapile::present
