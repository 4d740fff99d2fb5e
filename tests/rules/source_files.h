// The project's own text, as the rules look at it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace seapile::rules {

/// The root of the source tree, and the folder of this build.
std::filesystem::path source_root();
std::filesystem::path build_root();

/// Paths, relative to the root and sorted, of the C++ files below one of its folders.
std::vector<std::string> cpp_files(std::string_view folder);

/// Paths, relative to the root and sorted, of every file under version control or about to be (not ignored).
/// Throws std::runtime_error when git does not answer.
std::vector<std::string> versioned_files();

/// The content of a file, given relative to the root. Throws std::runtime_error.
std::string read(const std::string& file);

std::vector<std::string> split_lines(const std::string& text);

/// The text with comments and the insides of string and character literals blanked; lines keep their numbers.
std::string code_only(const std::string& text);

/// "file:line".
std::string place(std::string_view file, std::size_t index);

}  // namespace seapile::rules
