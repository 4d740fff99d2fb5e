// An older catalogue is brought to this program's schema, step by step.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seapile::store {

struct Migration {
  int from = 0, to = 0;               ///< versions of the schema; equal: there is nothing to do
  std::vector<std::string> steps;     ///< what each does, a clause
  std::filesystem::path kept;         ///< copy of the catalogue as it was; empty: none was made
  std::vector<std::string> left_out;  ///< a sentence for each run that was listed, or declaration, that does not hold
};

/// What migrate() would do; writes nothing. Throws StoreError, also when there is no catalogue.
Migration planned_migration(const std::filesystem::path& root);

/// Copies the catalogue aside as catalogue.sqlite.v<version>, then takes all steps in one transaction. Throws
/// StoreError; the catalogue is then as it was.
Migration migrate(const std::filesystem::path& root);

}  // namespace seapile::store
