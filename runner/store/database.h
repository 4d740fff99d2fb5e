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
inline constexpr int kCatalogueVersion = 3;  ///< user_version in results_schema/catalogue.sql

/// A catalogue of an older schema, which has to be migrated first.
struct OlderSchema : StoreError {
  explicit OlderSchema(const std::string& sentence) : StoreError(Kind::damaged, sentence) {}
};

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

/// The version of an open file's schema; 0: nothing is in it yet. Throws StoreError::damaged when the file is newer
/// than this program, or another's.
int schema_version(SQLite::Database& sqlite, const std::filesystem::path& file);

/// Which schema a file is opened with.
enum class Schema {
  todays,  ///< this program's; an empty file gets it, an older one throws OlderSchema
  any,     ///< whatever it has
};

/// An open catalogue file. A writer has the file's lock besides SQLite's own. A file that is not as the last writer
/// left it is read as a whole and checked before it is written to.
class Database {
 public:
  static Database open_for_writing(const std::filesystem::path& root, Schema schema = Schema::todays,
                                   std::chrono::milliseconds patience = std::chrono::seconds(20));
  static Database open_for_reading(const std::filesystem::path& root, Schema schema = Schema::todays);
  Database(Database&&) = default;
  ~Database();

  const std::filesystem::path& file() const { return file_; }
  SQLite::Database& sqlite() { return *sqlite_; }

  /// Reads all of the file; throws StoreError::damaged.
  void check();
  /// Something went wrong with the file: the next writer checks it.
  void distrust() { trusted_ = false; }

 private:
  Database(const std::filesystem::path& root, Schema schema, std::optional<Descriptor> lock, const std::string& before);

  std::filesystem::path file_;
  std::optional<Descriptor> lock_;  ///< absent: read only
  std::unique_ptr<SQLite::Database> sqlite_;
  bool trusted_ = true;
};

/// Gives way for a new file: a damaged one is kept under another name.
void set_catalogue_aside(const std::filesystem::path& root);

}  // namespace seapile::store
