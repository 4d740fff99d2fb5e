#include "runner/store/database.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

std::string setting(Database& database, const std::string& name) {
  return database.sqlite().execAndGet("PRAGMA " + name).getString();
}

TEST(Database, IsKeptSafelyWhileItIsWritten) {
  const Scratch scratch;
  Database database = Database::open_for_writing(scratch.path());
  EXPECT_EQ(setting(database, "journal_mode"), "wal");
  EXPECT_EQ(setting(database, "synchronous"), "2");  // FULL
  EXPECT_EQ(setting(database, "foreign_keys"), "1");
  EXPECT_EQ(setting(database, "trusted_schema"), "0");
  EXPECT_EQ(setting(database, "cell_size_check"), "1");
  EXPECT_EQ(setting(database, "user_version"), "3");
}

TEST(Database, HasOnlyStrictTables) {
  const Scratch scratch;
  Database database = Database::open_for_writing(scratch.path());
  EXPECT_GT(database.sqlite().execAndGet("SELECT count(*) FROM pragma_table_list WHERE strict").getInt(), 8);
  EXPECT_EQ(database.sqlite()
                .execAndGet("SELECT count(*) FROM pragma_table_list WHERE type = 'table' AND NOT strict "
                            "AND name NOT LIKE 'sqlite_%'")
                .getInt(),
            0);
}

TEST(Database, HasOneWriterAtATimeAndSaysWho) {
  const Scratch scratch;
  {
    const Database writer = Database::open_for_writing(scratch.path());
    std::ofstream(scratch.path() / "catalogue.lock") << "4711\n";
    try {
      Database::open_for_writing(scratch.path(), Schema::todays, std::chrono::milliseconds(0));
      ADD_FAILURE();
    } catch (const StoreError& error) {
      EXPECT_EQ(error.kind, StoreError::Kind::locked);
      EXPECT_NE(std::string(error.what()).find("by process 4711"), std::string::npos);
    }
  }
  EXPECT_NO_THROW(Database::open_for_writing(scratch.path(), Schema::todays, std::chrono::milliseconds(0)));
}

/// A check reads all of it, which would be too much for each of many runs.
TEST(Database, IsCheckedByAWriterUnlessItIsAsTheLastOneLeftIt) {
  const Scratch scratch;
  const auto file = scratch.path() / kCatalogueFile;
  Database::open_for_writing(scratch.path());
  const auto left = std::filesystem::last_write_time(file);
  std::string bytes = read_text(file);
  std::fill(bytes.begin() + 3 * 4096, bytes.begin() + 5 * 4096, '\x5a');
  std::ofstream(file, std::ios::binary) << bytes;
  std::filesystem::last_write_time(file, left);
  EXPECT_NO_THROW(Database::open_for_writing(scratch.path()));
  EXPECT_THROW(Database::open_for_writing(scratch.path()).check(), StoreError);
  std::filesystem::last_write_time(file, left);
  EXPECT_THROW(Database::open_for_writing(scratch.path()), StoreError) << "somebody else has touched it";
  EXPECT_THROW(Database::open_for_writing(scratch.path()), StoreError) << "and it has not been used since";
}

TEST(Database, IsCheckedAfterAWriterWasKilledOrFoundSomethingWrong) {
  const Scratch scratch;
  const auto file = scratch.path() / kCatalogueFile;
  const auto damaged_and_as_left = [&](const auto& use) {
    use();
    const auto left = std::filesystem::last_write_time(file);
    std::string bytes = read_text(file);
    std::fill(bytes.begin() + 3 * 4096, bytes.begin() + 5 * 4096, '\x5a');
    std::ofstream(file, std::ios::binary) << bytes;
    std::filesystem::last_write_time(file, left);
    EXPECT_THROW(Database::open_for_writing(scratch.path()), StoreError);
    std::filesystem::remove(file);
  };
  damaged_and_as_left([&] { Database::open_for_writing(scratch.path()).distrust(); });
  damaged_and_as_left([&] {
    Database::open_for_writing(scratch.path());
    std::ofstream(scratch.path() / "catalogue.lock") << "4711\n";  // as one that was killed leaves it
  });
}

TEST(Database, IsNotWrittenThroughAReader) {
  const Scratch scratch;
  Database::open_for_writing(scratch.path());
  Database reader = Database::open_for_reading(scratch.path());
  EXPECT_THROW(reader.sqlite().exec("DELETE FROM run"), SQLite::Exception);
}

}  // namespace
}  // namespace seapile::store
