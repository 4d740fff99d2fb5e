#include "runner/store/database.h"

#include <sqlite3.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <thread>

#include "runner/store/catalogue_sql.h"
#include "runner/store/run_folder.h"

namespace seapile::store {

namespace {

using Path = std::filesystem::path;
using Kind = StoreError::Kind;

constexpr int kSchemaVersion = 1;  // user_version in catalogue.sql
constexpr int kPatience = 20'000;  // [ms] for SQLite's own locks

/// The lock of the catalogue's one writer; its process id stands in the file for whoever waits in vain.
Descriptor take_lock(const Path& root, std::chrono::milliseconds patience) {
  const Path file = root / "catalogue.lock";
  const auto give_up = std::chrono::steady_clock::now() + patience;
  while (true) {
    if (std::optional<Descriptor> lock = try_lock(file)) {
      if (::ftruncate(lock->get(), 0) != 0) throw system_error(Kind::io, "write", file);
      lock->write(std::to_string(::getpid()) + "\n");
      return *std::move(lock);
    }
    if (std::chrono::steady_clock::now() > give_up) {
      std::string holder = read_text(file);
      while (!holder.empty() && holder.back() == '\n') holder.pop_back();
      throw StoreError(Kind::locked, (root / kCatalogueFile).string() + " is being written by process " + holder);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

/// Write-ahead logging needs memory shared between processes, which file systems over a network do not give.
bool is_local(const Path& folder) {
  struct statfs status {};
  if (::statfs(folder.c_str(), &status) != 0) throw system_error(Kind::io, "look at", folder);
  switch (static_cast<unsigned long>(status.f_type) & 0xffffffffUL) {
    case 0x6969UL:      // NFS
    case 0x517BUL:      // SMB
    case 0xFF534D42UL:  // CIFS
    case 0xFE534D42UL:  // SMB2
    case 0x0BD00BD0UL:  // Lustre
    case 0x65735546UL:  // FUSE
    case 0x5346414FUL:  // AFS
    case 0x47504653UL:  // GPFS
    case 0x19830326UL:  // BeeGFS
      return false;
    default:
      return true;
  }
}

std::string answer(SQLite::Database& sqlite, const char* question) { return sqlite.execAndGet(question).getString(); }

/// Creates the tables in an empty file; refuses a file of another schema.
void require_schema(SQLite::Database& sqlite, const Path& file, bool may_create) {
  const int version = sqlite.execAndGet("PRAGMA user_version").getInt();
  if (version == kSchemaVersion) return;
  if (version > kSchemaVersion) {
    throw StoreError(Kind::damaged, file.string() + " is of schema " + std::to_string(version) +
                                        ", from a newer version of Seapile; this one knows " +
                                        std::to_string(kSchemaVersion));
  }
  const bool empty = sqlite.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
  if (version != 0 || !empty || !may_create) {
    throw StoreError(Kind::damaged, file.string() + " is no catalogue of Seapile");
  }
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

Database::Database(const Path& root, std::optional<Descriptor> lock)
    : file_(root / kCatalogueFile), lock_(std::move(lock)) {
  const bool writes = lock_.has_value();
  const int flags = writes ? SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE : SQLite::OPEN_READONLY;
  guarded(file_, [&] {
    sqlite_ = std::make_unique<SQLite::Database>(file_.string(), flags, kPatience);
    sqlite_->exec("PRAGMA foreign_keys=ON; PRAGMA trusted_schema=OFF; PRAGMA cell_size_check=ON;");
    if (writes) {
      if (const std::string found = answer(*sqlite_, "PRAGMA quick_check(1)"); found != "ok") {
        throw StoreError(Kind::damaged, file_.string() + " is damaged and is to be rebuilt: " + found);
      }
      // Only now: what is damaged is left as it was found.
      sqlite_->exec("PRAGMA synchronous=FULL");
      answer(*sqlite_, is_local(root) ? "PRAGMA journal_mode=WAL" : "PRAGMA journal_mode=DELETE");
    }
    require_schema(*sqlite_, file_, writes);
  });
}

Database Database::open_for_writing(const Path& root, std::chrono::milliseconds patience) {
  make_folder(root);
  return {root, take_lock(root, patience)};
}

Database Database::open_for_reading(const Path& root) {
  if (!is_there(root / kCatalogueFile)) {
    throw StoreError(Kind::io, "there is no catalogue " + (root / kCatalogueFile).string());
  }
  try {
    return {root, std::nullopt};
  } catch (const StoreError&) {
    // A writer that was killed may have left a journal that only a writer can play back.
    open_for_writing(root);
    return {root, std::nullopt};
  }
}

Database::~Database() {
  if (!sqlite_ || !lock_) return;
  try {
    // At rest the catalogue is one file, which readers open without creating others beside it. A reader that is busy
    // right now, or a full disk, only means that the log stays.
    sqlite_->setBusyTimeout(0);
    answer(*sqlite_, "PRAGMA journal_mode=DELETE");
  } catch (const SQLite::Exception&) {
  }
}

void set_catalogue_aside(const Path& root) {
  make_folder(root);
  Descriptor lock = take_lock(root, std::chrono::milliseconds(kPatience));
  for (const char* tail : {"-wal", "-shm", "-journal", ""}) {
    const Path file = (root / kCatalogueFile).string() + tail;
    if (is_there(file)) publish(file, file.string() + ".aside");
  }
  lock.close();
}

}  // namespace seapile::store
