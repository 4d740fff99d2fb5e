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
  EXPECT_EQ(setting(database, "user_version"), "1");
}

TEST(Database, HasOnlyStrictTables) {
  const Scratch scratch;
  Database database = Database::open_for_writing(scratch.path());
  EXPECT_GT(database.sqlite().execAndGet("SELECT count(*) FROM pragma_table_list WHERE strict").getInt(), 8);
  EXPECT_EQ(database.sqlite()
                .execAndGet("SELECT count(*) FROM pragma_table_list WHERE NOT strict AND name NOT LIKE 'sqlite_%'")
                .getInt(),
            0);
}

TEST(Database, HasOneWriterAtATimeAndSaysWho) {
  const Scratch scratch;
  {
    const Database writer = Database::open_for_writing(scratch.path());
    std::ofstream(scratch.path() / "catalogue.lock") << "4711\n";
    try {
      Database::open_for_writing(scratch.path(), std::chrono::milliseconds(0));
      ADD_FAILURE();
    } catch (const StoreError& error) {
      EXPECT_EQ(error.kind, StoreError::Kind::locked);
      EXPECT_NE(std::string(error.what()).find("by process 4711"), std::string::npos);
    }
  }
  EXPECT_NO_THROW(Database::open_for_writing(scratch.path(), std::chrono::milliseconds(0)));
}

TEST(Database, IsNotWrittenThroughAReader) {
  const Scratch scratch;
  Database::open_for_writing(scratch.path());
  Database reader = Database::open_for_reading(scratch.path());
  EXPECT_THROW(reader.sqlite().exec("DELETE FROM run"), SQLite::Exception);
}

}  // namespace
}  // namespace seapile::store
