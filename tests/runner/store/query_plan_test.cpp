// However many runs there are, a question is answered through indexes: no statement that a query issues reads a table
// from end to end. Plans are what SQLite makes without statistics, so they do not depend on how many rows there are.
#include <gtest/gtest.h>

#include <sqlite3.h>

#include <algorithm>
#include <regex>
#include <set>

#include "runner/store/catalogue.h"
#include "runner/store/database.h"
#include "runner/store/query.h"
#include "tests/runner/store/sample_run.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using Path = std::filesystem::path;
using Texts = std::vector<std::string>;

/// Every statement that is issued while it lives.
class Listener {
 public:
  explicit Listener(SQLite::Database& sqlite) : handle_(sqlite.getHandle()) {
    sqlite3_trace_v2(
        handle_, SQLITE_TRACE_STMT,
        [](unsigned, void* heard, void* statement, void*) {
          static_cast<std::set<std::string>*>(heard)->insert(sqlite3_sql(static_cast<sqlite3_stmt*>(statement)));
          return 0;
        },
        &heard_);
  }
  ~Listener() { sqlite3_trace_v2(handle_, 0, nullptr, nullptr); }
  const std::set<std::string>& heard() const { return heard_; }

 private:
  sqlite3* handle_;
  std::set<std::string> heard_;
};

/// The lines of a plan that go through a table from end to end. What is not below `big` may be: there are few studies,
/// and lists that a statement makes are read as a whole.
Texts scans(SQLite::Database& sqlite, const std::string& statement) {
  static const std::regex big(
      "SCAN (run|r|b|d|kase|k|c|param|metric|m|artifact|part|numerics|cost|study_case|sc)\\b.*");
  Texts found;
  SQLite::Statement plan(sqlite, "EXPLAIN QUERY PLAN " + statement);
  while (plan.executeStep()) {
    const std::string line = plan.getColumn("detail").getString();
    if (std::regex_match(line, big)) found.push_back(line);
  }
  return found;
}

class QueryPlans : public testing::Test {
 protected:
  void SetUp() override {
    const sample::Written written = sample::write(root_);
    Catalogue catalogue = Catalogue::open(root_);
    catalogue.ingest(written.bed);
    catalogue.ingest(written.drive);
    catalogue.put({"tips", "?", "", {{written.drive.parent_path().filename(), {{"pile.tip", "flat"}}}}});
  }

  /// The scans of all statements that the query issues, each with its statement.
  std::string scans_of(const std::string& study, const std::string& expression, const Texts& columns) {
    const Listener listener(database_->sqlite());
    query_table(database_->sqlite(), study, expression.empty() ? Expression{} : parse_expression(expression), columns);
    EXPECT_GT(listener.heard().size(), 3U);
    std::string all;
    for (const std::string& statement : std::set<std::string>(listener.heard())) {
      if (statement.starts_with("BEGIN") || statement.starts_with("ROLLBACK") || statement.starts_with("COMMIT"))
        continue;
      for (const std::string& line : scans(database_->sqlite(), statement)) all += line + " in " + statement + "\n";
    }
    return all;
  }

  Scratch scratch_;
  Path root_ = scratch_.fresh("root");
  std::unique_ptr<Database> database_;
};

TEST_F(QueryPlans, NoConditionReadsATableFromEndToEnd) {
  database_ = std::make_unique<Database>(Database::open_for_reading(root_));
  for (const char* expression : {"pile.tip = flat",
                                 "tip = flat",
                                 "pile.tip != conical",
                                 "speed > 0.01",
                                 "speed != 7",
                                 "tip_resistance_mean > 0",
                                 "tip_resistance_mean != 0",
                                 "bed:solid_fraction > 0",
                                 "kind = drive",
                                 "outcome = completed",
                                 "study = tips",
                                 "bed:case = c633d94908",
                                 "tip = flat and tip_resistance_mean > 0 and outcome = completed",
                                 "tip = flat and not speed > 1",
                                 "tip = flat and fluid = null",
                                 "tip = flat and bed:case != 0123456789",
                                 "tip = flat and study != tips",
                                 "tip = flat or tip_resistance_mean < 0",
                                 "tip = flat and pile != null",
                                 "(tip = flat or speed > 7) and (tip_resistance_mean > 0 or overlap_max > 1)"}) {
    for (const char* study : {"", "tips"}) EXPECT_EQ(scans_of(study, expression, {}), "") << expression;
  }
}

TEST_F(QueryPlans, NoColumnReadsATableFromEndToEnd) {
  database_ = std::make_unique<Database>(Database::open_for_reading(root_));
  for (const char* column :
       {"pile.tip", "speed", "tip_resistance_mean", "bed:solid_fraction", "bed:case", "kind", "outcome", "study"}) {
    for (const char* study : {"", "tips"}) EXPECT_EQ(scans_of(study, "tip = flat", {column}), "") << column;
  }
}

/// What has to look at every run goes through the index of the newest ones, once and in the order of the answer.
TEST_F(QueryPlans, AListOfAllRunsGoesThroughTheNewestOnes) {
  database_ = std::make_unique<Database>(Database::open_for_reading(root_));
  for (const char* expression : {"", "fluid = null", "not tip = conical", "kind != bed"}) {
    const std::string found = scans_of("", expression, {});
    EXPECT_TRUE(found.starts_with("SCAN r USING INDEX run_newest in SELECT r.run_id")) << expression << ": " << found;
    EXPECT_EQ(std::ranges::count(found, '\n'), 1) << found;
    EXPECT_EQ(scans_of("tips", expression, {}), "") << expression;
  }
}

/// Half of all tips are flat, and few runs resist as much: those are found first, and asked for their tip.
TEST_F(QueryPlans, AMetricFindsTheRunsThatTheOtherConditionsTest) {
  database_ = std::make_unique<Database>(Database::open_for_reading(root_));
  SQLite::Database& sqlite = database_->sqlite();
  for (const char* expression :
       {"tip = flat and tip_resistance_mean > 0", "tip_resistance_mean > 0 and kind = drive"}) {
    const Listener listener(sqlite);
    query_table(sqlite, "", parse_expression(expression), {});
    std::string plan;
    for (const std::string& statement : std::set<std::string>(listener.heard())) {
      if (!statement.starts_with("SELECT r.run_id")) continue;
      SQLite::Statement rows(sqlite, "EXPLAIN QUERY PLAN " + statement);
      while (rows.executeStep()) plan += rows.getColumn("detail").getString() + "\n";
    }
    EXPECT_TRUE(plan.starts_with("SEARCH r USING INTEGER PRIMARY KEY")) << expression << ": " << plan;
    EXPECT_NE(plan.find("metric_by_value"), std::string::npos) << plan;
    EXPECT_EQ(plan.find("param_by_txt"), std::string::npos) << plan;
  }
}

TEST_F(QueryPlans, AScanIsSeen) {
  database_ = std::make_unique<Database>(Database::open_for_reading(root_));
  for (const char* statement : {"SELECT * FROM run r WHERE r.time > 0", "SELECT DISTINCT path FROM param",
                                "SELECT 1 FROM param WHERE substr(path, 1, 2) = 'x'"}) {
    EXPECT_FALSE(scans(database_->sqlite(), statement).empty()) << statement;
  }
}

}  // namespace
}  // namespace seapile::store
