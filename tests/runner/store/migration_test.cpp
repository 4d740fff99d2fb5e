// A catalogue that an older version wrote is brought to today's schema and holds what a reindexing would give.
#include "runner/store/migration.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "runner/store/catalogue.h"
#include "runner/store/database.h"
#include "runner/store/durable.h"
#include "runner/store/equivalence.h"
#include "tests/runner/store/dump.h"
#include "tests/runner/store/sample_run.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using Path = std::filesystem::path;

const Path kGoldenV1 = SEAPILE_RESULTS_SCHEMA "/golden/v1";

/// A copy of the store that version 1 wrote.
class StoreOfVersion1 : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::copy(kGoldenV1, root_, std::filesystem::copy_options::recursive); }

  Path catalogue() const { return root_ / kCatalogueFile; }

  std::map<std::string, std::string> reindexed() const {
    Catalogue::open_anew(root_).rebuild();
    return sample::rows_of_all_tables(catalogue());
  }

  Scratch scratch_;
  Path root_ = scratch_.fresh("root");
};

TEST_F(StoreOfVersion1, MigratedHoldsWhatAReindexingGives) {
  const Migration done = migrate(root_);
  EXPECT_EQ(done.from, 1);
  EXPECT_EQ(done.to, kCatalogueVersion);
  EXPECT_TRUE(done.left_out.empty());
  const auto migrated = sample::rows_of_all_tables(catalogue());
  const auto schema = sample::schema_of(catalogue());
  EXPECT_EQ(migrated, reindexed());
  EXPECT_EQ(schema, sample::schema_of(catalogue()));
  EXPECT_GT(migrated.at("metric").size(), 100U);
}

/// Declarations as a probe would have left them, one of them damaged.
void declare_something(const Path& root) {
  Equivalence one;
  one.kind = "drive";
  one.before = {{"grains", 1}, {"pile", 1}};
  one.now = {{"grains", 2}, {"pile", 1}};
  one.case_id = std::string(64, 'a');
  one.run = "0001";
  one.likeness = "identical";
  declare(root, one);
  one.kind = "bed";
  declare(root, one);
  write_text(root / "equivalents" / "damaged.json", "{}");
}

TEST(StoreOfVersion2, MigratedHoldsWhatAReindexingGives) {
  const Scratch scratch;
  const Path root = scratch.fresh("root"), catalogue = root / kCatalogueFile;
  std::filesystem::copy(SEAPILE_RESULTS_SCHEMA "/golden/v2", root, std::filesystem::copy_options::recursive);
  declare_something(root);
  EXPECT_THROW(Catalogue::open(root), StoreError) << "nobody migrates without being told to";
  const Migration done = migrate(root);
  EXPECT_EQ(done.from, 2);
  EXPECT_EQ(done.to, kCatalogueVersion);
  EXPECT_EQ(done.kept, root / "catalogue.sqlite.v2");
  ASSERT_EQ(done.left_out.size(), 1U);
  EXPECT_NE(done.left_out[0].find("damaged.json"), std::string::npos);
  const auto migrated = sample::rows_of_all_tables(catalogue);
  const auto schema = sample::schema_of(catalogue);
  std::vector<std::string> left_out;
  Catalogue::open_anew(root).rebuild(&left_out);
  EXPECT_EQ(migrated, sample::rows_of_all_tables(catalogue));
  EXPECT_EQ(schema, sample::schema_of(catalogue));
  EXPECT_EQ(left_out, done.left_out);
  EXPECT_EQ(std::ranges::count(migrated.at("equivalence"), '\n'), 2);
}

TEST_F(StoreOfVersion1, LearnsFromTheManifestsWhatDecidedAboutParts) {
  // Runs that version 1 listed and whose manifests know more than it asked for.
  std::filesystem::remove_all(root_ / "cases");
  const sample::Written written = sample::write(root_);
  const Path other = scratch_.fresh("other");
  std::filesystem::copy(root_ / "cases", other / "cases", std::filesystem::copy_options::recursive);
  EXPECT_EQ(Catalogue::open(other).rebuild(), 2U);
  {
    SQLite::Database sqlite(catalogue().string(), SQLite::OPEN_READWRITE);
    sqlite.exec("ATTACH '" + (other / kCatalogueFile).string() + "' AS today");
    for (const char* table :
         {"cost", "numerics", "part", "artifact", "metric", "run", "param", "kase", "study_case", "study"}) {
      sqlite.exec(std::string("DELETE FROM ") + table);
    }
    for (const char* table : {"kase", "param", "run", "metric", "artifact", "part", "numerics", "cost"}) {
      std::string columns;
      SQLite::Statement all(sqlite, std::string("SELECT name FROM pragma_table_info('") + table + "', 'main')");
      while (all.executeStep()) columns += (columns.empty() ? "" : ", ") + all.getColumn(0).getString();
      sqlite.exec(std::string("INSERT INTO main.") + table + " SELECT " + columns + " FROM today." + table);
    }
  }
  migrate(root_);
  const auto migrated = sample::rows_of_all_tables(catalogue());
  EXPECT_NE(migrated.at("part").find("|asked|share|0.25|0.5|0.001|mean|"), std::string::npos) << migrated.at("part");
  auto fresh = sample::rows_of_all_tables(other / kCatalogueFile);
  EXPECT_EQ(migrated, fresh);
}

TEST_F(StoreOfVersion1, ARunWhoseFolderIsGoneIsNoLongerListed) {
  for (const auto& folder : entries(root_ / "cases")) {
    if (folder.filename().string().starts_with("e7c3")) std::filesystem::remove_all(folder);
  }
  const Migration done = migrate(root_);
  ASSERT_EQ(done.left_out.size(), 1U);
  EXPECT_NE(done.left_out[0].find("e7c3"), std::string::npos);
  EXPECT_EQ(sample::rows_of_all_tables(catalogue()), reindexed());
}

TEST_F(StoreOfVersion1, IsCopiedAsideFirst) {
  const auto before = sample::rows_of_all_tables(catalogue());
  const Migration done = migrate(root_);
  EXPECT_EQ(done.kept, root_ / "catalogue.sqlite.v1");
  EXPECT_EQ(sample::rows_of_all_tables(done.kept), before);
  EXPECT_EQ(SQLite::Database(done.kept.string()).execAndGet("PRAGMA user_version").getInt(), 1);
  // A copy that is there already is kept, too.
  std::filesystem::copy_file(kGoldenV1 / kCatalogueFile, catalogue(),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(migrate(root_).kept, root_ / "catalogue.sqlite.v1-2");
}

TEST_F(StoreOfVersion1, IsAsItWasWhenAStepFails) {
  // What step 2 creates is in its way.
  SQLite::Database(catalogue().string(), SQLite::OPEN_READWRITE).exec("CREATE VIEW results AS SELECT 1");
  const auto before = sample::rows_of_all_tables(catalogue());
  EXPECT_THROW(migrate(root_), StoreError);
  EXPECT_EQ(sample::rows_of_all_tables(catalogue()), before);
  EXPECT_EQ(planned_migration(root_).from, 1);
}

TEST_F(StoreOfVersion1, IsOnlyLookedAtByAPlan) {
  const std::string before = read_text(catalogue());
  const Migration planned = planned_migration(root_);
  EXPECT_EQ(planned.from, 1);
  EXPECT_EQ(planned.steps.size(), 2U);
  EXPECT_TRUE(planned.kept.empty());
  EXPECT_TRUE(read_text(catalogue()) == before);
  EXPECT_EQ(entries(root_).size(), 3U);
}

TEST_F(StoreOfVersion1, IsRefusedByReaderAndWriterWhichNameBothWaysOut) {
  const std::string before = read_text(catalogue());
  for (const auto open : {&Catalogue::open, &Catalogue::open_read_only}) {
    try {
      open(root_);
      ADD_FAILURE();
    } catch (const StoreError& error) {
      for (const char* word : {"schema 1", "runner migrate", "runner reindex"}) {
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
      }
    }
  }
  EXPECT_EQ(planned_migration(root_).from, 1) << "nobody migrates without being told to";
}

TEST_F(StoreOfVersion1, MigratedAgainHasNothingToDo) {
  migrate(root_);
  const std::string before = read_text(catalogue());
  EXPECT_TRUE(migrate(root_).steps.empty());
  EXPECT_TRUE(read_text(catalogue()) == before);
}

TEST_F(StoreOfVersion1, OfANewerOrAnotherProgramIsRefused) {
  SQLite::Database(catalogue().string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
  EXPECT_THROW(migrate(root_), StoreError);
  EXPECT_THROW(planned_migration(root_), StoreError);
  EXPECT_FALSE(std::filesystem::exists(root_ / "catalogue.sqlite.v99"));
  const Path other = scratch_.fresh("other");
  SQLite::Database((other / kCatalogueFile).string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("CREATE TABLE other (x)");
  EXPECT_THROW(migrate(other), StoreError);
  EXPECT_THROW(migrate(scratch_.fresh("nothing")), StoreError);
  EXPECT_TRUE(entries(scratch_.path() / "nothing").empty());
}

}  // namespace
}  // namespace seapile::store
