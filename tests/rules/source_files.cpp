#include "tests/rules/source_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace seapile::rules {

namespace fs = std::filesystem;

fs::path source_root() { return SEAPILE_SOURCE_DIR; }
fs::path build_root() { return SEAPILE_BINARY_DIR; }

std::vector<std::string> cpp_files(std::string_view folder) {
  static constexpr std::array kExtensions = {".h", ".hpp", ".inl", ".cpp", ".c"};
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(source_root() / folder)) {
    const std::string extension = entry.path().extension().string();
    if (entry.is_regular_file() && std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end()) {
      files.push_back(entry.path().lexically_relative(source_root()).generic_string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> versioned_files() {
  // safe.directory: the tests may be run by another user than the one who cloned.
  const std::string command = "git -c safe.directory='*' -C '" + source_root().string() +
                              "' ls-files --cached --others --exclude-standard --deduplicate";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("git cannot be started");
  std::string listing;
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    listing.append(buffer.data(), count);
  }
  if (pclose(pipe) != 0) throw std::runtime_error("git does not list the files of " + source_root().string());

  std::vector<std::string> files = split_lines(listing);
  std::erase_if(files, [](const std::string& file) { return !fs::is_regular_file(source_root() / file); });
  std::sort(files.begin(), files.end());
  return files;
}

std::string read(const std::string& file) {
  std::ifstream stream(source_root() / file, std::ios::binary);
  if (!stream) throw std::runtime_error(file + " cannot be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string code_only(const std::string& text) {
  std::string code = text;
  const auto blank = [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < std::min(to, code.size()); ++k) {
      if (code[k] != '\n') code[k] = ' ';
    }
  };
  const auto end_of = [&](std::string_view mark, std::size_t from) {
    const std::size_t found = text.find(mark, from);
    return found == std::string::npos ? text.size() : found + mark.size();
  };

  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at + 1;
    if (text.compare(at, 2, "//") == 0) {
      end = end_of("\n", at);
      blank(at, end);
    } else if (text.compare(at, 2, "/*") == 0) {
      end = end_of("*/", at + 2);
      blank(at, end);
    } else if (text.compare(at, 2, "R\"") == 0) {
      const std::size_t open = text.find('(', at);
      if (open != std::string::npos) end = end_of(")" + text.substr(at + 2, open - at - 2) + "\"", open);
      blank(at + 2, end - 1);
    } else if (text[at] == '"' ||
               (text[at] == '\'' && (at == 0 || !std::isalnum(static_cast<unsigned char>(text[at - 1]))))) {
      // A quote after a digit or letter separates digits (10'000).
      while (end < text.size() && text[end] != text[at] && text[end] != '\n') end += text[end] == '\\' ? 2 : 1;
      blank(at + 1, end);
      ++end;
    }
    at = end;
  }
  return code;
}

std::string place(std::string_view file, std::size_t index) {
  return std::string(file) + ":" + std::to_string(index + 1);
}

}  // namespace seapile::rules
