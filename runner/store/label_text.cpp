#include "runner/store/label_text.h"

#include <fmt/format.h>

namespace seapile::store {
namespace {

/// Whether the value lists a part's members: "density=1300 kg/m3".
bool is_part(const std::string& value) {
  const std::size_t end = value.find_first_not_of("abcdefghijklmnopqrstuvwxyz_.");
  return end != std::string::npos && end > 0 && value[end] == '=';
}

/// "depth=2 m, tip=conical(apex_angle=0.5 rad)" as "depth 2 m, tip conical(apex_angle=0.5 rad)".
std::string without_signs(std::string members) {
  int inside = 0;
  for (char& c : members) {
    inside += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == '=' && inside == 0) c = ' ';
  }
  return members;
}

/// What is said of a part that is there or not; otherwise "".
std::string presence(const std::string& name, const std::string& value) {
  return value == "null" ? "no " + name : value == "default" ? name : "";
}

}  // namespace

std::string label_text(const std::string& path, const std::string& value) {
  const std::string text = presence(path, value);
  return text.empty() ? fmt::format("{}{}{}", path, is_part(value) ? "." : "=", value) : text;
}

std::string short_label_text(const std::string& path, const std::string& value) {
  const auto last = path.find_last_of('.');
  const std::string name = last == std::string::npos ? path : path.substr(last + 1), text = presence(name, value);
  if (!text.empty()) return text;
  return fmt::format("{} {}", name, is_part(value) ? without_signs(value) : value);
}

}  // namespace seapile::store
