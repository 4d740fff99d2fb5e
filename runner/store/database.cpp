#include "runner/store/database.h"

#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "runner/store/catalogue_sql.h"
#include "runner/store/file_system.h"
#include "runner/store/run_folder.h"

namespace seapile::store {

namespace {

using Path = std::filesystem::path;
using Kind = StoreError::Kind;

constexpr int kPatience = 20'000;  // [ms] for SQLite's own locks

Path lock_file(const Path& root) { return root / "catalogue.lock"; }

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// The lock of the catalogue's one writer; its process id stands in the file for whoever waits in vain. `before`
/// receives what the last writer left there.
Descriptor take_lock(const Path& root, std::chrono::milliseconds patience, std::string& before) {
  const Path file = lock_file(root);
  const auto give_up = std::chrono::steady_clock::now() + patience;
  while (true) {
    if (std::optional<Descriptor> lock = try_lock(file)) {
      before = read_text(file);
      if (::ftruncate(lock->get(), 0) != 0) throw system_error(Kind::io, "write", file);
      lock->write(std::to_string(::getpid()) + "\n");
      return *std::move(lock);
    }
    if (std::chrono::steady_clock::now() > give_up) {
      throw StoreError(Kind::locked, (root / kCatalogueFile).string() + " is being written by process " +
                                         first_line(read_text(file)));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

/// A line that tells this very state of the file from every other that somebody may have written: "" when there is no
/// such file, or when it is not the whole catalogue because a log stands beside it.
std::string left_as(const Path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return "";
  for (const char* tail : {"-wal", "-journal"}) {
    if (is_there(file.string() + tail)) return "";
  }
  return "left as " + std::to_string(status.st_ino) + ' ' + std::to_string(status.st_size) + ' ' +
         std::to_string(status.st_mtim.tv_sec) + ' ' + std::to_string(status.st_mtim.tv_nsec) + '\n';
}

std::string answer(SQLite::Database& sqlite, const char* question) { return sqlite.execAndGet(question).getString(); }

/// Creates the tables in an empty file; refuses a file of another schema.
void require_schema(SQLite::Database& sqlite, const Path& file, bool may_create) {
  const int version = schema_version(sqlite, file);
  if (version == kCatalogueVersion) return;
  if (version != 0) {
    throw OlderSchema(file.string() + " is of schema " + std::to_string(version) + ", and this program's is " +
                      std::to_string(kCatalogueVersion) +
                      ": `runner migrate` brings it up to date, `runner reindex` writes it anew");
  }
  if (!may_create) throw StoreError(Kind::damaged, file.string() + " is no catalogue of Seapile");
  SQLite::Transaction transaction(sqlite, SQLite::TransactionBehavior::IMMEDIATE);
  sqlite.exec(kCatalogueSql);
  transaction.commit();
}

}  // namespace

void rethrow(const SQLite::Exception& error, const Path& file) {
  const std::string reason = error.what();
  switch (error.getErrorCode()) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw StoreError(Kind::locked, file.string() + " is in use by another program: " + reason);
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      throw StoreError(Kind::damaged, file.string() + " is damaged and is to be rebuilt: " + reason);
    default:
      throw StoreError(Kind::io, "cannot use " + file.string() + ": " + reason);
  }
}

int schema_version(SQLite::Database& sqlite, const Path& file) {
  const int version = sqlite.execAndGet("PRAGMA user_version").getInt();
  if (version > kCatalogueVersion) {
    throw StoreError(Kind::damaged, file.string() + " is of schema " + std::to_string(version) +
                                        ", from a newer version of Seapile; this one knows " +
                                        std::to_string(kCatalogueVersion));
  }
  const bool empty = sqlite.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
  if (version < 0 || (version == 0) != empty) {
    throw StoreError(Kind::damaged, file.string() + " is no catalogue of Seapile");
  }
  return version;
}

Database::Database(const Path& root, Schema schema, std::optional<Descriptor> lock, const std::string& before)
    : file_(root / kCatalogueFile), lock_(std::move(lock)) {
  const bool writes = lock_.has_value();
  const int flags = writes ? SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE : SQLite::OPEN_READONLY;
  guarded(file_, [&] {
    sqlite_ = std::make_unique<SQLite::Database>(file_.string(), flags, kPatience);
    sqlite_->exec("PRAGMA foreign_keys=ON; PRAGMA trusted_schema=OFF; PRAGMA cell_size_check=ON;");
    if (writes) {
      // All of the file is read for that, so what the last writer closed is taken as it is.
      const std::string left = left_as(file_);
      if (left.empty() || !before.ends_with(left)) check();
      // Only now: what is damaged is left as it was found.
      sqlite_->exec("PRAGMA synchronous=FULL");
      // Write-ahead logging needs memory shared between processes, which file systems over a network do not give.
      answer(*sqlite_, file_system_of(root).is_local ? "PRAGMA journal_mode=WAL" : "PRAGMA journal_mode=DELETE");
    }
    if (schema == Schema::todays) require_schema(*sqlite_, file_, writes);
  });
}

void Database::check() {
  guarded(file_, [&] {
    if (const std::string found = answer(*sqlite_, "PRAGMA quick_check(1)"); found != "ok") {
      throw StoreError(Kind::damaged, file_.string() + " is damaged and is to be rebuilt: " + found);
    }
  });
}

Database Database::open_for_writing(const Path& root, Schema schema, std::chrono::milliseconds patience) {
  make_folder(root);
  std::string before;
  Descriptor lock = take_lock(root, patience, before);
  return {root, schema, std::move(lock), before};
}

Database Database::open_for_reading(const Path& root, Schema schema) {
  if (!is_there(root / kCatalogueFile)) {
    throw StoreError(Kind::io, "there is no catalogue " + (root / kCatalogueFile).string());
  }
  try {
    return {root, schema, std::nullopt, ""};
  } catch (const OlderSchema&) {
    throw;
  } catch (const StoreError&) {
    // A writer that was killed may have left a journal that only a writer can play back.
    open_for_writing(root, schema);
    return {root, schema, std::nullopt, ""};
  }
}

Database::~Database() {
  if (!sqlite_ || !lock_) return;
  try {
    // At rest the catalogue is one file, which readers open without creating others beside it. A reader that is busy
    // right now, or a full disk, only means that the log stays.
    sqlite_->setBusyTimeout(0);
    answer(*sqlite_, "PRAGMA journal_mode=DELETE");
    sqlite_.reset();
    if (trusted_) lock_->write(left_as(file_));
  } catch (const SQLite::Exception&) {
  } catch (const StoreError&) {
    // The next writer checks the whole file.
  }
}

void set_catalogue_aside(const Path& root) {
  make_folder(root);
  std::string before;
  Descriptor lock = take_lock(root, std::chrono::milliseconds(kPatience), before);
  for (const char* tail : {"-wal", "-shm", "-journal", ""}) {
    const Path file = (root / kCatalogueFile).string() + tail;
    if (is_there(file)) publish(file, file.string() + ".aside");
  }
  lock.close();
}

}  // namespace seapile::store
