// Everything that a catalogue holds, as text.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace seapile::store::sample {

/// The rows of every table, sorted, by the table's name.
std::map<std::string, std::string> rows_of_all_tables(const std::filesystem::path& catalogue);

/// Columns and keys of every table, and the text of every index, trigger and view without comments and layout.
std::map<std::string, std::string> schema_of(const std::filesystem::path& catalogue);

}  // namespace seapile::store::sample
