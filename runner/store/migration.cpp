#include "runner/store/migration.h"

#include <fmt/format.h>

#include <SQLiteCpp/Backup.h>

#include <array>

#include "runner/store/catalogue_sql.h"
#include "runner/store/database.h"
#include "runner/store/equivalence.h"
#include "runner/store/ingest.h"

namespace seapile::store {

namespace {

using Path = std::filesystem::path;
using Texts = std::vector<std::string>;

/// The parts of every run once more, from its manifest. A run without one is no longer listed, as after a reindexing.
void read_parts_again(SQLite::Database& sqlite, const Path& root, Texts& left_out) {
  SQLite::Statement runs(sqlite, "SELECT run_id, folder FROM run ORDER BY folder");
  std::vector<std::pair<std::int64_t, Path>> all;
  while (runs.executeStep()) all.emplace_back(runs.getColumn(0).getInt64(), root / runs.getColumn(1).getString());
  for (const auto& [run_id, folder] : all) {
    try {
      put_parts(sqlite, run_id, read_manifest(folder).header.parts);
    } catch (const StoreError& error) {
      left_out.push_back(error.what());
      for (const char* forget : {"DELETE FROM metric WHERE run_id = ?", "DELETE FROM artifact WHERE run_id = ?",
                                 "DELETE FROM part WHERE run_id = ?", "DELETE FROM numerics WHERE run_id = ?",
                                 "DELETE FROM cost WHERE run_id = ?", "DELETE FROM run WHERE run_id = ?"}) {
        SQLite::Statement statement(sqlite, forget);
        statement.bind(1, run_id);
        statement.exec();
      }
    }
  }
  sqlite.exec(
      "DELETE FROM param WHERE case_id NOT IN (SELECT case_id FROM run);"
      "DELETE FROM kase WHERE case_id NOT IN (SELECT case_id FROM run)");
}

void read_declarations(SQLite::Database& sqlite, const Path& root, Texts& left_out) {
  const Equivalences equivalences = read_equivalences(root);
  ingest_equivalences(sqlite, equivalences.declared);
  left_out.insert(left_out.end(), equivalences.left_out.begin(), equivalences.left_out.end());
}

/// From the version before to this one.
struct Step {
  int version;
  const char* what;
  const char* sql;
  void (*fill)(SQLite::Database& sqlite, const Path& root, Texts& left_out);  ///< what SQL alone cannot know
};

constexpr std::array kSteps = {
    Step{2,
         "marks the newest run of each case, adds the sizes of runs, what decided about the parts of the model, two "
         "views and indexes",
         kMigrationTo2Sql, read_parts_again},
    Step{3, "adds the declarations that older numerics are equivalent", kMigrationTo3Sql, read_declarations},
};
static_assert(kSteps.back().version == kCatalogueVersion);

Migration migration_from(int version, const Path& file) {
  if (version == 0) throw StoreError(StoreError::Kind::damaged, file.string() + " is no catalogue of Seapile");
  Migration migration{version, kCatalogueVersion, {}, {}, {}};
  for (const Step& step : kSteps) {
    if (step.version > version) migration.steps.push_back(fmt::format("{}: {}", step.version, step.what));
  }
  return migration;
}

/// "catalogue.sqlite.v1", or with a number behind it where that is taken.
Path copy_aside(Database& database, int version) {
  const std::string name = fmt::format("{}.v{}", database.file().string(), version);
  Path copy = name;
  for (int i = 2; is_there(copy); ++i) copy = fmt::format("{}-{}", name, i);
  const Path temporary = temporary_name(copy);
  try {
    SQLite::Database into(temporary.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    SQLite::Backup(into, database.sqlite()).executeStep();
  } catch (const SQLite::Exception&) {
    discard(temporary);
    throw;
  }
  sync_file(temporary);
  publish(temporary, copy);
  return copy;
}

}  // namespace

Migration planned_migration(const Path& root) {
  Database database = Database::open_for_reading(root, Schema::any);
  return guarded(database.file(),
                 [&] { return migration_from(schema_version(database.sqlite(), database.file()), database.file()); });
}

Migration migrate(const Path& root) {
  // Nothing is created where there is no catalogue.
  if (Migration planned = planned_migration(root); planned.steps.empty()) return planned;
  Database database = Database::open_for_writing(root, Schema::any);
  return guarded(database.file(), [&] {
    SQLite::Database& sqlite = database.sqlite();
    Migration migration = migration_from(schema_version(sqlite, database.file()), database.file());
    if (migration.steps.empty()) return migration;
    migration.kept = copy_aside(database, migration.from);
    // Tables are replaced that others refer to; SQLite takes this word outside of transactions only.
    sqlite.exec("PRAGMA foreign_keys=OFF");
    SQLite::Transaction transaction(sqlite, SQLite::TransactionBehavior::EXCLUSIVE);
    for (const Step& step : kSteps) {
      if (step.version <= migration.from) continue;
      sqlite.exec(step.sql);
      step.fill(sqlite, root, migration.left_out);
    }
    if (SQLite::Statement(sqlite, "PRAGMA foreign_key_check").executeStep()) {
      throw StoreError(StoreError::Kind::damaged,
                       database.file().string() + " does not hold together and is to be rebuilt");
    }
    transaction.commit();
    return migration;
  });
}

}  // namespace seapile::store
