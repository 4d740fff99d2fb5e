// The SQLite file behind the catalogue.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "runner/store/durable.h"

namespace seapile::store {

inline constexpr const char* kCatalogueFile = "catalogue.sqlite";

/// Turns what SQLite throws into a StoreError that names the file.
[[noreturn]] void rethrow(const SQLite::Exception& error, const std::filesystem::path& file);

template <class Work>
auto guarded(const std::filesystem::path& file, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const SQLite::Exception& error) {
    rethrow(error, file);
  }
}

/// An open catalogue file of this program's schema. A writer has the file's lock besides SQLite's own.
class Database {
 public:
  static Database open_for_writing(const std::filesystem::path& root,
                                   std::chrono::milliseconds patience = std::chrono::seconds(20));
  static Database open_for_reading(const std::filesystem::path& root);
  Database(Database&&) = default;
  ~Database();

  const std::filesystem::path& file() const { return file_; }
  SQLite::Database& sqlite() { return *sqlite_; }

 private:
  Database(const std::filesystem::path& root, std::optional<Descriptor> lock);

  std::filesystem::path file_;
  std::optional<Descriptor> lock_;  ///< absent: read only
  std::unique_ptr<SQLite::Database> sqlite_;
};

/// Gives way for a new file: a damaged one is kept under another name.
void set_catalogue_aside(const std::filesystem::path& root);

}  // namespace seapile::store
