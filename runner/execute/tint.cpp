#include "runner/execute/tint.h"

#include <fmt/color.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace seapile::execute {
namespace {

using fmt::terminal_color;

// Longer words before those that they begin with.
constexpr std::array kWords = {
    std::pair(std::string_view("completed"), terminal_color::green),
    std::pair(std::string_view("confirmed"), terminal_color::green),
    std::pair(std::string_view("fresh"), terminal_color::green),
    std::pair(std::string_view("ok"), terminal_color::green),
    std::pair(std::string_view("pass"), terminal_color::green),
    std::pair(std::string_view("FAILED"), terminal_color::red),
    std::pair(std::string_view("failed"), terminal_color::red),
    std::pair(std::string_view("diverged"), terminal_color::red),
    std::pair(std::string_view("refuted"), terminal_color::red),
    std::pair(std::string_view("problem"), terminal_color::red),
    std::pair(std::string_view("NOT RUN"), terminal_color::yellow),
    std::pair(std::string_view("not run"), terminal_color::yellow),
    std::pair(std::string_view("not distinguishable"), terminal_color::yellow),
    std::pair(std::string_view("interrupted"), terminal_color::yellow),
    std::pair(std::string_view("stopped"), terminal_color::yellow),
    std::pair(std::string_view("stale"), terminal_color::yellow),
    std::pair(std::string_view("missing"), terminal_color::yellow),
    std::pair(std::string_view("underpowered"), terminal_color::yellow),
    std::pair(std::string_view("note"), terminal_color::yellow),
};

/// Whether a cell of a table, or a line, begins at `at`.
bool begins_cell(const std::string& text, std::size_t at) {
  return at == 0 || text[at - 1] == '\n' || (at > 1 && text[at - 1] == ' ' && text[at - 2] == ' ');
}

/// Whether one ends at `at`: by the end of the line or two blanks.
bool ends_cell(const std::string& text, std::size_t at) {
  return at == text.size() || text[at] == '\n' || text.compare(at, 2, "  ") == 0;
}

}  // namespace

bool has_colours(std::FILE* stream) {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string_view(value == nullptr ? "" : value);
  };
  const std::string_view terminal = variable("TERM");
  return variable("NO_COLOR").empty() && !terminal.empty() && terminal != "dumb" && ::isatty(::fileno(stream)) == 1;
}

std::string tinted(const std::string& text, std::FILE* stream) {
  if (!has_colours(stream)) return text;
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const auto* const word = [&] {
      if (!begins_cell(text, at)) return kWords.end();
      const auto* found = kWords.begin();
      while (found != kWords.end() &&
             !(text.compare(at, found->first.size(), found->first) == 0 && ends_cell(text, at + found->first.size())))
        ++found;
      return found;
    }();
    if (word == kWords.end()) {
      result += text[at++];
      continue;
    }
    result += fmt::format(fmt::fg(word->second), "{}", word->first);
    at += word->first.size();
  }
  return result;
}

}  // namespace seapile::execute
