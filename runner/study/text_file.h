#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace seapile::study {

/// The bytes of a regular file of at most `most_bytes`; absent with one clause in `trouble` when it is none, is larger,
/// or cannot be read. Never waits for a FIFO or a device.
std::optional<std::string> read_text(const std::filesystem::path& file, std::size_t most_bytes, std::string& trouble);

/// The real path of `relative` below `folder`. Absent with one clause in `trouble` when the path is absolute, has a
/// "..", or leaves the folder through a symbolic link: a study takes along only what lies beside it.
std::optional<std::filesystem::path> path_below(const std::filesystem::path& folder, const std::string& relative,
                                                std::string& trouble);

}  // namespace seapile::study
