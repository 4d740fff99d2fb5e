#include "runner/study/problem_text.h"

#include <fmt/format.h>

namespace seapile::study {
namespace {

constexpr std::size_t kLongestPart = 400;  // [bytes] of each part of the sentence

/// Length of the well-formed UTF-8 character at `at`; 0 when there is none.
std::size_t character_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned lead = byte(at);
  const std::size_t length = lead < 0x80                   ? 1
                             : lead >= 0xc2 && lead < 0xe0 ? 2
                             : lead >= 0xe0 && lead < 0xf0 ? 3
                             : lead >= 0xf0 && lead < 0xf5 ? 4
                                                           : 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xc0) != 0x80) return 0;
  }
  return length;
}

/// Length of the printable character at `at`; 0 when there is none.
std::size_t printable_length(const std::string& text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const bool control = lead < 0x20 || lead == 0x7f;
  const bool late_control = lead == 0xc2 && at + 1 < text.size() && static_cast<unsigned char>(text[at + 1]) < 0xa0;
  return control || late_control ? 0 : character_length(text, at);
}

std::string printable(const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    if (at > kLongestPart) return result + "...";
    if (const std::size_t length = printable_length(text, at)) {
      result += text.substr(at, length);
      at += length;
    } else {
      result += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(text[at])));
      ++at;
    }
  }
  return result;
}

}  // namespace

bool is_printable(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = printable_length(text, at);
    if (length == 0) return false;
    at += length;
  }
  return true;
}

std::string sentence(const std::string& file, const base::Problem& problem) {
  std::string line = printable(file) + ": ";
  if (!problem.pointer.empty()) line += printable(problem.pointer) + ": ";
  line += printable(problem.what);
  if (!problem.allowed.empty()) line += "; allowed: " + printable(problem.allowed);
  if (!problem.nearest.empty()) line += "; did you mean \"" + printable(problem.nearest) + "\"?";
  return line;
}

}  // namespace seapile::study
